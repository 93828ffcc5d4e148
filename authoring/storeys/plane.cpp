// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/plane.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "authoring/layout/patch_sizes.h"
#include "authoring/storeys/railings.h"

namespace throng::authoring {
namespace {

double upwards(double value) {
    return std::ceil(value / double{gpu::SHIFT_STEP}) * double{gpu::SHIFT_STEP};
}

std::pair<glm::dvec2, glm::dvec2> roomOf(const Chart& chart) {
    return chart.room ? *chart.room : chart.bounds();
}

/// Side by side in rows, the first chart where it is: of two margins and a little more between any two, so
/// that nobody senses from one into the other.
void shiftCharts(std::vector<Chart>& charts, double reach) {
    const double margin = reach + 2.0;
    double area = 0.0, widest = 0.0;
    for (const Chart& chart : charts) {
        const auto [lower, upper] = roomOf(chart);
        const glm::dvec2 size = upper - lower + 2.0 * margin;
        area += size.x * size.y;
        widest = std::max(widest, size.x);
    }
    const double row_width = std::max(widest, std::sqrt(area));
    const auto [origin, first_upper] = roomOf(charts.front());
    glm::dvec2 corner(origin.x - margin, origin.y - margin);
    double row_height = 0.0, x = corner.x, y = corner.y;
    for (Chart& chart : charts) {
        const auto [lower, upper] = roomOf(chart);
        const glm::dvec2 size = upper - lower + 2.0 * margin;
        if (x > corner.x && x + size.x > corner.x + row_width) {
            x = corner.x;
            y += row_height;
            row_height = 0.0;
        }
        chart.shift = {upwards(x + margin - lower.x), upwards(y + margin - lower.y)};
        if (&chart == &charts.front()) chart.shift = glm::dvec2(0.0);
        x += size.x + double{gpu::SHIFT_STEP};
        row_height = std::max(row_height, size.y + double{gpu::SHIFT_STEP});
    }
}

void moveFormation(Formation& formation, glm::dvec2 by) {
    if (auto* circle = std::get_if<CircleFormation>(&formation.shape)) circle->centre += by;
    if (auto* grid = std::get_if<GridFormation>(&formation.shape)) {
        grid->origin += by;
        if (auto* line = std::get_if<Line>(&grid->goal)) *line = {line->a + by, line->b + by};
        if (auto* box = std::get_if<Extent>(&grid->goal)) *box = {box->a + by, box->b + by};
    }
    if (auto* list = std::get_if<ListFormation>(&formation.shape))
        for (ListedAgent& agent : list->agents) {
            agent.position += by;
            agent.goal += by;
            for (Waypoint& waypoint : agent.via)
                waypoint.point += by;
        }
}

std::size_t levelOf(const Layout& layout, const Place& place) {
    if (place.kind == Place::Kind::aisle) return layout.seats[place.index].mouths.level;
    return place.kind == Place::Kind::area ? layout.areas[place.index].level
                                           : layout.roads[place.index].level;
}

}  // namespace

/// m: as far as people sense, and the tiles of those whom they sense there.
double reachOf(const Layout& layout) {
    double largest = 0.3;
    for (const Flow& flow : layout.flows)
        largest = std::max(largest, flow.people.largestRadius());
    for (const Formation& formation : layout.formations)
        largest = std::max(largest, formation.people.largestRadius());
    for (const GivenPeople& given : layout.given)
        largest = std::max(largest, given.people.largestRadius());
    largest *= double{sizeBounds(layout.patches).most};
    const double tile = std::max(layout.simulation.tile_radius, largest);
    const double sight = largest + layout.simulation.samples_per_ray * tile;
    return std::max(sight, layout.simulation.contact_range + 2.0 * largest) + tile;
}

void movePoints(std::vector<glm::dvec2>& points, glm::dvec2 by) {
    for (glm::dvec2& point : points)
        point += by;
}

/// Everything of the layout to where its chart lies.
Layout moved(const Layout& layout, const std::vector<Chart>& charts, const GivenCharts& given) {
    Layout plane = layout;
    for (Road& road : plane.roads)
        movePoints(road.centreline, charts[road.level].shift);
    for (Area& area : plane.areas) {
        movePoints(area.polygon, charts[area.level].shift);
        if (area.facing) *area.facing += charts[area.level].shift;
    }
    for (Patch& patch : plane.patches)
        movePoints(patch.polygon, charts[patch.level].shift);
    for (Behaviour& behaviour : plane.behaviours)
        for (BehaviourState& state : behaviour.states) {
            if (state.to.places.empty()) continue;
            const glm::dvec2 shift = charts[levelOf(layout, state.to.places.front())].shift;
            movePoints(state.line, shift);
            if (state.facing) *state.facing += shift;
        }
    for (Wall& wall : plane.walls)
        movePoints(wall.points, charts[wall.level].shift);
    for (Lane& lane : plane.traffic.lanes) {
        movePoints(lane.points, charts[lane.level].shift);
        for (LaneStop& stop : lane.stops)
            stop.at += charts[lane.level].shift;
    }
    for (Zebra& crossing : plane.traffic.crossings)
        movePoints(crossing.polygon, charts[crossing.level].shift);
    for (Flow& flow : plane.flows)
        for (BehaviourState& stop : flow.via) {
            const glm::dvec2 shift = charts[levelOf(layout, stop.to.places.front())].shift;
            movePoints(stop.line, shift);
            if (stop.facing) *stop.facing += shift;
        }
    for (Formation& formation : plane.formations)
        moveFormation(formation, charts[formation.level].shift);
    // People in rows are in nobody's way: wherever they are, they are as if on the ground from which they
    // come.
    for (SeatBlock& block : plane.seats) {
        block.shift = charts[block.mouths.level].shift;
        movePoints(block.front, block.shift);
        if (block.facing) *block.facing += block.shift;
    }
    for (std::size_t group = 0; group < plane.given.size(); ++group)
        for (std::size_t way = 0; way < plane.given[group].ways.size(); ++way)
            for (std::size_t point = 0; point < plane.given[group].ways[way].size(); ++point)
                plane.given[group].ways[way][point].place += charts[given[group][way][point]].shift;
    return plane;
}

void layInPlane(Charts& charts) {
    shiftCharts(charts.charts, charts.reach);
    for (std::size_t i = 0; i < charts.charts.size(); ++i)
        charts.rasters.emplace_back(charts.charts, i, charts.reach);
    for (std::size_t i = 0; i < charts.charts.size(); ++i) {
        charts.rasters[i].leaveOutUnseen(charts.charts, charts.rasters, i);
        charts.most_images = std::max(charts.most_images, charts.rasters[i].mostImages());
    }
}

void copyWallsIntoMargins(Charts& charts, const std::vector<StandingWall>& standing) {
    for (std::size_t chart = 0; chart < charts.charts.size(); ++chart) {
        const ChartRaster& raster = charts.rasters[chart];
        for (const auto& [index, owner] : standing) {
            if (owner == chart || !raster.isJoinedTo(owner)) continue;
            const Wall& wall = charts.walls[index];
            if (!wall.toggles.empty()) continue;
            std::vector<glm::dvec2> line = wall.points;
            if (wall.closed) line.push_back(line.front());
            const double thickness = wall.closed ? 0.0 : wall.thickness;
            for (std::vector<glm::dvec2>& part :
                 partsInMargin(charts.charts[chart], raster, owner, line, 0.5 * thickness)) {
                Wall copy = wall;
                copy.id =
                    fmt::format("{}:{}:{}", wall.id, charts.charts[chart].name, charts.plane.walls.size());
                copy.closed = false;
                copy.thickness = thickness;
                copy.points = std::move(part);
                movePoints(copy.points, charts.charts[chart].shift);
                charts.plane.walls.push_back(std::move(copy));
            }
        }
    }
}

}  // namespace throng::authoring
