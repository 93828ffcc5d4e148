// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/layout.h"

/// How many people a layout asks for, before any of them is drawn.
namespace throng::authoring {

/// Of what is drawn, as if nothing were clamped but the mean itself.
double meanOf(const Distribution& drawn);

/// Of moments that are drawn, as many as there will be on average, the warm-up counted.
double peopleIn(const Flow& flow, const Layout& layout);
double peopleIn(const Formation& formation);

}  // namespace throng::authoring
