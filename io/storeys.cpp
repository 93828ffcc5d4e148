// SPDX-License-Identifier: Apache-2.0
#include "io/storeys.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/polygon.h"

namespace throng::io {
namespace {

constexpr double kStep = 0.35;     // m: heights on a floor differ by less, feet and the first tread included
constexpr double kBeside = 0.2;    // m: railings stand on the outer side of floors
constexpr double kOnStairs = 0.6;  // m: heights on a link differ by less
constexpr double kShoulder = 0.3;  // m: from a link's width to its railings, or more

}  // namespace

std::size_t Storeys::nearestLevel(double height) const {
    const auto apart = [&](const authoring::Level& level) {
        return level.is_landing ? std::numeric_limits<double>::infinity() : std::abs(level.height - height);
    };
    return static_cast<std::size_t>(std::ranges::min_element(bake_.levels, {}, apart) - bake_.levels.begin());
}

std::optional<std::size_t> Storeys::levelAt(glm::dvec2 place, double height) const {
    if (bake_.has_grounds) return groundAt(place, height);
    for (std::size_t i = 0; i < bake_.levels.size(); ++i)
        if (std::abs(bake_.levels[i].height - height) < kStep && isWithin(bake_.levels[i].floor, place)) {
            // The first tread of a link that begins within a floor is as low.
            const auto link = linkAt(place, height);
            const bool climbs = link && std::abs(heightOf(*link, onLink(*link, place).x) - height) <
                                            std::abs(bake_.levels[i].height - height);
            if (!climbs) return i;
        }
    return std::nullopt;
}

/// Grounds are not level, and links are.
std::optional<std::size_t> Storeys::groundAt(glm::dvec2 place, double height) const {
    for (std::size_t i = 0; i < bake_.levels.size(); ++i)
        if (bake_.levels[i].is_landing && std::abs(bake_.levels[i].height - height) < kStep &&
            isWithin(bake_.levels[i].floor, place))
            return i;
    return linkAt(place, height) ? std::nullopt : std::optional(nearestLevel(height));
}

std::optional<std::size_t> Storeys::linkAt(glm::dvec2 place, double height) const {
    for (std::size_t i = 0; i < bake_.links.size(); ++i) {
        const glm::dvec2 at = onLink(i, place);
        if (at.x < 0.0 || at.x > lengthOf(i) || std::abs(at.y) > 0.5 * bake_.links[i].width + kShoulder)
            continue;
        if (std::abs(heightOf(i, at.x) - height) < kOnStairs) return i;
    }
    return std::nullopt;
}

std::optional<std::size_t> Storeys::storeyAt(glm::dvec2 place, double height) const {
    if (const auto level = levelAt(place, height)) return level;
    const auto link = linkAt(place, height);
    return link ? std::optional(bake_.levels.size() + *link) : std::nullopt;
}

glm::dvec2 Storeys::onLink(std::size_t link, glm::dvec2 place) const {
    const authoring::Link& on = bake_.links[link];
    const glm::dvec2 along = glm::normalize(on.end - on.begin), offset = place - on.begin;
    return {glm::dot(offset, along), along.x * offset.y - along.y * offset.x};
}

double Storeys::lengthOf(std::size_t link) const {
    return glm::distance(bake_.links[link].begin, bake_.links[link].end);
}

double Storeys::heightOf(std::size_t link, double along) const {
    const authoring::Link& on = bake_.links[link];
    const double low = on.heights ? on.heights->x : bake_.levels[on.from].height,
                 high = on.heights ? on.heights->y : bake_.levels[on.to].height;
    return low + (high - low) * std::clamp(along / lengthOf(link), 0.0, 1.0);
}

bool Storeys::isBeside(std::size_t level, glm::dvec2 place, glm::dvec2 heights) const {
    const authoring::Level& floor = bake_.levels[level];
    if (heights.x - kStep < floor.height && heights.y + kStep > floor.height &&
        distanceToPolygon(floor.floor, place) < kBeside)
        return true;
    const auto link = linkAt(place, 0.5 * (heights.x + heights.y));
    return link && (bake_.links[*link].from == level || bake_.links[*link].to == level);
}

bool Storeys::isWallBeside(std::size_t level, std::size_t wall) const {
    if (bake_.has_grounds)
        return nearestLevel(0.5 * (bake_.wall_ground[wall].x + bake_.wall_ground[wall].y)) == level;
    return std::ranges::any_of(bake_.walls[wall].points, [&](glm::dvec2 point) {
        return isBeside(level, point, bake_.wall_ground[wall]);
    });
}

}  // namespace throng::io
