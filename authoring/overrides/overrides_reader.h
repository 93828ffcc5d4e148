// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout/schema.h"
#include "authoring/overrides/layers.h"

namespace throng::authoring {

/// The JSON Schema of override files (draft-07), as `throng schema --overrides` prints it.
std::string_view overridesSchema();
/// The same, as readers ask it.
const Schema& overridesRules();

struct OverrideFile {
    std::vector<Override> people;  ///< changed one by one
    std::vector<Layer> layers;     ///< after that
};

/// Reads an override file and tells everything that is wrong with it.
/// @param schema another one than ours only in tests
/// @returns nothing when `diagnostics` has errors
std::optional<OverrideFile> readOverrides(std::string_view text, Diagnostics& diagnostics,
                                          const Schema& schema = overridesRules());

}  // namespace throng::authoring
