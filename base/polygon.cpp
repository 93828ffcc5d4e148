// SPDX-License-Identifier: Apache-2.0
#include "base/polygon.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace throng {
namespace {

double distanceTo(glm::dvec2 a, glm::dvec2 b, glm::dvec2 place) {
    const glm::dvec2 along = b - a;
    const double square = glm::dot(along, along);
    const double share = square > 0.0 ? glm::clamp(glm::dot(place - a, along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(place, a + share * along);
}

}  // namespace

double distanceToPieces(std::span<const glm::dvec2> points, std::size_t pieces, glm::dvec2 place) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < pieces; ++i)
        least = std::min(least, distanceTo(points[i], points[(i + 1) % points.size()], place));
    return least;
}

double distanceToPolygon(std::span<const glm::dvec2> polygon, glm::dvec2 place) {
    return isWithin(polygon, place) ? 0.0 : distanceToPieces(polygon, polygon.size(), place);
}

}  // namespace throng
