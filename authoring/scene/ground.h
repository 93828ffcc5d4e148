// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "authoring/scene/field_blocks.h"
#include "authoring/scene/raster.h"
#include "authoring/scene/sight.h"

namespace throng::authoring {

/// How fine ground is worked out.
struct GroundResolution {
    FieldGrid grid;           ///< of the distances to roads, of the coarse map, and of fields without blocks
    float block_cell = 0.0f;  ///< m, of fields in blocks; 0: there are no blocks
    std::uint32_t most_block_cells = 0;  ///< of one field in blocks: its cells grow until they are no more

    bool operator==(const GroundResolution& other) const {
        return grid.cell_size == other.grid.cell_size && block_cell == other.block_cell &&
               most_block_cells == other.most_block_cells;
    }
};

/// What suits a site. @param fields that will be asked for: many have to be less fine
GroundResolution resolutionFor(const WalkGeometry& geometry, std::size_t fields);

/// Goals that share a field: their bounds, with nothing but room in them.
using GoalBox = Box;

/// Ground to walk on, and everything worked out from it, once each. Solving may go on in several threads.
///
/// A field has a value for each spot: a cell of the grid, or a node of the blocks.
class Ground {
  public:
    Ground(WalkGeometry geometry, const GroundResolution& resolution);

    const FieldGrid& grid() const { return grid_; }
    const FieldBlocks& blocks() const { return blocks_; }  ///< empty on small sites
    std::size_t cellsPerField() const { return blocks_.empty() ? cellCount(grid_) : blocks_.cell_count; }
    const WalkMap& map(bool keep_to_roads) { return mapFor(keep_to_roads ? kOnRoads : kAnywhere); }
    const CoarseMap& coarse(bool keep_to_roads);
    FieldGrid coarseGrid() const;
    const std::vector<float>& roadDistances();
    const Sight& sight();

    /// From now on fields are solved by it, in the thread that asks; null: here, by any thread.
    void solveWith(DistanceSolver* solver) { solver_ = blocks_.empty() ? solver : nullptr; }
    DistanceSolver* solver() const { return solver_; }

    /// Where somebody at this place is, even if too near to a wall for a spot; gpu::NO_INDEX in the middle of
    /// one.
    std::uint32_t spotAt(glm::vec2 point);
    /// All spots in it, at least the one of its middle.
    std::vector<std::uint32_t> spotsIn(const LocalPolygon& polygon);
    /// Where a spot's value is in a field.
    std::uint32_t cellOf(std::uint32_t spot) const { return blocks_.empty() ? spot : blocks_.cellOf(spot); }
    /// Metres of walking, kUnreachable where no path leads.
    float lengthFrom(const Field& field, std::uint32_t spot) const;
    /// A rectangle with nothing but free ground in it, but for the point's own spot: of a square of `side` m
    /// that holds the point, what is left when it is cut at the nearest obstacle until there is none.
    GoalBox clearBox(glm::vec2 point, float side);

    using Targets = std::vector<std::uint32_t>;  // spots
    std::shared_ptr<const Field> solve(bool keep_to_roads, const Targets& targets);
    /// To the middle of a box, and from where all of it can be walked to straight on, straight.
    std::shared_ptr<const Field> solveTo(const GoalBox& goals);
    /// To a room, all clear, with the goals in it: from there, and from where the way to all goals is
    /// straight anyway, straight.
    std::shared_ptr<const Field> solveTo(const GoalBox& goals, const GoalBox& room);
    /// Distances on the coarse map.
    std::shared_ptr<const Field> solveCoarse(bool keep_to_roads, const Targets& targets);

    /// Of all fields that were solved.
    std::size_t bytes() const;

  private:
    using Solved = std::map<Targets, std::shared_ptr<const Field>>;
    template <class Key, class Solve>
    std::shared_ptr<const Field> once(std::map<Key, std::shared_ptr<const Field>>& solved, const Key& key,
                                      Solve solve);
    enum Purpose { kAnywhere, kOnRoads, kToPoints, kPurposes };
    WalkGeometry geometryFor(Purpose purpose) const;
    const WalkMap& mapFor(Purpose purpose);
    const BlockMap& blockMapFor(Purpose purpose);
    const std::vector<float>& costFor(Purpose purpose);
    Field solveFine(Purpose purpose, const Targets& targets, const StraightWays* straight);
    std::optional<glm::vec2> freeCellNear(glm::vec2 point);
    StraightWays straightTo(const GoalBox& goals, glm::vec2 middle, const GoalBox& room);
    CoarseMap coarsenCharts(WalkMap fine) const;
    template <class Visit>
    void visitSpots(glm::vec2 lower, glm::vec2 upper, Visit visit) const;

    WalkGeometry geometry_;
    FieldGrid grid_;
    DistanceSolver* solver_ = nullptr;
    std::recursive_mutex making_;  // maps and distances
    FieldBlocks blocks_;
    std::optional<WalkMap> maps_[kPurposes];
    std::optional<BlockMap> block_maps_[kPurposes];
    std::optional<Sight> sight_;
    std::atomic<const Sight*> known_sight_ = nullptr;  // once it is there: it is asked for often
    std::optional<CoarseMap> coarse_[2];
    std::optional<std::vector<float>> road_distances_;
    mutable std::mutex solving_;
    Solved solved_[2], solved_coarse_[2];
    std::map<std::array<float, 8>, std::shared_ptr<const Field>> solved_to_;
};

/// Keeps the ground of the last few scenes: many scenarios differ in everything but their ground, and working
/// it out takes longer than all else that makes a scene.
class GroundCache {
  public:
    std::shared_ptr<Ground> groundFor(const WalkGeometry& geometry, const GroundResolution& resolution);

  private:
    struct Entry {
        std::string key;  // the geometry, byte for byte
        std::shared_ptr<Ground> ground;
    };
    std::list<Entry> entries_;  // the last used first
};

}  // namespace throng::authoring
