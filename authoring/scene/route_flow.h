// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/scene/placing.h"

namespace throng::authoring {

/// Gives the people of a flow their entry and their way. Those who walk stop by stop; whoever has a behaviour
/// begins in its first state.
/// @param index of the flow
void routeFlow(const Placing& with, const Flow& flow, std::size_t index);

}  // namespace throng::authoring
