// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/gl/shader_source.h"
#include "sim/simulation.h"

namespace throng::sim {

/// Neighbour keys of every row, nearest first, for the present positions; without those whom walls hide.
std::vector<std::vector<std::uint32_t>> senseNow(Simulation& simulation);

/// One crowd, one way to find neighbours.
struct ProximityTiming {
    double search_ms = 0.0;  ///< diagram and sensing; what only this way needs (median)
    double step_ms = 0.0;    ///< the whole step (median)
    double recall = 1.0;     ///< share of the true nearest neighbours that were found
    int rounds = 0;
};

struct ProximityRow {
    std::uint32_t people = 0;
    std::optional<ProximityTiming> voronoi, grid, brute;  ///< brute is left out where it would take too long
};

struct ProximityBenchmark {
    float spacing = 2.0f;  ///< m: one person per spacing squared
    float body_radius = 0.3f;
    double tile_radius = 0.6;
    double field_of_view = 200.0;  ///< degrees
    int samples_per_ray = 6;
    int neighbours = 10;
    int rounds = 15;

    /// The crowd that is timed.
    authoring::Scene crowd(std::uint32_t people) const;
    /// All ways in turn, round by round, over the same crowd.
    ProximityRow run(const gl::ShaderLibrary& library, std::uint32_t people) const;
};

}  // namespace throng::sim
