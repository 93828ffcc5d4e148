// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/diagnostics.h"
#include "authoring/layout.h"

namespace throng::authoring {

/// Whether people who leave rows by mouths that the layout tells step onto ground: the floor of a level, and
/// no wall. Where not, that is an error.
bool areFeetOnGround(const Layout& layout, Diagnostics& diagnostics);

}  // namespace throng::authoring
