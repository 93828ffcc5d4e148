// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/plane_grid.h"

namespace throng::analysis {

/// persons/m^2: one over the area of a person's Voronoi cell, truncated at a metre and counted in squares of
/// 0.1 m around it (Steffen and Seyfried 2010).
/// @param heights m, of all places; empty: there is one storey
/// @param grid holds `places`; the person is `places[self]`
double voronoiDensity(const PlaneGrid& grid, const std::vector<glm::dvec2>& places, std::uint32_t self,
                      const std::vector<double>& heights = {});

}  // namespace throng::analysis
