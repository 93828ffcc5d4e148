// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <utility>

namespace throng {

/// Even-odd rule; two polygons with a common edge never share a point beside it, nor leave one out.
inline bool isWithin(std::span<const glm::dvec2> polygon, glm::dvec2 point) {
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        glm::dvec2 a = polygon[i], b = polygon[j];
        if ((a.y > point.y) == (b.y > point.y)) continue;
        if (a.y > b.y) std::swap(a, b);  // the same crossing, whichever way the edge runs
        if (point.x < a.x + (b.x - a.x) * ((point.y - a.y) / (b.y - a.y))) inside = !inside;
    }
    return inside;
}

/// To the first `pieces` pieces of a line; behind its last point comes the first one.
double distanceToPieces(std::span<const glm::dvec2> points, std::size_t pieces, glm::dvec2 place);

/// 0 within.
double distanceToPolygon(std::span<const glm::dvec2> polygon, glm::dvec2 place);

}  // namespace throng
