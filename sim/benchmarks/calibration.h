// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/benchmarks/diagram_benchmark.h"
#include "sim/diagram/cost_model.h"

namespace throng::sim {

/// One load and how long a method took.
struct CalibrationSample {
    DiagramLoad load;
    double milliseconds = 0.0;
};

/// The cost whose relative errors over the samples are least (in squares), no term negative.
MethodCost fitCost(DiagramMethod method, const GatherShape& gather,
                   const std::vector<CalibrationSample>& samples);

/// The methods that `auto` may take: all exact ones but comparing everything with everything.
std::vector<DiagramContestant> calibrationContestants();

/// Times all of them over windows of 512 to 2,048 px and 64 to 262,144 sites: of seven rounds about half a
/// minute on two cores.
/// @param rounds how often each is timed; medians count
/// @param progress is told the share done, 0 to 1
CostModel calibrate(const gl::ShaderLibrary& library, const gl::Timer& timer, const std::string& device,
                    int rounds, const std::function<void(double)>& progress);

}  // namespace throng::sim
