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
    std::unordered_map<std::uint64_t, std::vector<gpu::Person>> cells_;
};

}  // namespace throng::authoring
