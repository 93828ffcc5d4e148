// SPDX-License-Identifier: Apache-2.0
#include "sim/step_table.h"

#include <algorithm>
#include <numeric>

#include "sim/simulation_parts.h"

namespace throng::sim {
namespace {

/// Routes do some things every second, third or fourth step: this is a whole number of rounds of each.
constexpr int kSteps = 12;
constexpr const char* kGates = "gates";

std::size_t bytesPerPerson(const std::vector<gl::Touch>& touches, bool gl::Touch::*how) {
    return std::accumulate(
        touches.begin(), touches.end(), std::size_t{0}, [&](std::size_t bytes, const gl::Touch& touch) {
            const gl::Contents& contents = *touch.contents;
            const bool counts = touch.*how && (contents.per == kPerson || contents.per == kSite);
            return bytes + (counts ? contents.element_bytes : 0);
        });
}

/// Dispatch arguments that the program also reads as a block are one buffer.
std::vector<gl::Touch> together(const std::vector<gl::Touch>& touches) {
    std::vector<gl::Touch> merged;
    for (const gl::Touch& touch : touches) {
        const auto same = std::find_if(merged.begin(), merged.end(), [&](const gl::Touch& known) {
            return known.contents == touch.contents;
        });
        if (same == merged.end()) {
            merged.push_back(touch);
        } else {
            same->reads |= touch.reads;
            same->writes |= touch.writes;
        }
    }
    return merged;
}

void count(std::vector<StepRow>& rows, const gl::Command& command) {
    const std::vector<gl::Touch> touches = together(command.touches);
    auto row = std::find_if(rows.begin(), rows.end(), [&](const StepRow& known) {
        return known.what == command.what && known.touches == touches;
    });
    if (row == rows.end()) row = rows.insert(rows.end(), {command.what, command.declared, 0.0, touches});
    row->launches += 1.0 / kSteps;
}

}  // namespace

std::size_t StepRow::bytesReadPerPerson() const {
    return bytesPerPerson(touches, &gl::Touch::reads);
}

std::size_t StepRow::bytesWrittenPerPerson() const {
    return bytesPerPerson(touches, &gl::Touch::writes);
}

void noteSteps(Simulation& simulation, gl::Journal& journal, int steps) {
    Simulation::Parts& parts = simulation.parts();
    for (int step = 0; step < steps; ++step) {
        journal.beginPass(kGates);
        parts.beginStep();
        for (const Pass& pass : parts.passes) {
            journal.beginPass(pass.name);
            pass.run();
        }
    }
}

std::vector<StepPass> tabulateStep(Simulation& simulation) {
    const Simulation::Parts& parts = simulation.parts();
    gl::Journal journal;
    noteSteps(simulation, journal, kSteps);
    std::vector<StepPass> table = {{kGates, {}}};
    // Some come more than once in a step: one list of rows has all of them.
    for (const Pass& pass : parts.passes)
        if (std::ranges::none_of(table, [&](const StepPass& known) { return known.name == pass.name; }))
            table.push_back({pass.name, {}});
    for (StepPass& pass : table)
        for (const gl::Command& command : journal.commands())
            if (command.pass == pass.name) count(pass.rows, command);
    return table;
}

}  // namespace throng::sim
