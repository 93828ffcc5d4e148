// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/storeys/chart.h"

namespace throng::authoring {

/// Tells of links and lifts that go through each other, or so closely over each other that nobody could walk
/// between. Railings may touch.
/// @param charts among them those of the layout's links, and of their landings where these are floors
void checkLinksApart(const std::vector<Chart>& charts, const Layout& layout, Diagnostics& diagnostics);

}  // namespace throng::authoring
