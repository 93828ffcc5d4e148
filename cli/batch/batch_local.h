// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/batch/batch_folder.h"
#include "cli/terminal/interrupt.h"

namespace throng::cli {

struct LocalOptions {
    std::size_t workers = 0;            ///< processes; 0: as many as cores, GPUs and memory suggest
    int device = -1;                    ///< for all of them; -1: spread over the GPUs there are
    double checkpoint_seconds = 600.0;  ///< of long bakes
    double seconds_left = 0.0;          ///< nothing is begun that would not end in time; 0: no limit
};

struct LocalOutcome {
    std::size_t done = 0, failed = 0;
    int signal = 0;            ///< that stopped it, or 0
    bool out_of_time = false;  ///< some were not begun, or have left a checkpoint
};

/// How many processes LocalOptions::workers means.
std::size_t workersFor(const BatchPlan& plan, const LocalOptions& options, std::size_t scenarios);

/// Bakes the scenarios in worker processes: one that dies takes one scenario with it, which is tried once
/// more.
/// @param advance called after each scenario with how many are done and have failed so far
LocalOutcome runLocally(const BatchPlan& plan, const BatchFolder& folder,
                        const std::vector<std::size_t>& scenarios, const LocalOptions& options,
                        const InterruptGuard& interrupt,
                        const std::function<void(std::size_t done, std::size_t failed)>& advance);

}  // namespace throng::cli
