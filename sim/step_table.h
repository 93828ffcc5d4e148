// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sim/gl/journal.h"
#include "sim/simulation.h"

namespace throng::sim {

/// A program or a transfer, with the buffers that it works on.
struct StepRow {
    std::string what;       ///< as in gl::Command
    std::string declared;   ///< likewise
    double launches = 0.0;  ///< in one step, on average
    std::vector<gl::Touch> touches;

    /// Bytes of the elements that one launch reads or writes for each person: those of its own row or slot,
    /// each once and whole. What it looks at of others is not in it.
    std::size_t bytesReadPerPerson() const;
    std::size_t bytesWrittenPerPerson() const;
};

struct StepPass {
    std::string name;
    std::vector<StepRow> rows;  ///< in the order in which they first came; none: it has nothing to do
};

/// A few more steps of `simulation`, each command noted with its pass; what the CPU uploads for gates comes
/// first.
void noteSteps(Simulation& simulation, gl::Journal& journal, int steps);

/// The step pass by pass, in the order in which they first come, what the CPU uploads for gates first: from
/// what the programs declare, and from the launches of a few more steps of `simulation`.
std::vector<StepPass> tabulateStep(Simulation& simulation);

}  // namespace throng::sim
