// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/followed.h"

namespace throng::analysis {

/// How much of something a rule did: a share of what all who did it did, 0 to 1, the most first.
struct RuleShare {
    std::string rule;
    double share = 0.0;
};

/// Something that lasted for a while.
struct Spell {
    double from = 0.0, to = 0.0;  ///< s
    glm::dvec2 place{0.0};        ///< m, in the world, where it began
    std::vector<RuleShare> causes;
};

/// What the steps of one person come to (docs/follow.md). Seconds and metres.
struct FollowAccount {
    std::uint32_t row = 0;
    std::size_t steps = 0, decisions = 0;
    double from = 0.0, to = 0.0;
    double walked = 0.0;
    double under_way = 0.0;     ///< s in which it wished to walk: along its route, or in a line
    double wished_speed = 0.0;  ///< m/s, mean while under way
    double had_speed = 0.0;     ///< m/s along its wish, likewise

    std::vector<RuleShare> held_back;  ///< of all that was taken from its speed along its wish

    double standing = 0.0;  ///< s under way and slower than people walk
    std::optional<Spell> longest_standstill;

    double astray = 0.0;  ///< s in which it moved across its way or back along it by 0.3 m/s and more
    std::vector<RuleShare> astray_causes;

    double moving = 0.0;            ///< s at 0.1 m/s and more, before it arrived
    double backward = 0.0;          ///< s of these against its facing, as `throng measure` counts frames
    double backward_by_wish = 0.0;  ///< s of these in which its wish, too, was behind it
    std::size_t backward_spells = 0;
    std::optional<Spell> longest_backward;
    std::vector<RuleShare> backward_causes;  ///< of what turned its velocity back, or it away from that
};

/// Whether somebody walks backward at the end of a step.
bool isBackward(const FollowedStep& step);
/// Where somebody wants to go: of unit length.
glm::dvec2 wayOf(const FollowedStep& step);

/// @param steps of one person, in order
/// @param origin what is added to places to have them in the world, m
FollowAccount accountOf(std::span<const FollowedStep> steps, double step_seconds, glm::dvec2 origin);

nlohmann::ordered_json followJson(const FollowAccount& account);
std::string followText(const FollowAccount& account);

}  // namespace throng::analysis
