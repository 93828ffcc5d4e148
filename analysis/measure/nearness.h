// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "io/crowd_reader.h"

namespace throng::analysis {

/// How near people are to each other: overlaps in each frame, lanes and densities once a second. Its figures
/// are those of Measurement.
struct Nearness {
    double overlapping_percent = 0.0, worst_overlapping_percent = 0.0, deepest_overlap_percent = 0.0;
    double given_overlapping_percent = 0.0, given_deepest_overlap_percent = 0.0;
    double lane_order = 0.0;
    double mean_density = 0.0, high_density = 0.0;
    std::vector<glm::dvec2> speed_by_density, overlaps;
};

Nearness measureNearness(io::CrowdReader& crowd);

}  // namespace throng::analysis
