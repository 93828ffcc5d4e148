// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "authoring/layout.h"

namespace throng::io {

/// By the even-odd rule.
bool isInside(std::span<const glm::dvec2> polygon, glm::dvec2 place);

/// m, from its faces; 0 within.
double distanceToWall(const authoring::Wall& wall, glm::dvec2 place);

}  // namespace throng::io
