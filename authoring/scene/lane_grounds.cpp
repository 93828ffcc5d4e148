// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/lane_grounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "authoring/storeys/chart_raster.h"
#include "base/polygon.h"
#include "shaders/shared/traffic_types.h"

namespace throng::authoring {
namespace {

constexpr double kLaneLook = 0.25;   // m
constexpr int kLooksAside = 16;      // to either side
constexpr double kWidestBody = 1.3;  // m: half of the widest vehicle
constexpr double kHeeded = 0.6;      // m beside it: drivers stop for people there

/// Half of the strip along a lane in which drivers look for people, m.
double heededBeside(const Lane& lane) {
    return std::max(0.5 * lane.width, kWidestBody) + kHeeded;
}

/// Calls look(place, along) at places along a lane.
template <class Look>
void walkLane(const Lane& lane, Look look) {
    for (std::size_t i = 1; i < lane.points.size(); ++i) {
        const glm::dvec2 from = lane.points[i - 1], to = lane.points[i];
        const double length = glm::distance(from, to);
        if (length == 0.0) continue;
        const int looks = std::max(1, static_cast<int>(std::ceil(length / kLaneLook)));
        for (int at = 0; at <= looks; ++at)
            look(glm::mix(from, to, static_cast<double>(at) / looks), (to - from) / length);
    }
}

void tellNoGround(const SourcePosition& where, const std::string& what, glm::dvec2 at,
                  Diagnostics& diagnostics) {
    diagnostics.error(
        where, fmt::format("{}: there is no ground of the terrain at ({:.2f}, {:.2f})", what, at.x, at.y),
        "move the one or the other");
}

/// Where it leaves the terrain, as it may at its ends, it goes on as before.
void layLane(Lane& lane, const TerrainPlaces& places, const std::vector<Chart>& charts,
             Diagnostics& diagnostics) {
    std::optional<std::size_t> chart;
    bool told = false;
    walkLane(lane, [&](glm::dvec2 place, glm::dvec2) {
        const std::uint32_t spot = places.spotAt(place, lane.level);
        if (spot == kNoSpot || told) return;
        const std::size_t here = places.chartOf()[spot];
        if (chart && here != *chart) {
            told = true;
            diagnostics.error(
                lane.where,
                fmt::format("lane `{}` leads from the ground `{}` onto `{}` at ({:.2f}, {:.2f})", lane.id,
                            charts[*chart].name, charts[here].name, place.x, place.y),
                "a lane lies on one ground: end it there, or name the `level` that it is on");
        }
        chart = chart.value_or(here);
    });
    if (!chart)
        return tellNoGround(lane.where, fmt::format("lane `{}`", lane.id), lane.points.front(), diagnostics);
    lane.level = *chart;
}

/// A lane's points, and how far vehicles are beyond its two ends: they come in from behind the first, leave
/// beyond the last, and people keep off what they may reach.
std::vector<glm::dvec2> withBeyond(const Lane& lane) {
    constexpr double kHeedAhead = 10.0;  // m: about as far as people sense
    double longest = 0.0;
    for (const VehicleType& type : kVehicleTypes)
        longest = std::max(longest, type.length);
    const double before = longest + kHeedAhead, after = before + double{gpu::VEHICLE_LOOK_AHEAD} * lane.speed;
    std::vector<glm::dvec2> points = lane.points;
    const auto beyond = [&](glm::dvec2 end, glm::dvec2 inside, double by) {
        const double length = glm::distance(end, inside);
        if (length > 0.0) points.push_back(end + (end - inside) / length * by);
    };
    beyond(lane.points.front(), lane.points[1], before);
    beyond(lane.points.back(), lane.points[lane.points.size() - 2], after);
    return points;
}

void include(Chart& chart, const std::vector<glm::dvec2>& points, double beside) {
    for (const glm::dvec2 point : points) {
        auto& [lower, upper] = chart.room ? *chart.room : chart.room.emplace(chart.bounds());
        lower = glm::min(lower, point - beside);
        upper = glm::max(upper, point + beside);
    }
}

void checkPlatforms(const Layout& placed, const Lane& lane, const std::vector<Chart>& charts,
                    Diagnostics& diagnostics) {
    for (const LaneStop& stop : lane.stops) {
        if (!stop.platform) continue;
        const Area& area = placed.areas[stop.platform->area];
        if (area.level == lane.level) continue;
        diagnostics.error(
            stop.where,
            fmt::format("platform `{}` of lane `{}` is area `{}`, which lies on another ground, `{}`",
                        stop.platform->id, lane.id, area.id, charts[area.level].name),
            "give the area and the lane the same `level`");
    }
}

}  // namespace

void layLanes(Layout& placed, const TerrainPlaces& places, std::vector<Chart>& charts,
              Diagnostics& diagnostics) {
    for (Lane& lane : placed.traffic.lanes) {
        layLane(lane, places, charts, diagnostics);
        if (diagnostics.hasErrors()) continue;
        include(charts[lane.level], withBeyond(lane), heededBeside(lane));
    }
    for (Zebra& crossing : placed.traffic.crossings) {
        const std::uint32_t spot = places.spotIn(crossing.polygon, crossing.level);
        if (spot == kNoSpot)
            tellNoGround(crossing.where, fmt::format("crossing `{}`", crossing.id), crossing.polygon.front(),
                         diagnostics);
        else
            crossing.level = places.chartOf()[spot];
    }
}

void checkLanes(const Layout& placed, const Charts& charts, Diagnostics& diagnostics) {
    const auto otherAt = [&](std::size_t chart, glm::dvec2 place) -> const Chart* {
        const std::uint32_t owner = charts.rasters[chart].ownerOf(place);
        return owner == gpu::NO_CHART || owner == chart ? nullptr : &charts.charts[owner];
    };
    const auto tell = [&](const SourcePosition& where, const std::string& what, std::size_t chart,
                          const Chart& other, glm::dvec2 at) {
        diagnostics.error(
            where,
            fmt::format("{} comes to where the ground `{}` goes on as `{}`, at ({:.2f}, {:.2f})", what,
                        charts.charts[chart].name, other.name, at.x, at.y),
            "drivers know of people on their own ground only: keep it off that place");
    };
    for (const Lane& lane : placed.traffic.lanes) {
        checkPlatforms(placed, lane, charts.charts, diagnostics);
        bool told = false;
        walkLane(lane, [&](glm::dvec2 place, glm::dvec2 along) {
            const glm::dvec2 left(-along.y, along.x);
            for (int look = -kLooksAside; !told && look <= kLooksAside; ++look) {
                const glm::dvec2 at = place + heededBeside(lane) * look / kLooksAside * left;
                if (const Chart* other = otherAt(lane.level, at)) {
                    tell(lane.where, fmt::format("lane `{}`", lane.id), lane.level, *other, at);
                    told = true;
                }
            }
        });
    }
    for (const Zebra& crossing : placed.traffic.crossings) {
        const auto [first, last] = cellsRound(crossing.polygon);
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const glm::dvec2 place = chartCellMiddle({x, y});
                const Chart* other =
                    isWithin(crossing.polygon, place) ? otherAt(crossing.level, place) : nullptr;
                if (!other) continue;
                tell(crossing.where, fmt::format("crossing `{}`", crossing.id), crossing.level, *other,
                     place);
                x = last.x;
                y = last.y;
            }
    }
}

}  // namespace throng::authoring
