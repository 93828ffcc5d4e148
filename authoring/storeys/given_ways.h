// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/storeys/chart.h"

namespace throng::authoring {

/// Tells of given people whose ways leave the floors that they are on: beyond a floor there is nothing, and
/// in the plane perhaps another one.
/// @param charts of the layout's levels, and then of its links
void checkGivenWays(const Layout& layout, const std::vector<Chart>& charts, Diagnostics& diagnostics);

}  // namespace throng::authoring
