// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "cli/batch/batch_folder.h"

namespace throng::cli {

/// A name of any origin as job managers take it: no quotes, line ends, or what scripts and templates act
/// upon.
std::string jobName(std::string_view name);

/// How many parts a farm cuts so many scenarios into by itself.
std::size_t partsFor(std::size_t scenarios);

/// A job for other farm managers, to be printed: `openjd` (Open Job Description 2023-09) or `flamenco` (a job
/// type for Flamenco 3).
/// @param parts tasks that the batch is cut into
std::string farmJob(const std::string& manager, const BatchPlan& plan, const std::string& family_path,
                    const BatchFolder& folder, std::size_t parts);

}  // namespace throng::cli
