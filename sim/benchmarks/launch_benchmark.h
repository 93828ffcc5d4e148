// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sim/simulation.h"

namespace throng::sim {

/// What one program or transfer of the step takes on the device.
struct LaunchTime {
    std::string pass;       ///< of the step
    std::string what;       ///< the program's shaders, or "fill", "copy", "upload"
    double launches = 0.0;  ///< in one step, on average
    double step_ms = 0.0;   ///< all of them together, in one step
    std::size_t bytes = 0;  ///< of the elements that a launch reads and writes for each person (StepRow)
};

/// Where the time of a step goes, launch by launch.
struct LaunchTimes {
    std::vector<LaunchTime> rows;  ///< in the order in which they first came
    double step_ms = 0.0;          ///< a step among many that nothing waits between
    double asking_ms = 0.0;        ///< of which it takes to ask the device for it
};

/// @param software as Device::software: then each launch is timed around waits
LaunchTimes timeLaunches(Simulation& simulation, bool software, int steps);

}  // namespace throng::sim
