// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/rebase.h"

namespace throng::authoring {

/// Bodies and times of everybody, group by group; their ways are left open. The walls' clearance depends on
/// the smallest and the largest body, so this comes first.
/// @returns m: half of the narrowest that anybody gets through; of nobody 0
float drawEverybody(const Layout& layout, const Rebase& rebase, Scene& scene);

}  // namespace throng::authoring
