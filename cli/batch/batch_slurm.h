// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/batch/batch_local.h"

namespace throng::cli {

struct SlurmOptions {
    std::size_t tasks = 0;             ///< of the job array; 0: one for every 50 scenarios
    double time_limit_minutes = 0.0;   ///< of each task; 0: the partition's
    double checkpoint_minutes = 10.0;  ///< of long bakes
    int retries = 3;                   ///< arrays submitted again where some scenarios are left
    bool wait = true;                  ///< until the batch is complete
    std::vector<std::string> extra;    ///< options for sbatch, word by word
};

/// Bakes what is open by a job array: needs Slurm's commands here, and the batch's folder and this program
/// under the same paths on the nodes. Tasks that are killed, run out of time or lose their node leave
/// scenarios open: an array of what is left is submitted again. An array that is still in the queue from an
/// earlier run is waited for instead of submitting another.
/// @throws InputError with what sbatch says
LocalOutcome runOnSlurm(const BatchPlan& plan, const BatchFolder& folder, const BatchStanding& standing,
                        const SlurmOptions& options, const InterruptGuard& interrupt,
                        const std::function<void(std::size_t done, std::size_t failed)>& advance);

}  // namespace throng::cli
