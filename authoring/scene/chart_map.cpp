// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/chart_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "authoring/scene/raster.h"
#include "authoring/storeys/cabin.h"

namespace throng::authoring {

const gpu::ChartCell& ChartMap::at(glm::vec2 place) const {
    return cells[row(grid, place.y) * grid.width + column(grid, place.x)];
}

float ChartMap::slopeCostAt(glm::vec2 place) const {
    if (cell_costs.empty()) return 1.0f;
    return cell_costs[row(grid, place.y) * grid.width + column(grid, place.x)];
}

bool ChartMap::isGround(glm::vec2 place) const {
    return cell_costs.empty() || (at(place).charts >> 8 & gpu::NO_CHART) != gpu::NO_CHART;
}

glm::vec2 ChartMap::home(glm::vec2 place) const {
    if (empty()) return place;
    const std::uint32_t chart = chartAt(place);
    return chart == gpu::NO_CHART ? place : place - shifts[chart];
}

namespace {

constexpr double kFlat = 1.34;  // m/s, on flat ground

/// Speed in plan over that on flat ground (shaders/motion/slope_pace.glsl).
double paceOn(const MotionSettings& motion, bool stairs, double rise) {
    if (!motion.isOn("slope_pace")) return 1.0;
    const auto number = [&](const char* name) { return motion.number("slope_pace", name); };
    if (!stairs)
        return std::exp(-number("hiking") *
                        (std::abs(rise + number("fastest_down")) - number("fastest_down")));
    const double least = number(rise > 0.0 ? "stairs_up" : "stairs_down") / kFlat;
    return 1.0 + (least - 1.0) * std::min(std::abs(rise) / number("stairs_rise"), 1.0);
}

double slopeOf(const Chart& link) {
    return (link.link.high - link.link.low) / link.link.length;
}

/// m/s, in plan.
double beltSpeed(const Link& link, const Chart& chart) {
    return link.speed / std::sqrt(1.0 + slopeOf(chart) * slopeOf(chart));
}

float costOf(const Chart& chart, const Layout& layout) {
    if (!chart.is_link) return 1.0f;
    const MotionSettings& motion = layout.simulation.motion;
    const Link& link = layout.links[chart.index];
    const double slope = slopeOf(chart);
    if (!link.moves()) return costOfLink(motion, link.kind == Link::Kind::stairs, slope);
    return costOfBelt(motion, link.kind == Link::Kind::escalator, slope, beltSpeed(link, chart));
}

gpu::Belt beltOf(const Chart& chart, const Layout& layout, glm::dvec2 origin) {
    constexpr double kShoulder = 0.2;   // m: the middle of a lane from the edge of the steps
    constexpr double kTwoLanes = 0.85;  // m: steps from so wide on have room for two beside each other
    gpu::Belt belt{};
    if (!chart.is_link || !layout.links[chart.index].moves()) return belt;
    const Link& link = layout.links[chart.index];
    belt.velocity = glm::vec2(beltSpeed(link, chart) * chart.link.along);
    belt.begin = glm::vec2(chart.link.begin - origin);
    belt.along = glm::vec2(chart.link.along);
    belt.length = static_cast<float>(chart.link.length);
    belt.half_width = static_cast<float>(chart.link.half_width);
    belt.lane = link.width < kTwoLanes ? 0.0f : static_cast<float>(0.5 * link.width - kShoulder);
    belt.stand = link.stand == Link::Stand::left ? 1.0f : link.stand == Link::Stand::right ? -1.0f : 0.0f;
    belt.walking = static_cast<float>(link.walking);
    belt.has_steps = link.kind == Link::Kind::escalator ? 1 : 0;
    return belt;
}

/// Landings are a part of their link: nothing of the layout lies on them.
bool isLanding(const Chart& chart, const Layout& layout) {
    return !chart.is_link && !chart.floor.empty() && chart.index < layout.levels.size() &&
           layout.levels[chart.index].is_landing;
}

LiftMap liftsOf(const Charts& charts, glm::dvec2 origin) {
    const Layout& layout = charts.plane;
    LiftMap map;
    map.stop_of.assign(charts.charts.size(), gpu::NO_INDEX);
    for (std::uint32_t chart = 0; chart < charts.charts.size(); ++chart) {
        const Chart& each = charts.charts[chart];
        if (!each.is_cabin) continue;
        const Lift& lift = layout.links[each.index].lift;
        if (each.stop == 0) {
            const CabinSpots spots = spotsIn(layout, lift);
            const Footprint& cabin = each.link;
            const glm::dvec2 left(-cabin.along.y, cabin.along.x);
            const glm::dvec2 first(cabin.length - 0.5 * (kRailing + spots.apart.y),
                                   -0.5 * spots.apart.x * (spots.columns - 1.0));
            gpu::LiftPlan plan{};
            plan.corner = glm::vec2(cabin.at(first.x, first.y) - origin);
            plan.across = glm::vec2(left * spots.apart.x);
            plan.forward = glm::vec2(cabin.along * -spots.apart.y);
            plan.first_stop = static_cast<gpu::uint>(map.stops.size());
            plan.stop_count = static_cast<gpu::uint>(lift.levels.size());
            plan.capacity = capacityOf(layout, lift);
            plan.columns = spots.columns;
            plan.half_door = static_cast<float>(each.half_door);
            plan.half_width = static_cast<float>(cabin.half_width);
            plan.depth = static_cast<float>(cabin.length);
            plan.speed = static_cast<float>(lift.speed);
            plan.door_time = static_cast<float>(lift.door_time);
            plan.dwell = static_cast<float>(lift.dwell);
            map.plans.push_back(plan);
        }
        map.stop_of[chart] = static_cast<std::uint32_t>(map.stops.size());
        map.stops.push_back({glm::vec2(each.link.begin - origin), glm::vec2(each.link.along), chart,
                             static_cast<gpu::uint>(each.link_from), static_cast<float>(each.link.low),
                             static_cast<gpu::uint>(map.plans.size() - 1)});
    }
    return map;
}

/// From one stop to another, in no cells yet.
Detours::Ride rideOf(const gpu::LiftPlan& plan, const LiftMap& lifts, std::uint32_t from, std::uint32_t to) {
    constexpr double kInAndOut = 2.0;  // s, of each who waits
    const auto height = [&](std::uint32_t stop) { return double{lifts.stops[stop].height}; };
    Lift lift;
    lift.speed = plan.speed;
    lift.door_time = plan.door_time;
    lift.dwell = plan.dwell;
    const double whole = height(plan.first_stop + plan.stop_count - 1) - height(plan.first_stop);
    const double share = roundOfLift(lift, whole) / std::max(plan.capacity, 1u);
    return {0, 0, static_cast<float>(kFlat * timeByLift(lift, whole, height(to) - height(from))),
            static_cast<float>(kFlat * (share + kInAndOut)), from};
}

/// From the middle of a cabin at one stop to that at another.
std::vector<Detours::Ride> ridesOf(const ChartMap& map, const FieldGrid& grid) {
    const LiftMap& lifts = map.lifts;
    const auto cellOf = [&](const gpu::LiftPlan& plan, std::uint32_t stop) {
        const gpu::LiftStop& at = lifts.stops[stop];
        return cellAt(grid, at.begin + at.along * (0.5f * plan.depth) + map.shifts[at.chart]);
    };
    std::vector<Detours::Ride> rides;
    for (const gpu::LiftPlan& plan : lifts.plans)
        for (std::uint32_t i = 0; i < plan.stop_count; ++i)
            for (std::uint32_t j = 0; j < plan.stop_count; ++j) {
                const std::uint32_t from = plan.first_stop + i, to = plan.first_stop + j;
                if (i == j) continue;
                Detours::Ride& ride = rides.emplace_back(rideOf(plan, lifts, from, to));
                ride.from = cellOf(plan, from);
                ride.to = cellOf(plan, to);
            }
    return rides;
}

}  // namespace

float costOfLink(const MotionSettings& motion, bool stairs, double slope) {
    const double up = paceOn(motion, stairs, slope), down = paceOn(motion, stairs, -slope);
    return static_cast<float>(std::max(1.0, 0.5 * (1.0 / up + 1.0 / down)));
}

float costOfBelt(const MotionSettings& motion, bool stairs, double slope, double speed) {
    return static_cast<float>(kFlat / (kFlat * paceOn(motion, stairs, slope) + speed));
}

ChartMap makeChartMap(const Charts& charts, glm::vec2 minimum, glm::vec2 maximum, glm::dvec2 origin) {
    ChartMap map;
    map.grid.minimum = minimum;
    map.grid.cell_size = static_cast<float>(kChartCell);
    map.grid.width = static_cast<std::uint32_t>(std::ceil((maximum.x - minimum.x) / map.grid.cell_size));
    map.grid.height = static_cast<std::uint32_t>(std::ceil((maximum.y - minimum.y) / map.grid.cell_size));
    map.cells.assign(cellCount(map.grid), {gpu::NO_CHART | gpu::NO_CHART << 8, gpu::NO_IMAGES});
    map.most_images = charts.most_images;
    const glm::ivec2 corner = chartCellOf(origin + glm::dvec2(minimum) + 0.5 * kChartCell);
    for (std::uint32_t chart = 0; chart < charts.charts.size(); ++chart) {
        const ChartRaster& raster = charts.rasters[chart];
        map.shifts.emplace_back(charts.charts[chart].shift);
        const Chart& each = charts.charts[chart];
        map.is_link.push_back(each.is_link || isLanding(each, charts.plane));
        map.costs.push_back(costOf(each, charts.plane));
        map.belts.push_back(beltOf(each, charts.plane, origin));
        const glm::ivec2 shift(glm::round(charts.charts[chart].shift / kChartCell));
        for (int y = 0; y < raster.size().y; ++y)
            for (int x = 0; x < raster.size().x; ++x) {
                const glm::ivec2 cell = raster.first() + glm::ivec2(x, y);
                const glm::ivec2 at = cell + shift - corner;
                if (at.x < 0 || at.y < 0 || at.x >= static_cast<int>(map.grid.width) ||
                    at.y >= static_cast<int>(map.grid.height))
                    continue;
                map.cells[static_cast<std::size_t>(at.y) * map.grid.width + static_cast<std::size_t>(at.x)] =
                    {chart | raster.ownerAt(cell) << 8, raster.imagesAt(cell)};
            }
    }
    if (std::ranges::none_of(charts.plane.links, &Link::moves)) map.belts.clear();
    map.lifts = liftsOf(charts, origin);
    return map;
}

bool ChartMap::leadsAgainstBelt(glm::vec2 image) const {
    if (belts.empty()) return false;
    const gpu::ChartCell& cell = at(image);
    const std::uint32_t chart = cell.charts & gpu::NO_CHART, owner = cell.charts >> 8 & gpu::NO_CHART;
    if (chart == gpu::NO_CHART || owner == gpu::NO_CHART || chart == owner) return false;
    const glm::vec2 there = home(image);
    const auto along = [&](const gpu::Belt& belt) { return glm::dot(there - belt.begin, belt.along); };
    if (isBelt(chart) && along(belts[chart]) < 0.5f * belts[chart].length) return true;
    return isBelt(owner) && along(belts[owner]) > 0.5f * belts[owner].length;
}

SeamCells seamCellsOf(const ChartMap& map, const FieldGrid& grid) {
    SeamCells seams;
    seams.blocked.assign(cellCount(grid), 0);
    seams.owner_of.resize(cellCount(grid));
    for (std::uint32_t y = 0; y < grid.height; ++y)
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const std::uint32_t cell = y * grid.width + x;
            seams.owner_of[cell] = cell;
            const glm::vec2 middle = cellCentre(grid, x, y);
            const gpu::ChartCell here = map.at(middle);
            const std::uint32_t chart = here.charts & gpu::NO_CHART, owner = here.charts >> 8 & gpu::NO_CHART;
            if (owner == chart && owner != gpu::NO_CHART) continue;
            seams.blocked[cell] = 1;
            if (owner == gpu::NO_CHART) continue;
            seams.owner_of[cell] = cellAt(grid, middle + map.shifts[owner] - map.shifts[chart]);
            seams.shown.push_back({cell, seams.owner_of[cell]});
        }
    std::sort(seams.shown.begin(), seams.shown.end(),
              [](const SeamCells::Shown& a, const SeamCells::Shown& b) {
                  return std::pair(a.owner, a.image) < std::pair(b.owner, b.image);
              });
    seams.rides = ridesOf(map, grid);
    return seams;
}

}  // namespace throng::authoring
