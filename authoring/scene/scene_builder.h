// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"

namespace throng::authoring {

/// Turns a layout into what the simulation needs. Deterministic: the same layout gives the same scene, bit
/// for bit.
/// @returns nothing when `diagnostics` has errors: people inside walls, goals that cannot be reached, entries
/// without room
std::optional<Scene> buildScene(const Layout& layout, Diagnostics& diagnostics);

}  // namespace throng::authoring
