// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <span>

#include "authoring/scene/fields.h"

/// Small geometry that the rasters share.
namespace throng::authoring {

inline std::size_t cellCount(const FieldGrid& grid) {
    return std::size_t{grid.width} * grid.height;
}

inline glm::vec2 cellCentre(const FieldGrid& grid, std::uint32_t x, std::uint32_t y) {
    return grid.minimum + (glm::vec2(x, y) + 0.5f) * grid.cell_size;
}

/// Column of an abscissa, clamped to the grid.
inline std::uint32_t column(const FieldGrid& grid, float x) {
    const float at = std::floor((x - grid.minimum.x) / grid.cell_size);
    return static_cast<std::uint32_t>(std::clamp(at, 0.0f, static_cast<float>(grid.width - 1)));
}

inline std::uint32_t row(const FieldGrid& grid, float y) {
    const float at = std::floor((y - grid.minimum.y) / grid.cell_size);
    return static_cast<std::uint32_t>(std::clamp(at, 0.0f, static_cast<float>(grid.height - 1)));
}

/// Calls visit(index) for the up to four cells beside one.
template <class Visit>
void visitNeighbours(const FieldGrid& grid, std::uint32_t cell, Visit visit) {
    const std::uint32_t x = cell % grid.width;
    if (x > 0) visit(cell - 1);
    if (x + 1 < grid.width) visit(cell + 1);
    if (cell >= grid.width) visit(cell - grid.width);
    if (cell + grid.width < cellCount(grid)) visit(cell + grid.width);
}

/// Calls visit(index, centre) for the cells whose centre may lie in the box.
template <class Visit>
void visitBox(const FieldGrid& grid, glm::vec2 lower, glm::vec2 upper, Visit visit) {
    for (std::uint32_t y = row(grid, lower.y); y <= row(grid, upper.y); ++y)
        for (std::uint32_t x = column(grid, lower.x); x <= column(grid, upper.x); ++x)
            visit(y * grid.width + x, cellCentre(grid, x, y));
}

inline float segmentDistance(glm::vec2 point, glm::vec2 a, glm::vec2 b) {
    const glm::vec2 axis = b - a;
    const float squared = glm::dot(axis, axis);
    const float along = squared > 0.0f ? std::clamp(glm::dot(point - a, axis) / squared, 0.0f, 1.0f) : 0.0f;
    return glm::distance(point, a + along * axis);
}

/// Even-odd rule: any winding.
inline bool insidePolygon(std::span<const glm::vec2> polygon, glm::vec2 point) {
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const glm::vec2 a = polygon[i];
        const glm::vec2 b = polygon[j];
        if ((a.y > point.y) == (b.y > point.y)) continue;
        if (point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
    }
    return inside;
}

/// On a road: beside one of its pieces (flat ends), or within half its width of an inner corner (round
/// joins).
inline bool onRoad(const LocalRoad& road, glm::vec2 point, float margin = 0.0f) {
    const float half = 0.5f * road.width + margin;
    for (std::size_t i = 0; i + 1 < road.centreline.size(); ++i) {
        const glm::vec2 a = road.centreline[i];
        const glm::vec2 b = road.centreline[i + 1];
        const float length = glm::distance(a, b);
        if (length <= 0.0f) continue;
        const glm::vec2 along = (b - a) / length;
        const glm::vec2 offset = point - a;
        const float forward = glm::dot(offset, along);
        const float aside = std::abs(along.x * offset.y - along.y * offset.x);
        if (forward >= -margin && forward <= length + margin && aside <= half) return true;
        if (i > 0 && glm::dot(offset, offset) <= half * half) return true;
    }
    return false;
}

struct Box {
    glm::vec2 lower{0.0f};
    glm::vec2 upper{0.0f};
};

inline Box boundsOf(std::span<const glm::vec2> points, float margin) {
    Box box{points.front(), points.front()};
    for (const glm::vec2 point : points) {
        box.lower = {std::min(box.lower.x, point.x), std::min(box.lower.y, point.y)};
        box.upper = {std::max(box.upper.x, point.x), std::max(box.upper.y, point.y)};
    }
    return {box.lower - margin, box.upper + margin};
}

}  // namespace throng::authoring
