// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "authoring/scene/fields.h"

namespace throng::authoring {

/// Ground to walk on, and everything worked out from it, once each. Solving may go on in several threads.
class Ground {
  public:
    Ground(WalkGeometry geometry, const FieldGrid& grid);

    const FieldGrid& grid() const { return grid_; }
    const WalkMap& map(bool keep_to_roads);
    const CoarseMap& coarse(bool keep_to_roads);
    FieldGrid coarseGrid() const;
    const std::vector<float>& roadDistances();

    /// From now on fields are solved by it, in the thread that asks; null: here, by any thread.
    void solveWith(DistanceSolver* solver) { solver_ = solver; }
    DistanceSolver* solver() const { return solver_; }

    using Targets = std::vector<std::uint32_t>;  // cells
    std::shared_ptr<const Field> solve(bool keep_to_roads, const Targets& targets);
    /// Distances on the coarse map.
    std::shared_ptr<const Field> solveCoarse(bool keep_to_roads, const Targets& targets);

    /// Of all fields that were solved.
    std::size_t bytes() const;

  private:
    using Solved = std::map<Targets, std::shared_ptr<const Field>>;
    std::shared_ptr<const Field> solveOnce(Solved& solved, const WalkMap& map, const Targets& targets);

    WalkGeometry geometry_;
    FieldGrid grid_;
    DistanceSolver* solver_ = nullptr;
    std::recursive_mutex making_;  // maps and distances
    std::optional<WalkMap> maps_[2];
    std::optional<CoarseMap> coarse_[2];
    std::optional<std::vector<float>> road_distances_;
    mutable std::mutex solving_;
    Solved solved_[2], solved_coarse_[2];
};

/// Keeps the ground of the last few scenes: many scenarios differ in everything but their ground, and working
/// it out takes longer than all else that makes a scene.
class GroundCache {
  public:
    std::shared_ptr<Ground> groundFor(const WalkGeometry& geometry, const FieldGrid& grid);

  private:
    struct Entry {
        std::string key;  // the geometry, byte for byte
        std::shared_ptr<Ground> ground;
    };
    std::list<Entry> entries_;  // the last used first
};

}  // namespace throng::authoring
