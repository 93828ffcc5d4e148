// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "authoring/cli/baker.h"
#include "authoring/cli/batch/batch_folder.h"

namespace throng::cli {

/// What came of one scenario.
enum class ScenarioEnd { done, failed, stopped };

/// Bakes and measures one scenario and writes its result; whatever goes wrong becomes a failed result with a
/// log. @throws gl::GraphicsError after that where the device is lost
ScenarioEnd bakeScenario(const BatchPlan& plan, std::size_t index, const BatchFolder& folder, Baker& baker,
                         double checkpoint_seconds, const InterruptGuard& interrupt);

/// A result for a scenario whose process died.
void recordDeath(const BatchPlan& plan, std::size_t index, const BatchFolder& folder,
                 const std::string& reason);

struct WorkerOptions {
    int device = -1;
    double checkpoint_seconds = 600.0;
};

/// A worker process: reads numbers of scenarios from standard input, a line each, and answers each with
/// "done", "failed" or "stopped" on standard output; ends with its input, or by SIGTERM.
void runWorker(const BatchPlan& plan, const BatchFolder& folder, const WorkerOptions& options);

}  // namespace throng::cli
