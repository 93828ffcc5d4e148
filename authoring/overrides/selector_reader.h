// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout/schema.h"
#include "authoring/overrides/layers.h"

namespace throng::authoring {

/// Reads who is meant, and tells everything that is wrong with it.
/// @param names of the layers before, whose copies may be meant
Selector readSelector(const JsonNode& node, SchemaRule rule, const std::vector<std::string>& names,
                      Diagnostics& diagnostics);

}  // namespace throng::authoring
