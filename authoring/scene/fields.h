// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

#include "authoring/scene.h"
#include "authoring/scene/distance_solver.h"

namespace throng::authoring {

class WallGrid;

/// A road or an area in the scene frame (m).
struct LocalRoad {
    std::vector<glm::vec2> centreline;
    float width = 3.0f;
    bool one_way = false;
};
using LocalPolygon = std::vector<glm::vec2>;

/// What the rasters are made from, all in the scene frame.
struct WalkGeometry {
    glm::vec2 minimum{0.0f};
    glm::vec2 maximum{0.0f};
    std::vector<gpu::WallSegment> walls;
    std::vector<LocalPolygon> solids;  ///< closed walls: nobody is inside
    std::vector<LocalRoad> roads;
    std::vector<LocalPolygon> areas;
    float smallest_radius = 0.25f;  ///< of all people, m
    float largest_radius = 0.25f;
    std::shared_ptr<const WallGrid> wall_grid = {};  ///< where there are very many walls
    struct Box {
        glm::vec2 lower, upper;
    };
    std::vector<Box> solid_boxes = {};  ///< of each solid, if sortWalls() has made them
};

/// The grid for a scene: cells of 0.1 to 1 m, at most about 1.5 million of them.
FieldGrid makeGrid(const WalkGeometry& geometry);
/// The same with cells of at least `smallest_cell` (m), at most `most_cells` of them.
FieldGrid makeGrid(const WalkGeometry& geometry, float smallest_cell, double most_cells);

/// @param keep_to_roads whether ground outside roads and areas costs several times more, and one-way roads
/// bind
WalkMap makeWalkMap(const WalkGeometry& geometry, const FieldGrid& grid, bool keep_to_roads);

/// The same ground in larger cells.
struct CoarseMap {
    WalkMap map;
    /// Per fine cell, the coarse cell that stands for it; gpu::NO_INDEX where none does: in walls, and in
    /// lesser pieces of free ground that share a coarse cell with a larger one.
    std::vector<std::uint32_t> cell_of;
    std::vector<float> free_share;  ///< of each coarse cell, by area
};

/// Doors stay open and walls closed, however thin.
CoarseMap coarsen(const WalkMap& fine, const FieldGrid& coarse);

/// Signed distance to the edge of the union of roads and areas, m, positive inside, at every cell's centre.
/// Empty without roads.
std::vector<float> roadDistance(const WalkGeometry& geometry, const FieldGrid& grid);

/// One solved distance field.
struct Field {
    std::vector<gpu::FieldCell> cells;  ///< finite everywhere, as the GPU wants them
    std::vector<float> reachable;  ///< the same distances, kUnreachable where no path leads to the target
};

/// Walking distance to the nearest target cell (Eikonal equation) and the way downhill.
/// @param targets cell indices; blocked ones among them are ignored
/// @param solver null: fast marching (Sethian 1996), here
Field solveField(const WalkMap& map, std::span<const std::uint32_t> targets,
                 DistanceSolver* solver = nullptr);

/// Cells whose centre lies in the polygon, and for thin polygons at least the cell of its middle.
std::vector<std::uint32_t> cellsInPolygon(const FieldGrid& grid, const LocalPolygon& polygon);

/// The cell of a point, clamped to the grid.
std::uint32_t cellAt(const FieldGrid& grid, glm::vec2 point);

}  // namespace throng::authoring
