// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace throng {

/// What a frame says of a lift, and in lifts.npy the last axis.
enum class LiftColumn { height, open, aboard, stop };
inline constexpr std::array<const char*, 4> kLiftColumns = {"height", "open", "aboard", "stop"};
inline constexpr std::size_t kLiftFloats = kLiftColumns.size();

/// One lift. Metres, from where the streams count; degrees.
struct LiftIdentity {
    struct Stop {
        std::string level;
        double height = 0.0;
        double doors = 0.0;  ///< where the cabin's doors look that open here
    };
    std::string id;
    glm::dvec2 at{0.0};    ///< the middle of its cabin
    glm::dvec2 size{0.0};  ///< broad and deep
    double doors = 0.0, door_width = 0.0;
    std::uint32_t capacity = 0;
    std::vector<Stop> stops;
};

}  // namespace throng
