// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/scene/close_starts.h"
#include "authoring/scene/placing.h"

namespace throng::authoring {

/// The goals of formations that are points. Without walls, the straight way is all there is to know.
std::vector<Routes::PointGoal> pointGoals(const Layout& layout, const Rebase& rebase,
                                          const WalkGeometry& geometry, const Scene& scene);

/// Gives the people of formations their places and ways.
/// @param closed_gates at the start
void placeFormations(const Placing& with, const std::vector<gpu::WallSegment>& closed_gates,
                     const CloseStarts& close);

}  // namespace throng::authoring
