// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/batch/batch_folder.h"
#include "cli/batch/batch_local.h"

namespace throng::cli {

/// Prints how many scenarios there are to bake and what they cost in time and space: from the results that
/// the batch has already, or else from short crowds simulated here and now.
void printEstimate(const BatchPlan& plan, const BatchFolder& folder, const BatchStanding& standing,
                   const LocalOptions& options);

}  // namespace throng::cli
