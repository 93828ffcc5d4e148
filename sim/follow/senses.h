// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/followed.h"
#include "sim/simulation_parts.h"

namespace throng::sim {

/// What one person knows of its surroundings since the last decision, put into `step`.
/// @param bodies of all slots, as they were then
void tellSenses(const Simulation::Parts& parts, const authoring::Scene& scene,
                const std::vector<gpu::Body>& bodies, std::uint32_t slot, FollowedStep& step);

/// The first body in somebody's way, FollowedStep::free_ahead.
float freeAhead(const FollowedStep& step);

}  // namespace throng::sim
