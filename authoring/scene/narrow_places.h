// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/scene/fields.h"

namespace throng::authoring {

/// The middles of passages between walls that somebody fits through and few can share, m: doors, gaps, and a
/// place every so often along a narrow corridor. Corners and the inside of solid walls are none.
/// @param widest m between the surfaces of the walls: a passage is narrow up to here; at most
/// WallGrid::kReach
std::vector<glm::vec2> narrowPlaces(const WalkGeometry& geometry, float widest);

}  // namespace throng::authoring
