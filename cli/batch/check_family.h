// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "authoring/diagnostics.h"

namespace throng::cli {

/// Whether a file's text is a family of scenarios rather than a layout.
bool isFamily(std::string_view text);

/// What came of looking at a family.
struct FamilyCheck {
    bool valid = false;
    std::size_t scenarios = 0;
    std::size_t layouts_read = 0;  ///< scenarios whose layout was composed and read
    std::size_t scenes_built = 0;  ///< scenarios whose scene was made, as for a bake
    std::string base_name;
    authoring::Diagnostics diagnostics;  ///< of the base layout and of these scenes
};

/// Reads a family, its base layout and its scenarios' layouts, and makes the scenes of a few of them. What is
/// wrong with the family itself has been printed.
/// @throws Exit as BatchPlan does
FamilyCheck checkFamily(const std::string& path);

}  // namespace throng::cli
