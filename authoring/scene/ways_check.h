// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/fields.h"
#include "authoring/scene/rebase.h"
#include "authoring/scene/routes.h"

namespace throng::authoring {

/// Warns of ways that are there for a route, and not for those who are to walk it: doors narrower than the
/// widest body of a group, gates that stay closed while the group is there, and places of a `nearest` behind
/// walls. One warning for each such place, with where the way ends; in doubt none, as the ground is looked at
/// in cells.
/// @param geometry without the gates
/// @param scene with everybody and all walls' segments
void checkWays(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry, Routes& routes,
               const Scene& scene, Diagnostics& diagnostics);

}  // namespace throng::authoring
