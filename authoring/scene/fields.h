// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
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

/// Ground that is worth a way round it.
struct CostlyGround {
    LocalPolygon outline;
    float cost = 1.0f;           ///< per metre
    bool is_for_a_time = false;  ///< then only detours know (Patches::Costs)

    /// Whether somebody who walks straight from a to b walks on it.
    bool meets(glm::vec2 a, glm::vec2 b) const;
};

inline constexpr float kWallComfort = 0.2f;  // m

class SlopeCosts;

/// What the rasters are made from, all in the scene frame.
struct WalkGeometry {
    glm::vec2 minimum{0.0f};
    glm::vec2 maximum{0.0f};
    std::vector<gpu::WallSegment> walls;
    std::vector<LocalPolygon> solids;  ///< closed walls: nobody is inside
    std::vector<LocalRoad> roads;
    std::vector<LocalPolygon> areas;
    std::vector<CostlyGround> costly;
    bool has_crossings = false;  ///< among the areas: then people keep to the ground without roads, too
    float smallest_radius =
        0.25f;  ///< of all people, m; of bodies that are no discs, half of the shorter side
    float largest_radius = 0.25f;
    float wall_comfort = kWallComfort;  ///< m beyond the largest radius: nearer to a wall, walking costs more
    std::shared_ptr<const WallGrid> wall_grid = {};  ///< where there are very many walls
    struct Box {
        glm::vec2 lower, upper;
    };
    std::vector<Box> solid_boxes = {};              ///< of each solid, if sortWalls() has made them
    std::shared_ptr<const ChartMap> charts = {};    ///< null: a layout without levels
    std::shared_ptr<const SlopeCosts> slopes = {};  ///< null: flat ground, or that of charts

    /// Whether the straight way may not be the best one.
    bool hasObstacles() const { return !walls.empty() || !costly.empty(); }
    /// Whether there is anything to keep to.
    bool hasKerbs() const { return !roads.empty() || has_crossings; }
};

inline constexpr float kSmallestCell = 0.1f;     ///< m
inline constexpr double kMostCells = 400'000.0;  ///< about

/// A grid over all the ground: cells of at least `smallest_cell` (m), at most `most_cells` of them. With
/// charts, cells are a power of two of a metre, and there may be more.
FieldGrid makeGrid(const WalkGeometry& geometry, float smallest_cell = kSmallestCell,
                   double most_cells = kMostCells);

/// Per metre, where patches lie over each other: a front goes on by small steps, so costs may not grow for
/// ever.
inline constexpr float kMostPatchCost = 400.0f;

/// What ground costs with one more patch on it.
inline float charged(float cost, float patch) {
    return cost < kMostPatchCost ? std::min(cost * patch, kMostPatchCost) : cost;
}

inline constexpr float kOffRoadCost = 6.0f;  ///< per metre off the roads, for those who keep to them

/// What walking near a wall costs more, per metre.
class WallCost {
  public:
    WallCost(const WalkGeometry& geometry, float cell_size);
    /// @param distance from a cell's middle to the wall's surface, m
    float operator()(float distance) const;
    /// Walls further away cost nothing, m.
    float reach() const { return std::max(comfort_, clearance_); }

  private:
    float comfort_;
    float clearance_;
};

/// @param keep_to_roads whether ground outside roads and areas costs several times more, and one-way roads
/// bind
WalkMap makeWalkMap(const WalkGeometry& geometry, const FieldGrid& grid, bool keep_to_roads);

/// Makes a map that of charts: people walk on their own chart's ground, and over seams.
void blockOthers(const ChartMap& charts, WalkMap& map);

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
    std::vector<bool> is_reached;       ///< of each cell, whether a path leads from it to the target
    std::vector<float>
        reachable;  ///< what that path costs, kUnreachable where there is none; may be left out

    /// Metres from there to the target, kUnreachable where no path leads.
    float lengthFrom(std::uint32_t cell) const {
        return is_reached[cell] ? std::abs(cells[cell].distance) : kUnreachable;
    }
};

/// From where a body can walk straight to a point.
struct StraightWays {
    glm::vec2 to{0.0f};
    std::vector<std::uint8_t> from;  ///< of each cell, 0 or 1
    bool is_start = true;            ///< the distance along them is the field's
};

/// Walking distance to the nearest target cell (Eikonal equation) and the way downhill.
/// @param targets cell indices; blocked ones among them are ignored
/// @param solver null: fast marching (Sethian 1996), here
/// @param straight to the target's middle, null: not asked for
Field solveField(const WalkMap& map, std::span<const std::uint32_t> targets, DistanceSolver* solver = nullptr,
                 const StraightWays* straight = nullptr);

/// The lengths (m) of the ways that lead downhill on `distance`, which counts bad ground several times.
/// @param start where it began
std::vector<float> wayLengths(const WalkMap& map, const std::vector<float>& distance,
                              const std::vector<float>& start);

/// @param straight whether the rest of the way is
gpu::FieldCell packFieldCell(float length, glm::vec2 direction, bool straight);

/// Cells whose centre lies in the polygon, and for thin polygons at least the cell of its middle.
std::vector<std::uint32_t> cellsInPolygon(const FieldGrid& grid, const LocalPolygon& polygon);

/// The cell of a point, clamped to the grid.
std::uint32_t cellAt(const FieldGrid& grid, glm::vec2 point);

}  // namespace throng::authoring
