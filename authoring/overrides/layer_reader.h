// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout/schema.h"
#include "authoring/overrides/layers.h"

namespace throng::authoring {

/// Reads the layers of an override file and tells everything that is wrong with them.
std::vector<Layer> readLayers(const JsonNode& list, const Schema& schema, Diagnostics& diagnostics);

}  // namespace throng::authoring
