// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "shaders/shared/walking.h"

namespace throng::recording {

/// Somebody who is there in a frame.
struct Onlooker {
    std::uint32_t row = 0;
    std::uint32_t party = 0;  ///< who has the same walks together
    glm::dvec2 place{0.0};    ///< m
    double height = 0.0;      ///< m, of the ground
    glm::dvec2 heading{1.0, 0.0};
    double speed = 0.0;        ///< m/s
    double twist = 0.0;        ///< rad, of the chest, from the heading to the left
    double turns = 0.0;        ///< rad: how far it will have turned in a moment (AttentionTrack::kForesees)
    bool has_subject = false;  ///< it stands where there is something to look at, or in a line

    bool stands() const { return speed < gpu::STANDING_SPEED; }
};

/// rad, from somebody's heading to the left.
inline double angleTo(const Onlooker& self, glm::dvec2 place) {
    const glm::dvec2 away = place - self.place;
    return std::atan2(self.heading.x * away.y - self.heading.y * away.x, glm::dot(self.heading, away));
}

/// Whether a place is within so many metres, and so many radians to either side of somebody's heading.
inline bool isBefore(const Onlooker& self, glm::dvec2 place, double reach, double angle) {
    const double away = glm::distance(self.place, place);
    return away <= reach && away >= 1.0e-6 && std::abs(angleTo(self, place)) <= angle;
}

}  // namespace throng::recording
