// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/batch/batch_folder.h"

namespace throng::cli {

/// Gathers the results of a batch into `results.sqlite` (docs/batch.md has its tables), which is replaced in
/// one step: whoever reads sees the old one or the new one. Safe to run at any time, as often as one likes.
/// @throws OutputError
void collectResults(const BatchPlan& plan, const BatchFolder& folder);

/// A name as SQL takes it, whatever is in it.
std::string quotedName(const std::string& name);

}  // namespace throng::cli
