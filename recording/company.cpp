// SPDX-License-Identifier: Apache-2.0
#include "recording/company.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/storeys.h"

namespace throng::recording {
namespace {

constexpr double kTalks = 1.8;                       // m, between two who stand face to face
constexpr double kFaces = 1.0;                       // rad, from the heading
constexpr double kShortTurn = 1.6, kLongTurn = 3.2;  // s
constexpr double kUneven = 0.4;                      // of a turn: how far its beginning may be off

}  // namespace

void Company::gather(std::span<const Onlooker> people, const PlaneGrid& grid) {
    sorted_.clear();
    members_.clear();
    circles_.assign(people.size(), {0, 0});
    for (std::uint32_t i = 0; i < people.size(); ++i)
        sorted_.emplace_back(people[i].party, i);
    std::ranges::sort(sorted_);
    for (std::size_t from = 0, to = 0; from < sorted_.size(); from = to) {
        while (to < sorted_.size() && sorted_[to].first == sorted_[from].first)
            ++to;
        if (to - from < 2) continue;
        const auto first = static_cast<std::uint32_t>(members_.size());
        for (std::size_t i = from; i < to; ++i) {
            members_.push_back(sorted_[i].second);
            circles_[sorted_[i].second] = {first, first + static_cast<std::uint32_t>(to - from)};
        }
    }
    addPairs(people, grid);
}

/// Who stands nearest before somebody and faces it; kNone: nobody.
std::uint32_t Company::facedBy(const Onlooker& self, std::span<const Onlooker> people,
                               const PlaneGrid& grid) const {
    std::uint32_t found = kNone;
    double nearest = kTalks;
    grid.near(self.place, kTalks, [&](std::uint32_t i) {
        const Onlooker& other = people[i];
        const double away = glm::distance(self.place, other.place);
        if (away >= nearest || other.row == self.row || !other.stands() || other.has_subject ||
            circles_[i].second > 0 || !areOnOneGround(self.height, other.height) ||
            !isBefore(self, other.place, kTalks, kFaces) || !isBefore(other, self.place, kTalks, kFaces))
            return;
        nearest = away;
        found = i;
    });
    return found;
}

void Company::addPairs(std::span<const Onlooker> people, const PlaneGrid& grid) {
    faced_.assign(people.size(), kNone);
    for (std::uint32_t i = 0; i < people.size(); ++i)
        if (people[i].stands() && !people[i].has_subject && circles_[i].second == 0)
            faced_[i] = facedBy(people[i], people, grid);
    for (std::uint32_t i = 0; i < people.size(); ++i) {
        const std::uint32_t other = faced_[i];
        if (other == kNone || other < i || faced_[other] != i) continue;
        const auto first = static_cast<std::uint32_t>(members_.size());
        members_.insert(members_.end(), {i, other});
        circles_[i] = circles_[other] = {first, first + 2};
    }
}

std::span<const std::uint32_t> Company::of(std::uint32_t index) const {
    const auto [from, to] = circles_[index];
    return std::span(members_).subspan(from, to - from);
}

Company::Turn Company::turnAt(std::uint32_t index, std::span<const Onlooker> people, double time) const {
    const std::span<const std::uint32_t> members = of(index);
    const std::uint64_t key = scramble(seed_ ^ scramble(people[members.front()].row));
    const double length = kShortTurn + (kLongTurn - kShortTurn) * fractionOf(scramble(key + 1));
    // The clock begins before the shot does, so that there is a turn before the first one, too.
    const double at = time / length + 2.0 + fractionOf(scramble(key + 2));
    auto number = static_cast<std::uint32_t>(at);
    const auto off = [&](std::uint32_t turn) {
        return kUneven * (fractionOf(scramble(key + 3 + turn)) - 0.5);
    };
    const double share = at - number;
    if (share < off(number))
        --number;
    else if (share >= 1.0 + off(number + 1))
        ++number;
    const auto count = static_cast<std::uint32_t>(members.size());
    const auto drawn = [&](std::uint32_t turn) {
        return static_cast<std::uint32_t>(scramble(key ^ (std::uint64_t{turn} << 32)) % count);
    };
    std::uint32_t speaker = count == 2 ? number % 2 : drawn(number);
    if (count > 2 && speaker == drawn(number - 1)) speaker = (speaker + 1) % count;
    return {members[speaker], number};
}

}  // namespace throng::recording
