// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "authoring/layout.h"

namespace throng::io {

/// Which way vehicles go at a place: that of the nearest piece of a lane, of length 1; along x without lanes.
glm::dvec2 wayBeside(std::span<const authoring::Lane> lanes, glm::dvec2 place);

/// Of a crossing: bands along the way, `wide` and as far apart, cut where it ends.
std::vector<std::vector<glm::dvec2>> zebraStripes(std::span<const glm::dvec2> crossing, glm::dvec2 way,
                                                  double wide);

}  // namespace throng::io
