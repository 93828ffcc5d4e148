// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/followed.h"
#include "sim/simulation_parts.h"

namespace throng::sim {

/// Everybody by slot, as they were when people last decided.
struct BodiesThere {
    const std::vector<gpu::Body>& bodies;
    const std::vector<gpu::Chest>& chests;  ///< by row; none where all are discs
};

/// What one person knows of its surroundings since the last decision, put into `step`.
void tellSenses(const Simulation::Parts& parts, const authoring::Scene& scene, const BodiesThere& there,
                std::uint32_t slot, FollowedStep& step);

/// The first body in somebody's way, FollowedStep::free_ahead.
float freeAhead(const FollowedStep& step);

}  // namespace throng::sim
