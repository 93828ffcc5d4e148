// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/capsule.h"

/// What is known of somebody who is followed through the steps of a simulation. Metres, seconds and radians,
/// in the scene's frame.
namespace throng {

/// What a rule has changed.
enum class Changed {
    wish,      ///< m/s: the velocity that it would like
    velocity,  ///< m/s
    heading,   ///< a unit vector
    chest,     ///< a unit vector: where it points, of bodies that are no discs
};

/// What one rule has made of one thing in one step.
struct Influence {
    std::string_view pass;  ///< of the step; lives for good
    std::string rule;       ///< as in layouts, or what the pass does without any
    Changed changed = Changed::velocity;
    glm::vec2 before{0.0f}, after{0.0f};
};

/// Somebody who is sensed.
struct SensedPerson {
    std::uint32_t row = 0;
    glm::vec2 place{0.0f};
    float radius = 0.0f;             ///< m: half of the body's longer side
    glm::vec2 axis{0.0f};            ///< m: from the middle of its segment to an end; zero: a disc
    float gap = 0.0f;                ///< m between the bodies
    float seconds_to_touch = -1.0f;  ///< as both move now; -1: they do not
};

/// What somebody is doing.
enum class Doing { walking, stopping, queueing, arrived };

/// One step of one person. What it sensed and wished is of the last decision.
struct FollowedStep {
    std::uint32_t row = 0;
    std::uint32_t step = 0;  ///< counted from 1
    double time = 0.0;       ///< s, at its end; 0 is the first frame
    bool decides = false;
    Doing doing = Doing::walking;
    std::uint32_t stage = 0;  ///< of its route, from 0
    glm::vec2 goal{0.0f};     ///< where that leads, or is the middle of where it leads
    float radius = 0.0f;      ///< m: half of the body's longer side
    float half_axis = 0.0f;   ///< m: of the body's segment, as BodySize; zero: a disc
    float preferred_speed = 0.0f;

    glm::vec2 place_before{0.0f}, place{0.0f};
    glm::vec2 facing_before{1.0f, 0.0f}, facing{1.0f, 0.0f};
    glm::vec2 chest_before{1.0f, 0.0f}, chest{1.0f, 0.0f};  ///< of discs, the same as it faces
    glm::vec2 velocity_before{0.0f}, velocity{0.0f};
    glm::vec2 wish{0.0f};
    float pace = 0.0f;         ///< m/s: how fast it wants to walk behind those ahead
    float nervousness = 0.0f;  ///< 0 to 1, after the step

    std::vector<SensedPerson> sensed;  ///< the nearest first
    float free_ahead = -1.0f;    ///< m along its wish to the first body in the way; -1: nobody sensed is
    float wall_gap = -1.0f;      ///< m to the nearest wall near by or sensed; -1: there is none
    std::uint32_t touching = 0;  ///< people who may touch it before the next decision
    bool in_narrows = false;     ///< in a narrow passage or close before one

    std::vector<Influence> influences;  ///< in the order in which they come
};

inline Capsule bodyOf(const SensedPerson& other) {
    return {other.place, other.axis, other.radius - glm::length(glm::dvec2(other.axis))};
}

/// As the step begins, or ends.
inline Capsule bodyBefore(const FollowedStep& step) {
    return capsuleOf(step.place_before, step.chest_before, step.radius, step.half_axis);
}
inline Capsule bodyAfter(const FollowedStep& step) {
    return capsuleOf(step.place, step.chest, step.radius, step.half_axis);
}

}  // namespace throng
