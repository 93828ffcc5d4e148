// SPDX-License-Identifier: Apache-2.0
#include <functional>

#include "authoring/scene/chart_map.h"
#include "authoring/scene/patches.h"
#include "authoring/scene/raster.h"
#include "authoring/scene/slope_costs.h"

namespace throng::authoring {
namespace {

constexpr float kWallCost = 4.0f;  // added at the wall itself

/// Distance from every cell's centre to the nearest wall surface, as far as `reach`; infinity beyond.
std::vector<float> wallDistance(const WalkGeometry& geometry, const FieldGrid& grid, float reach) {
    std::vector<float> distance(cellCount(grid), kUnreachable);
    for (const gpu::WallSegment& wall : geometry.walls) {
        visitAlong(grid, wall.a, wall.b, reach + wall.half_thickness,
                   [&](std::uint32_t cell, glm::vec2 centre) {
                       const float here = segmentDistance(centre, wall.a, wall.b) - wall.half_thickness;
                       if (here < reach) distance[cell] = std::min(distance[cell], here);
                   });
    }
    return distance;
}

void blockWalls(const WalkGeometry& geometry, WalkMap& map) {
    const WallCost wall_cost(geometry, map.grid.cell_size);
    const std::vector<float> distance = wallDistance(geometry, map.grid, wall_cost.reach());
    for (std::size_t cell = 0; cell < distance.size(); ++cell)
        map.cost[cell] += wall_cost(distance[cell]);
    for (const LocalPolygon& solid : geometry.solids)
        visitInside(map.grid, solid, [&](std::uint32_t cell, glm::vec2) { map.cost[cell] = kUnreachable; });
}

void markOneWays(const WalkGeometry& geometry, WalkMap& map) {
    if (std::none_of(geometry.roads.begin(), geometry.roads.end(),
                     [](const LocalRoad& road) { return road.one_way; }))
        return;
    map.one_way.assign(cellCount(map.grid), glm::vec2(0.0f));
    const auto is_free = [&](std::uint32_t cell) { return map.one_way[cell] == glm::vec2(0.0f); };
    // Where several lie over each other, the last piece of the last road holds.
    for (auto road = geometry.roads.rbegin(); road != geometry.roads.rend(); ++road) {
        if (!road->one_way) continue;
        for (std::size_t i = road->centreline.size(); i-- > 1;) {
            const LocalRoad piece{{road->centreline[i - 1], road->centreline[i]}, road->width, true};
            const glm::vec2 along = glm::normalize(piece.centreline[1] - piece.centreline[0]);
            visitRoad(
                map.grid, piece, 0.0f, [&](std::uint32_t cell, glm::vec2) { map.one_way[cell] = along; },
                is_free);
        }
    }
    // Where another road or an area lies over it, one may also walk that road's way.
    const auto release = [&](std::uint32_t cell, glm::vec2) { map.one_way[cell] = glm::vec2(0.0f); };
    for (const LocalRoad& road : geometry.roads)
        if (!road.one_way) visitRoad(map.grid, road, 0.0f, release, std::not_fn(is_free));
    for (const LocalPolygon& area : geometry.areas)
        visitInside(map.grid, area, release);
}

/// Cells of the grids of charts fit together wherever shifts take them; doors stay open on cells of a quarter
/// metre.
float chartCellSize(float wanted) {
    constexpr float kDoorCell = 0.25f;
    const float size = std::exp2(std::ceil(std::log2(wanted) - 1.0e-4f));
    return wanted <= 2.0f * kDoorCell ? std::min(size, kDoorCell) : size;
}

/// Stairs and ramps cost the time that they take.
void chargeLinks(const ChartMap& charts, WalkMap& map) {
    for (std::uint32_t cell = 0; cell < map.cost.size(); ++cell) {
        const glm::vec2 at = cellCentre(map.grid, cell % map.grid.width, cell / map.grid.width);
        const std::uint32_t chart = charts.chartAt(at);
        if (chart != gpu::NO_CHART) map.cost[cell] *= charts.costs[chart] * charts.slopeCostAt(at);
    }
}

}  // namespace

void blockOthers(const ChartMap& charts, WalkMap& map) {
    SeamCells seams = seamCellsOf(charts, map.grid);
    // There is no way against ground that moves.
    std::erase_if(seams.shown, [&](const SeamCells::Shown& shown) {
        return charts.leadsAgainstBelt(
            cellCentre(map.grid, shown.image % map.grid.width, shown.image / map.grid.width));
    });
    // Where a wall stands on one side of what another chart shows, as round the opening over a flight of
    // stairs, there is no way over it either.
    std::erase_if(seams.shown, [&](const SeamCells::Shown& shown) {
        return map.cost[shown.image] == kUnreachable && map.cost[shown.owner] < kUnreachable;
    });
    map.seams = std::make_shared<const SeamCells>(std::move(seams));
    for (std::size_t cell = 0; cell < map.cost.size(); ++cell)
        if (map.seams->blocked[cell]) map.cost[cell] = kUnreachable;
}

// How near to a wall a cell's centre may be: at least so that walls without thickness leave no gap between
// cells, and less than the smallest body needs by half a cell, so that rasterising never closes a door that
// a body fits through.
WallCost::WallCost(const WalkGeometry& geometry, float cell_size)
    : comfort_(geometry.largest_radius + geometry.wall_comfort),
      clearance_(std::max(0.6f * cell_size, 0.9f * geometry.smallest_radius - 0.5f * cell_size)) {}

float WallCost::operator()(float distance) const {
    if (distance < clearance_) return kUnreachable;
    if (distance >= comfort_) return 0.0f;
    const float nearness = 1.0f - distance / comfort_;
    return kWallCost * nearness * nearness;
}

FieldGrid makeGrid(const WalkGeometry& geometry, float smallest_cell, double most_cells) {
    const glm::vec2 extent = geometry.maximum - geometry.minimum;
    FieldGrid grid;
    grid.minimum = geometry.minimum;
    const double area = static_cast<double>(extent.x) * static_cast<double>(extent.y);
    grid.cell_size = std::max(smallest_cell, static_cast<float>(std::sqrt(area / most_cells)));
    // What is long and thin has more cells along its edges than its area tells.
    const auto along = [&](float length) {
        return std::max(2.0, std::ceil(double{length} / double{grid.cell_size}));
    };
    while (along(extent.x) * along(extent.y) > 2.0 * most_cells)
        grid.cell_size *= 1.25f;
    if (geometry.charts) grid.cell_size = chartCellSize(grid.cell_size);
    grid.width = std::max(2u, static_cast<std::uint32_t>(std::ceil(extent.x / grid.cell_size)));
    grid.height = std::max(2u, static_cast<std::uint32_t>(std::ceil(extent.y / grid.cell_size)));
    return grid;
}

WalkMap makeWalkMap(const WalkGeometry& geometry, const FieldGrid& grid, bool keep_to_roads) {
    WalkMap map;
    map.grid = grid;
    map.cost.assign(cellCount(grid), 1.0f);
    if (keep_to_roads && geometry.hasKerbs()) {
        const std::vector<float> distance = roadDistance(geometry, grid);
        for (std::size_t cell = 0; cell < distance.size(); ++cell)
            if (distance[cell] < 0.0f) map.cost[cell] = kOffRoadCost;
        markOneWays(geometry, map);
    }
    blockWalls(geometry, map);
    chargePatches(geometry.costly, grid, map.cost);
    if (geometry.slopes)
        for (std::uint32_t cell = 0; cell < map.cost.size(); ++cell)
            map.cost[cell] *= geometry.slopes->at(cellCentre(grid, cell % grid.width, cell / grid.width));
    if (geometry.charts) {
        blockOthers(*geometry.charts, map);
        chargeLinks(*geometry.charts, map);
    }
    return map;
}

std::vector<std::uint32_t> cellsInPolygon(const FieldGrid& grid, const LocalPolygon& polygon) {
    std::vector<std::uint32_t> cells;
    visitInside(grid, polygon, [&](std::uint32_t cell, glm::vec2) { cells.push_back(cell); });
    if (cells.empty()) {
        glm::vec2 middle(0.0f);
        for (const glm::vec2 point : polygon)
            middle += point / static_cast<float>(polygon.size());
        cells.push_back(cellAt(grid, middle));
    }
    return cells;
}

std::uint32_t cellAt(const FieldGrid& grid, glm::vec2 point) {
    return row(grid, point.y) * grid.width + column(grid, point.x);
}

}  // namespace throng::authoring
