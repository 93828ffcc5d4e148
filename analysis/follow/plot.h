// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "analysis/follow/account.h"
#include "authoring/layout.h"

namespace throng::analysis {

/// What is drawn of somebody who was followed.
struct FollowPlot {
    std::string title;
    std::span<const FollowedStep> steps;  ///< of one person, in order
    double step_seconds = 0.0;
    glm::dvec2 origin{0.0};                  ///< what is added to places to have them in the world, m
    std::span<const authoring::Wall> walls;  ///< in the world
    const FollowAccount& account;
};

/// Draws the way with walls and neighbours, the speed that was wished and had, and what the rules added to it
/// over time, as PNG. @throws OutputError
void writeFollowPlot(const std::filesystem::path& path, const FollowPlot& plot);

}  // namespace throng::analysis
