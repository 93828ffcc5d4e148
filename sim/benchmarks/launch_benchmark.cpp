// SPDX-License-Identifier: Apache-2.0
#include "sim/benchmarks/launch_benchmark.h"

#include <algorithm>
#include <chrono>

#include "sim/gl/journal.h"
#include "sim/step_table.h"

namespace throng::sim {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

/// Steps that nothing waits between, and how long it takes to ask for them.
void timeWhole(Simulation& simulation, int steps, LaunchTimes& times) {
    // A GPU takes some tenths of a second to reach its clock.
    constexpr double kWarmUpMs = 300.0;
    const auto cold = std::chrono::steady_clock::now();
    while (Milliseconds(std::chrono::steady_clock::now() - cold).count() < kWarmUpMs) {
        simulation.step();
        simulation.wait();
    }
    const auto start = std::chrono::steady_clock::now();
    for (int step = 0; step < steps; ++step)
        simulation.step();
    const auto asked = std::chrono::steady_clock::now();
    simulation.wait();
    const auto done = std::chrono::steady_clock::now();
    times.asking_ms = Milliseconds(asked - start).count() / steps;
    times.step_ms = Milliseconds(done - start).count() / steps;
}

void add(std::vector<LaunchTime>& rows, const gl::Command& command, double milliseconds, int steps) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const LaunchTime& known) {
        return known.pass == command.pass && known.what == command.what;
    });
    if (row == rows.end()) row = rows.insert(rows.end(), {command.pass, command.what, 0.0, 0.0, 0});
    row->launches += 1.0 / steps;
    row->step_ms += milliseconds / steps;
}

/// A program that is launched with several buffers has a row for each in the table: the largest counts.
void addBytes(std::vector<LaunchTime>& rows, const std::vector<StepPass>& table) {
    for (LaunchTime& row : rows)
        for (const StepPass& pass : table)
            for (const StepRow& known : pass.rows)
                if (pass.name == row.pass && known.what == row.what)
                    row.bytes =
                        std::max(row.bytes, known.bytesReadPerPerson() + known.bytesWrittenPerPerson());
}

}  // namespace

LaunchTimes timeLaunches(Simulation& simulation, bool software, int steps) {
    LaunchTimes times;
    timeWhole(simulation, steps, times);
    {
        gl::Journal journal(software ? gl::Journal::Times::of_wall : gl::Journal::Times::of_device);
        noteSteps(simulation, journal, steps);
        const std::vector<double> milliseconds = journal.milliseconds();
        for (std::size_t i = 0; i < milliseconds.size(); ++i)
            add(times.rows, journal.commands()[i], milliseconds[i], steps);
    }
    addBytes(times.rows, tabulateStep(simulation));
    return times;
}

}  // namespace throng::sim
