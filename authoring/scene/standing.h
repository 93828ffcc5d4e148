// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>

#include "authoring/scene/fields.h"

/// How people stand who stop at a place, whether a stop of theirs or a state says so.
namespace throng::authoring {

inline constexpr float kPassTolerance = 0.3f;   ///< m: who only passes a place has been there when this near
inline constexpr float kStandClearance = 0.3f;  ///< m to walls beyond a body, where there is room
inline constexpr float kCircle = 0.45f;  ///< m: radius of the ring in which a party stands (goals.comp)

/// The mean of its corners.
inline glm::vec2 middleOf(const LocalPolygon& polygon) {
    glm::vec2 middle(0.0f);
    for (const glm::vec2 point : polygon)
        middle += point / static_cast<float>(polygon.size());
    return middle;
}

}  // namespace throng::authoring
