// SPDX-License-Identifier: Apache-2.0
#include "recording/carriages.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "recording/spring.h"

namespace throng::recording {
namespace {

constexpr float kLimbs = 11.0f, kTrunk = 10.0f, kShoulders = 9.0f;  // 1/s, stiffness of springs
constexpr float kLeans = 0.06f;                           // rad per m/s^2; 0.1 would keep balance alone
constexpr float kMostForward = 0.12f, kMostBack = 0.07f;  // rad
constexpr double kRoom = 0.25;                            // m: with so much between bodies nobody turns
constexpr double kAnticipates = 0.25;                     // s
constexpr double kPasses = 0.25, kPassesFully = 0.8;      // m/s, between two people along the way of one
constexpr double kSightReach = 1.6;                       // m: further away is nobody who matters so soon

}  // namespace

Carriages::Carriages(std::vector<float> radii, double fps, glm::dvec2 minimum, glm::dvec2 maximum)
    : radii_(std::move(radii)),
      interval_(static_cast<float>(1.0 / fps)),
      bodies_(radii_.size()),
      grid_(minimum, maximum, kSightReach, cellsFor(radii_.size())) {}

Carriage Carriages::operator[](std::size_t row) const {
    const Body& body = bodies_[row];
    return {std::clamp(body.walking, 0.0f, 1.0f), body.twist, body.lean};
}

float Carriages::step(std::size_t row, double speed) {
    Body& body = bodies_[row];
    const auto pace = static_cast<float>(speed);
    const auto walking = static_cast<float>(easedFrom(speed, kStandsBelow, kWalksFrom));
    if (body.known == 0)
        body = {.walking = walking, .pace = pace, .known = 1};
    else {
        approach(body.walking, body.walking_rate, walking, kLimbs, interval_);
        approach(body.pace, body.pace_rate, pace, kTrunk, interval_);
        approach(body.lean, body.lean_rate, std::clamp(kLeans * body.pace_rate, -kMostBack, kMostForward),
                 kTrunk, interval_);
    }
    return (*this)[row].walking;
}

/// How close those come, within a moment, who pass by on either side.
Carriages::Sides Carriages::tightness(const Onlooker& self, std::span<const Onlooker> people) const {
    Sides found;
    const glm::dvec2 left(-self.heading.y, self.heading.x);
    grid_.near(self.place, kSightReach, [&](std::uint32_t index) {
        const Onlooker& other = people[index];
        if (other.row == self.row) return;
        const glm::dvec2 relative = other.speed * other.heading - self.speed * self.heading;
        const glm::dvec2 away = other.place + kAnticipates * relative - self.place;
        const double distance = std::max(glm::length(away), 1.0e-6);
        const double gap = distance - radii_[self.row] - radii_[other.row];
        const double aside = glm::dot(away, left) / distance;
        const double passes = easedFrom(std::abs(glm::dot(relative, self.heading)), kPasses, kPassesFully);
        const double tight = passes * aside * aside * std::clamp(1.0 - gap / kRoom, 0.0, 1.0);
        double& side = aside > 0.0 ? found.left : found.right;
        side = std::max(side, tight);
    });
    return found;
}

void Carriages::squeeze(std::span<const Onlooker> people) {
    places_.clear();
    for (const Onlooker& each : people)
        places_.push_back(each.place);
    grid_.sort(places_);
    for (const Onlooker& self : people) {
        Body& body = bodies_[self.row];
        const Sides sides = tightness(self, people);
        // Between two people one goes sideways: which way is as good as the other, so who has begun to turn
        // goes on that way.
        const bool to_left =
            body.twist * static_cast<float>(sides.left - sides.right) >= 0.0f ||
                    std::min(sides.left, sides.right) < 0.5 * std::max(sides.left, sides.right)
                ? sides.left >= sides.right
                : body.twist > 0.0f;
        const auto most = static_cast<float>(std::max(sides.left, sides.right));
        approach(body.twist, body.twist_rate, (to_left ? kMostTwist : -kMostTwist) * most, kShoulders,
                 interval_);
    }
}

}  // namespace throng::recording
