// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/flat_shapes.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/polygon.h"

namespace throng::io {
namespace {

double distanceTo(glm::dvec2 a, glm::dvec2 b, glm::dvec2 place) {
    const glm::dvec2 along = b - a;
    const double square = glm::dot(along, along);
    const double share = square > 0.0 ? glm::clamp(glm::dot(place - a, along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(place, a + share * along);
}

}  // namespace

double distanceToWall(const authoring::Wall& wall, glm::dvec2 place) {
    if (wall.closed && isWithin(wall.points, place)) return 0.0;
    double least = std::numeric_limits<double>::max();
    const std::size_t pieces = wall.closed ? wall.points.size() : wall.points.size() - 1;
    for (std::size_t i = 0; i < pieces; ++i)
        least = std::min(least, distanceTo(wall.points[i], wall.points[(i + 1) % wall.points.size()], place));
    return std::max(0.0, least - (wall.closed ? 0.0 : 0.5 * wall.thickness));
}

}  // namespace throng::io
