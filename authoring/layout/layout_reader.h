// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/layout/schema.h"

namespace throng::authoring {

/// The JSON Schema of layouts (draft-07), as `throng schema` prints it and editors use it.
std::string_view layoutSchema();
/// The same, as readers ask it.
const Schema& layoutRules();

/// Reads a layout and tells everything that is wrong with it, in the order of the file.
/// @param text the file's bytes (UTF-8)
/// @param overrides "simulation.seed=7" each: a path of keys and indices, separated by dots or as a JSON
/// pointer, and a value in JSON (anything that is not JSON is taken as a string)
/// @param schema another one than ours only in tests
/// @returns nothing when `diagnostics` has errors
std::optional<Layout> readLayout(std::string_view text, std::span<const std::string> overrides,
                                 Diagnostics& diagnostics, const Schema& schema = layoutRules());

/// The text of a layout that says by itself what it and the overrides say together: the same bytes where
/// there are none. Both are such that readLayout() reads them.
std::string layoutWith(std::string_view text, std::span<const std::string> overrides);

/// One diagnostic as compilers print theirs: file:line:column, the pointer, what is wrong, the line with a
/// caret, the hint.
std::string formatDiagnostic(const Diagnostic& diagnostic, std::string_view file, std::string_view text);

}  // namespace throng::authoring
