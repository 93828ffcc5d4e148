// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/diagram/diagram.h"
#include "sim/gl/timer.h"

namespace throng::sim {

/// Sites thrown at random over a square window.
struct DiagramCase {
    std::uint32_t sites = 0;
    float radius = 8.0f;        ///< px
    std::uint32_t side = 1024;  ///< px
};

/// One way to build it, with its parameters.
struct DiagramContestant {
    std::string name;
    DiagramMethod method = DiagramMethod::binned;
    std::uint32_t cone_sides = 16;
    GatherShape gather;
    /// gradient1 without the copy of its texture into the buffer that every method fills: the yardstick.
    bool draw_only = false;
};

/// Times of one contestant in one case.
struct DiagramTiming {
    double median_ms = 0.0;
    double low_ms = 0.0;   ///< 10th percentile
    double high_ms = 0.0;  ///< 90th percentile
    /// Median of the ratios to the reference contestant's time in the same round.
    double ratio = 0.0;
    double wrong_share = 0.0;  ///< of the pixels, against the CPU's reference
    int rounds = 0;
};

/// Times contestants against each other: in rounds, each once a round, so that all meet the same noise.
/// Before each, 64 MiB are written elsewhere: in a simulation other passes have filled the caches, too.
/// Contestants whose first run takes longer than `patience_ms` are run once, and not at all when `forecast`
/// (by the number of sites and pixels) says more than ten times that.
struct DiagramBenchmark {
    int rounds = 15;
    double patience_ms = 2000.0;
    std::size_t reference = 0;  ///< index of the contestant that ratios refer to

    /// @returns one entry a contestant; empty where it was left out
    std::vector<std::optional<DiagramTiming>> run(const gl::ShaderLibrary& library, const gl::Timer& timer,
                                                  const DiagramCase& setup,
                                                  const std::vector<DiagramContestant>& contestants) const;
};

/// The owners by definition, on the CPU: every site visits the pixels under its tile.
std::vector<std::uint32_t> referenceOwners(const DiagramCase& setup,
                                           const std::vector<gpu::DiagramSite>& sites);

/// The sites of a case; the same every time.
std::vector<gpu::DiagramSite> sitesOf(const DiagramCase& setup);

double median(std::vector<double> values);
/// @param share 0 to 1
double percentile(std::vector<double> values, double share);

}  // namespace throng::sim
