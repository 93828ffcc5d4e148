// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "authoring/diagnostics.h"
#include "authoring/family/family.h"
#include "authoring/layout/schema.h"

namespace throng::authoring {

/// The JSON Schema of families (draft-07), as `throng schema --family` prints it.
std::string_view familySchema();
/// The same, as readers ask it.
const Schema& familyRules();

/// Reads a family and tells everything that is wrong with it, its base layout included.
/// @param folder that the path of the base layout starts from
/// @param schema another one than ours only in tests
/// @returns nothing when `diagnostics` has errors
std::optional<Family> readFamily(std::string_view text, const std::filesystem::path& folder,
                                 Diagnostics& diagnostics, const Schema& schema = familyRules());

}  // namespace throng::authoring
