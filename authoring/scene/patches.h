// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/fields.h"
#include "authoring/scene/rebase.h"

namespace throng::authoring {

/// Whether patches end where the floors do that they lie on; tells of others: beyond a floor there is
/// nothing, and in the plane that people are simulated in perhaps another one.
bool areOnTheirFloors(const Layout& layout, Diagnostics& diagnostics);

/// The layout's patches that cost something.
std::vector<CostlyGround> costlyGround(const Layout& layout, const Rebase& rebase);

/// Those that people walk on at another pace or take another room on, and on the coarse map what some of them
/// cost for a time.
/// @param coarse without cells where routes do not change
Patches buildPatches(const Layout& layout, const Rebase& rebase, const FieldGrid& coarse);

/// Makes ground that always costs something do so.
/// @param cost per cell, infinity where nobody can stand
void chargePatches(const std::vector<CostlyGround>& costly, const FieldGrid& grid, std::vector<float>& cost);

/// Calls visit(cell) for the cells of all costly ground, also of what is so for a time.
void visitCostly(const std::vector<CostlyGround>& costly, const FieldGrid& grid,
                 const std::function<void(std::uint32_t)>& visit);

}  // namespace throng::authoring
