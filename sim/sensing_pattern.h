// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace throng::sim {

/// What the sensing pattern is made from; symbols as in De Gyves, Toledo and Rudomin 2013.
struct SensingGeometry {
    float body_radius = 0.25f;         ///< a, m: the first sample of a ray
    float tile_radius = 0.6f;          ///< r_s, m: the smallest tile; the step b and the largest gap M
    int samples_per_ray = 6;           ///< s
    float field_of_view = 3.4906585f;  ///< vt, rad, (0, 2 pi]
};

/// R = a + (s - 1) b: how far a ray reaches, m.
float sensingReach(const SensingGeometry& geometry);

/// vt / theta with theta = arccos(1 - M^2 / (2 rho^2)), rounded up: the rays that leave no gap above M on a
/// circle of radius rho; one more where the field of view has two edges, so that both have a ray.
int raysAtRadius(const SensingGeometry& geometry, float radius);

/// Sample points in a person's own frame (looking along +X), m.
/// Every ray with all its samples, as the paper has it.
std::vector<glm::vec2> fullPattern(const SensingGeometry& geometry);

/// The same circles with only as many samples as each needs for a gap of at most M, about half of them, and
/// none within `felt_range` (m), where everybody is found exactly anyway. In the order of their angle. At
/// least one sample.
std::vector<glm::vec2> thinnedPattern(const SensingGeometry& geometry, float felt_range);

}  // namespace throng::sim
