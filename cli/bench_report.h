// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/benchmarks/diagram_benchmark.h"
#include "sim/benchmarks/proximity_benchmark.h"
#include "sim/gl/context.h"

namespace throng::cli {

/// What the heads of all reports say.
struct BenchMachine {
    gl::Device device;
    unsigned cores = 0;
    std::string timer;  ///< how times were taken
};

struct DiagramReport {
    BenchMachine machine;
    std::vector<sim::DiagramContestant> contestants;
    std::vector<std::string> automatic;  ///< per case, what `auto` took
    std::vector<sim::DiagramCase> cases;
    /// Per case, per contestant.
    std::vector<std::vector<std::optional<sim::DiagramTiming>>> timings;
    std::size_t yardstick = 0;  ///< among the contestants
};

/// diagrams.md and diagrams.csv. Throws OutputError.
void writeDiagramReport(const std::filesystem::path& folder, const DiagramReport& report);

struct ProximityReport {
    BenchMachine machine;
    sim::ProximityBenchmark settings;
    std::vector<sim::ProximityRow> rows;
};

/// proximity.md and proximity.csv. Throws OutputError.
void writeProximityReport(const std::filesystem::path& folder, const ProximityReport& report);

}  // namespace throng::cli
