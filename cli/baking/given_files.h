// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"

namespace throng::cli {

/// Reads the ways of all given people that the layout has files for. What is wrong with a file is a mistake
/// in the layout, told where the layout names it.
/// @param name of the layout's file: theirs are relative to its folder
/// @returns a number of what was read, for all that depends on it; 0: there are no files
std::uint64_t readGivenFiles(const std::string& name, authoring::Layout& layout,
                             authoring::Diagnostics& diagnostics);

}  // namespace throng::cli
