// SPDX-License-Identifier: Apache-2.0
#include "recording/gazes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "base/frame.h"
#include "base/random.h"
#include "recording/spring.h"
#include "shaders/shared/walking.h"

namespace throng::recording {
namespace {

using std::numbers::pi;

constexpr double kNeck = 1.2;                  // rad, to either side
constexpr double kNoticed = 6.0, kLost = 9.0;  // m: others are looked at within the one, and up to the other
constexpr double kSeen = 1.2, kStillSeen = 1.45;                // rad, from the heading
constexpr double kOncoming = -0.3;                              // cosine between headings
constexpr double kTogether = 1.1, kComes = 1.0, kOther = 0.35;  // how much people draw eyes, nearby
constexpr double kCurious = 0.3, kVaries = 0.35;  // as much has somebody to draw; more, at times
constexpr double kMindsTheWay = 0.35;             // share of times that walkers look ahead first
constexpr double kLeads = 0.3, kMostLead = 0.6;   // s, rad: by how much heads are ahead of turns
constexpr double kGround = -0.08;                 // rad: who walks looks at the ground ahead
constexpr float kStiffness = 9.0f;                // 1/s, of necks

double angleTo(const Onlooker& self, const Onlooker& other) {
    const glm::dvec2 away = other.place - self.place;
    return std::atan2(self.heading.x * away.y - self.heading.y * away.x, glm::dot(self.heading, away));
}

/// Whether somebody is within so many metres, and so many radians to either side of the heading.
bool isBefore(const Onlooker& self, const Onlooker& other, double reach, double angle) {
    const double away = glm::distance(self.place, other.place);
    return away <= reach && away >= 1.0e-6 && std::abs(angleTo(self, other)) <= angle;
}

/// How much somebody draws another one's eyes; 0: not at all.
double draws(const Onlooker& self, const Onlooker& other) {
    if (!isBefore(self, other, kNoticed, kSeen)) return 0.0;
    const bool comes = glm::dot(self.heading, other.heading) < kOncoming && other.speed > gpu::STANDING_SPEED;
    const double weight = self.party == other.party ? kTogether : comes ? kComes : kOther;
    return weight * (1.0 - glm::distance(self.place, other.place) / (kNoticed + 1.0));
}

}  // namespace

Gazes::Gazes(std::size_t rows, double fps, glm::dvec2 minimum, glm::dvec2 maximum)
    : interval_(1.0 / fps),
      heads_(rows),
      index_(rows, kNone),
      grid_(minimum, maximum, kNoticed / 2.0, cellsFor(rows)) {}

/// From 0 to 1.
double Gazes::draw(std::uint32_t row) {
    const std::uint64_t word = scramble(scramble(row) + heads_[row].draws++);
    return static_cast<double>(word >> 11) * 0x1.0p-53;
}

Gaze Gazes::operator[](std::size_t row) const {
    const Head& head = heads_[row];
    constexpr auto kMost = static_cast<float>(kNeck);
    return {std::clamp(head.yaw, -kMost, kMost), head.pitch, static_cast<float>(head.at)};
}

void Gazes::look(std::span<const Onlooker> people) {
    std::ranges::fill(index_, kNone);
    places_.clear();
    for (const Onlooker& each : people) {
        index_[each.row] = static_cast<std::uint32_t>(places_.size());
        places_.push_back(each.place);
    }
    grid_.sort(places_);
    for (const Onlooker& self : people) {
        Head& head = heads_[self.row];
        head.left -= static_cast<float>(interval_);
        if (head.left <= 0.0f || (head.at > 0 && !seenBy(self, people))) choose(self, people);
    }
    for (const Onlooker& self : people)
        follow(self, people);
}

/// Who somebody looks at, if it is still there to be seen.
const Onlooker* Gazes::seenBy(const Onlooker& self, std::span<const Onlooker> people) const {
    const std::uint32_t at = heads_[self.row].at;
    if (at == 0 || index_[at - 1] == kNone) return nullptr;
    const Onlooker& other = people[index_[at - 1]];
    return isBefore(self, other, kLost, kStillSeen) ? &other : nullptr;
}

/// Who draws somebody's eyes most: Gaze::at of it, 0 where nobody does. @param before who has been looked at
std::uint32_t Gazes::whoDraws(const Onlooker& self, std::span<const Onlooker> people, std::uint32_t before) {
    double most = kCurious + kVaries * draw(self.row);
    const std::uint32_t number = heads_[self.row].draws;
    std::uint32_t found = 0;
    grid_.near(self.place, kNoticed, [&](std::uint32_t index) {
        const Onlooker& other = people[index];
        if (other.row == self.row || other.row + 1 == before) return;
        const double varied = 0.5 + static_cast<double>(scramble(other.row + number) >> 40) * 0x1.0p-24;
        const double drawn = draws(self, other) * varied;
        if (drawn <= most) return;
        most = drawn;
        found = other.row + 1;
    });
    return found;
}

void Gazes::choose(const Onlooker& self, std::span<const Onlooker> people) {
    Head& head = heads_[self.row];
    const auto between = [&](double low, double high) {
        return static_cast<float>(low + (high - low) * draw(self.row));
    };
    const bool stands = self.speed < gpu::STANDING_SPEED;
    const std::uint32_t before = std::exchange(head.at, 0);
    const bool minds_the_way = !stands && (before > 0 || draw(self.row) < kMindsTheWay);
    if (!minds_the_way) head.at = whoDraws(self, people, before);
    if (head.at > 0) {
        const bool together = people[index_[head.at - 1]].party == self.party;
        head.left = together ? between(1.2, stands ? 5.0 : 2.5) : between(0.6, 1.8);
        return;
    }
    const bool ahead = minds_the_way || (!stands && draw(self.row) < kMindsTheWay);
    head.aside = ahead ? 0.0f : between(-1.0, 1.0);
    head.up = ahead ? static_cast<float>(kGround) : between(-0.15, 0.1);
    head.left = ahead ? between(0.8, 3.0) : stands ? between(1.0, 4.0) : between(0.5, 1.2);
}

void Gazes::follow(const Onlooker& self, std::span<const Onlooker> people) {
    Head& head = heads_[self.row];
    const auto direction = static_cast<float>(std::atan2(self.heading.y, self.heading.x));
    const double turns =
        head.known == 0 ? 0.0 : std::remainder(direction - head.direction, 2.0 * pi) / interval_;
    double yaw = head.aside, pitch = head.up;
    if (const Onlooker* other = seenBy(self, people)) {
        yaw = angleTo(self, *other);
        pitch = std::atan2(other->height - self.height, glm::distance(self.place, other->place));
    } else {
        yaw += std::clamp(kLeads * turns, -kMostLead, kMostLead);
    }
    yaw = std::clamp(yaw, -kNeck, kNeck);
    if (head.known == 0) {
        head.yaw = static_cast<float>(yaw);
        head.pitch = static_cast<float>(pitch);
        head.known = 1;
    }
    head.direction = direction;
    const auto interval = static_cast<float>(interval_);
    approach(head.yaw, head.yaw_rate, static_cast<float>(yaw), kStiffness, interval);
    approach(head.pitch, head.pitch_rate, static_cast<float>(pitch), kStiffness, interval);
}

}  // namespace throng::recording
