// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "authoring/scene/placing.h"

namespace throng::authoring {

/// The goals of formations that are points. Without walls, the straight way is all there is to know.
std::vector<Routes::PointGoal> pointGoals(const Layout& layout, const Rebase& rebase,
                                          const WalkGeometry& geometry, const Scene& scene);

/// Gives the people of formations their places and ways.
class FormationPlacer {
  public:
    /// @param closed_gates at the start
    FormationPlacer(const Placing& with, const std::vector<gpu::WallSegment>& closed_gates);
    ~FormationPlacer();

    void place(const Formation& formation, std::size_t formation_index);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace throng::authoring
