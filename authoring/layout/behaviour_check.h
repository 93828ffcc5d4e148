// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/behaviour.h"
#include "authoring/diagnostics.h"

namespace throng::authoring {

/// Warns of states that nobody comes to, that nobody gets out of, and that lead to each other without any
/// time passing.
void checkBehaviour(const Behaviour& behaviour, Diagnostics& diagnostics);

}  // namespace throng::authoring
