// SPDX-License-Identifier: Apache-2.0
#include "authoring/overrides/matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace throng::authoring {
namespace {

struct Pair {
    double cost;
    std::size_t entry;
    std::uint32_t row;
    Match match;
};

Match compare(const Override& entry, const Entrant& person, std::uint32_t row) {
    const glm::dvec3 apart = person.place - entry.spawn_place;
    const double metres = std::sqrt(apart.x * apart.x + apart.y * apart.y + apart.z * apart.z);
    const double frames = static_cast<double>(person.frame) - static_cast<double>(entry.spawn_frame);
    return {Match::Kind::nearest, row, metres, frames};
}

bool within(const Match& match, double metres, double frames) {
    return match.metres <= metres && std::abs(match.frames) <= frames;
}

}  // namespace

std::vector<Match> matchOverrides(std::span<const Override> overrides, std::span<const Entrant> people) {
    std::vector<Match> matches(overrides.size());
    std::vector<bool> taken(people.size());
    for (std::size_t i = 0; i < overrides.size(); ++i) {
        const Override& entry = overrides[i];
        if (entry.id >= people.size() || taken[entry.id]) continue;
        const Entrant& person = people[entry.id];
        if (!person.enters || person.group != entry.group) continue;
        Match match = compare(entry, person, entry.id);
        if (!within(match, kSureMetres, kSureFrames)) continue;
        match.kind = Match::Kind::sure;
        matches[i] = match;
        taken[entry.id] = true;
    }

    std::map<std::string_view, std::vector<std::uint32_t>> left;  // by group
    for (std::uint32_t row = 0; row < people.size(); ++row)
        if (people[row].enters && !taken[row]) left[people[row].group].push_back(row);
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < overrides.size(); ++i) {
        if (matches[i].kind == Match::Kind::sure) continue;
        for (const std::uint32_t row : left[overrides[i].group]) {
            const Match match = compare(overrides[i], people[row], row);
            if (!within(match, kMostMetres, kMostFrames)) continue;
            const double by_place = match.metres / kMostMetres, by_time = match.frames / kMostFrames;
            pairs.push_back({by_place * by_place + by_time * by_time, i, row, match});
        }
    }
    std::ranges::sort(pairs, {},
                      [](const Pair& pair) { return std::tuple(pair.cost, pair.entry, pair.row); });
    for (const Pair& pair : pairs) {
        if (taken[pair.row] || matches[pair.entry].kind != Match::Kind::orphaned) continue;
        matches[pair.entry] = pair.match;
        taken[pair.row] = true;
    }
    return matches;
}

std::string orphanReason(const Override& entry, std::span<const Entrant> people) {
    if (std::ranges::none_of(people, [&](const Entrant& person) { return person.group == entry.group; }))
        return fmt::format("there is no group `{}` in this bake", entry.group);
    return fmt::format("nobody else of `{}` enters within {} m and {} frames of its place and time",
                       entry.group, kMostMetres, kMostFrames);
}

}  // namespace throng::authoring
