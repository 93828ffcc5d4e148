// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "authoring/scene/ground.h"
#include "cli/baking/baker.h"
#include "cli/batch/batch_folder.h"

namespace throng::cli {

/// What came of one scenario.
enum class ScenarioEnd { done, failed, stopped };

/// Bakes one scenario after the other on one device; what they share is worked out once.
class ScenarioBaker {
  public:
    struct Options {
        int device = -1;
        double checkpoint_seconds = 600.0;  ///< of long bakes; 0: none
        std::size_t people = 0;             ///< about as many as there are in the largest scenario
    };
    ScenarioBaker(const BatchPlan& plan, const BatchFolder& folder, const Options& options);

    /// Bakes and measures a scenario and writes its result; whatever goes wrong becomes a failed result with
    /// a log. @throws gl::GraphicsError after that where the device is lost
    ScenarioEnd bake(std::size_t index, const InterruptGuard& interrupt);

  private:
    ScenarioEnd tryBake(std::size_t index, const InterruptGuard& interrupt);

    const BatchPlan& plan_;
    const BatchFolder& folder_;
    Options options_;
    Baker baker_;
    authoring::GroundCache grounds_;
};

/// A result for a scenario whose process died.
void recordDeath(const BatchPlan& plan, std::size_t index, const BatchFolder& folder,
                 const std::string& reason);

/// A worker process: reads numbers of scenarios from standard input, a line each, and answers each with
/// "done", "failed" or "stopped" on standard output; ends with its input, or by SIGTERM.
void runWorker(const BatchPlan& plan, const BatchFolder& folder, const ScenarioBaker::Options& options);

}  // namespace throng::cli
