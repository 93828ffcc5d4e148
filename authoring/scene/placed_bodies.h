// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <unordered_map>
#include <vector>

#include "base/capsule.h"
#include "shaders/shared/scene_types.h"

namespace throng::authoring {

/// Somebody's body where it begins.
Capsule shapeOf(const gpu::Person& person);
/// m: half of what it needs to get through somewhere.
float thicknessOf(const gpu::Person& person);

/// Bodies already placed, so that nobody starts inside another.
class PlacedBodies {
  public:
    bool hasRoom(const gpu::Person& person) const;
    void add(const gpu::Person& person);

  private:
    struct Body {
        glm::vec2 position;         // m
        float radius;               // m, as a person's
        float half_axis;            // m
        float heading;              // rad
        std::uint32_t same_square;  // the one before in its square, or kNone
    };
    static constexpr std::uint32_t kNone = ~0u;
    static bool areInEachOther(const Body& a, const Body& b);

    std::vector<Body> bodies_;
    std::unordered_map<std::uint64_t, std::uint32_t> last_in_;  // by square
};

}  // namespace throng::authoring
