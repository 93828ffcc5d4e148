// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/flat_shapes.h"

#include <algorithm>

#include "base/polygon.h"

namespace throng::io {

double distanceToWall(const authoring::Wall& wall, glm::dvec2 place) {
    if (wall.closed) return distanceToPolygon(wall.points, place);
    return std::max(0.0, distanceToPieces(wall.points, wall.points.size() - 1, place) - 0.5 * wall.thickness);
}

}  // namespace throng::io
