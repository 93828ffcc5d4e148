// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/rebase.h"

namespace throng::authoring {

/// The behaviour of a group of the scene: a flow, a formation, or the audience of a block of seats.
const Behaviour* behaviourOf(const Layout& layout, const Scene& scene, std::size_t group);

/// Gives everybody who is to sit somewhere a seat, parties side by side, and works out the ways there. Those
/// who sit from the beginning have theirs. Too few seats are an error.
void buildSeats(const Layout& layout, const Rebase& rebase, Scene& scene, Diagnostics& diagnostics);

}  // namespace throng::authoring
