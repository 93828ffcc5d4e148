// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>

#include "authoring/layout.h"

namespace throng::io {

/// m, from its faces; 0 within.
double distanceToWall(const authoring::Wall& wall, glm::dvec2 place);

}  // namespace throng::io
