// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/given_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "base/polygon.h"

namespace throng::authoring {
namespace {

bool isWithinOutline(const Chart& floor, glm::dvec2 place) {
    constexpr double kHair = 1.0e-3;  // m: on the floor's edge is on the floor
    return distanceToPolygon(floor.floor, place) <= kHair;
}

bool isOnFloor(const Chart& floor, glm::dvec2 place) {
    return floor.contains(place) || (!isWithin(floor.floor, place) && isWithinOutline(floor, place));
}

/// Where a way first leaves a floor: at a point of it, or between two.
std::optional<GivenPoint> leaves(const std::vector<GivenPoint>& way, const Chart& floor) {
    constexpr double kLook = 0.1;  // m
    constexpr double kMostLooks = 1.0e5;
    if (!isOnFloor(floor, way.front().place)) return way.front();
    for (std::size_t i = 1; i < way.size(); ++i) {
        const GivenPoint &a = way[i - 1], &b = way[i];
        const double apart = glm::distance(a.place, b.place);
        const int looks = static_cast<int>(std::clamp(std::ceil(apart / kLook), 1.0, kMostLooks));
        for (int look = 1; look <= looks; ++look) {
            const double share = static_cast<double>(look) / looks;
            const GivenPoint at{glm::mix(a.time, b.time, share), glm::mix(a.place, b.place, share)};
            if (!isOnFloor(floor, at.place)) return at;
        }
    }
    return std::nullopt;
}

void tell(const GivenPeople& given, const Chart& floor, std::size_t person, const GivenPoint& at,
          std::size_t others, Diagnostics& diagnostics) {
    const bool is_open = isWithinOutline(floor, at.place);
    std::string text =
        fmt::format("given `{}`: person {} {} level `{}` at [{:.6g}, {:.6g}], at {:.6g} s", given.id, person,
                    is_open ? "is where stairs or lifts leave no room on" : "is beyond the floor of",
                    floor.name, at.place.x, at.place.y, at.time);
    if (others > 0) text += fmt::format(", and {} more of them likewise", others);
    diagnostics.error(given.file.empty() ? given.where : given.file_where, text,
                      is_open
                          ? "a way is on the floor of one level from begin to end: end it before that place"
                          : "a way is on the floor of one level from begin to end: name its `level`, set "
                            "their `offset`, or end it at the floor's edge");
}

}  // namespace

void checkGivenWays(const Layout& layout, const std::vector<Chart>& charts, Diagnostics& diagnostics) {
    for (const GivenPeople& given : layout.given) {
        const Chart& floor = charts[given.level];
        std::optional<GivenPoint> first;
        std::size_t person = 0, count = 0;
        for (std::size_t i = 0; i < given.ways.size(); ++i) {
            const std::optional<GivenPoint> at = leaves(given.ways[i], floor);
            if (!at) continue;
            if (count++ > 0) continue;
            first = at;
            person = i;
        }
        if (first) tell(given, floor, person, *first, count - 1, diagnostics);
    }
}

}  // namespace throng::authoring
