// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <span>

#include "base/files/output_file.h"
#include "base/followed.h"

namespace throng::analysis {

/// Writes `follow.csv` (a line for each rule that did something) and `follow-steps.csv` (a line for each
/// step) into a folder, in pieces, as steps come. Files of that name are replaced. @throws OutputError
class FollowTables {
  public:
    /// @param origin what is added to places to have them in the world, m
    FollowTables(const std::filesystem::path& folder, glm::dvec2 origin);
    void write(std::span<const FollowedStep> steps);
    void finish();

  private:
    glm::dvec2 origin_;
    OutputFile influences_, steps_;
};

}  // namespace throng::analysis
