// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

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

/// Calls visit(index, centre) for the cells whose centre may lie within `reach` of a segment: of long
/// slanting ones, not for all in its box.
template <class Visit>
void visitAlong(const FieldGrid& grid, glm::vec2 a, glm::vec2 b, float reach, Visit visit) {
    const float hair = 0.01f * grid.cell_size;
    const glm::vec2 d = b - a;
    for (std::uint32_t y = row(grid, std::min(a.y, b.y) - reach); y <= row(grid, std::max(a.y, b.y) + reach);
         ++y) {
        const float centre = cellCentre(grid, 0, y).y;
        float first = 0.0f, last = 1.0f;  // the part of the segment that comes so near to the row's centres
        if (std::abs(d.y) > reach) {
            const float near = (centre - reach - hair - a.y) / d.y, far = (centre + reach + hair - a.y) / d.y;
            first = std::clamp(std::min(near, far), 0.0f, 1.0f);
            last = std::clamp(std::max(near, far), 0.0f, 1.0f);
        }
        const float from = a.x + first * d.x, to = a.x + last * d.x;
        const std::uint32_t end = column(grid, std::max(from, to) + reach + hair);
        for (std::uint32_t x = column(grid, std::min(from, to) - reach - hair); x <= end; ++x)
            visit(y * grid.width + x, cellCentre(grid, x, y));
    }
}

/// What is added to a place in the plane of charts, the same in every part of it (shaders/shared/snap.glsl).
inline glm::vec2 snapped(glm::vec2 way) {
    constexpr float kPerMetre = 65'536.0f;
    return glm::round(way * kPerMetre) / kPerMetre;
}

inline glm::vec2 nearestOnSegment(glm::vec2 point, glm::vec2 a, glm::vec2 b) {
    const glm::vec2 axis = b - a;
    const float squared = glm::dot(axis, axis);
    const float along = squared > 0.0f ? std::clamp(glm::dot(point - a, axis) / squared, 0.0f, 1.0f) : 0.0f;
    return a + along * axis;
}

inline float segmentDistance(glm::vec2 point, glm::vec2 a, glm::vec2 b) {
    return glm::distance(point, nearestOnSegment(point, a, b));
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

/// Calls visit(index, centre) for the cells whose centre lies in the polygon, as insidePolygon() has it. All
/// edges are gone through once for a row, not for a cell.
template <class Visit>
void visitInside(const FieldGrid& grid, std::span<const glm::vec2> polygon, Visit visit) {
    glm::vec2 lower = polygon.front(), upper = polygon.front();
    for (const glm::vec2 point : polygon) {
        lower = {std::min(lower.x, point.x), std::min(lower.y, point.y)};
        upper = {std::max(upper.x, point.x), std::max(upper.y, point.y)};
    }
    std::vector<float> crossings;
    for (std::uint32_t y = row(grid, lower.y); y <= row(grid, upper.y); ++y) {
        const float at = cellCentre(grid, 0, y).y;
        crossings.clear();
        for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
            const glm::vec2 a = polygon[i];
            const glm::vec2 b = polygon[j];
            if ((a.y > at) != (b.y > at)) crossings.push_back((b.x - a.x) * (at - a.y) / (b.y - a.y) + a.x);
        }
        std::sort(crossings.begin(), crossings.end());
        std::size_t passed = 0;
        for (std::uint32_t x = column(grid, lower.x); x <= column(grid, upper.x); ++x) {
            const glm::vec2 centre = cellCentre(grid, x, y);
            while (passed < crossings.size() && crossings[passed] <= centre.x)
                ++passed;
            if ((crossings.size() - passed) % 2 == 1) visit(y * grid.width + x, centre);
        }
    }
}

/// One of a road's pieces, and so much more around it.
class RoadPiece {
  public:
    RoadPiece(const LocalRoad& road, std::size_t i, float margin)
        : from_(road.centreline[i]),
          length_(glm::distance(road.centreline[i], road.centreline[i + 1])),
          along_((road.centreline[i + 1] - road.centreline[i]) / length_),
          half_(0.5f * road.width + margin),
          margin_(margin),
          is_joined_(i > 0) {}

    /// Beside it (flat ends), or within half the width of the inner corner at which it begins (round joins).
    bool holds(glm::vec2 point) const {
        if (length_ <= 0.0f) return false;
        const glm::vec2 offset = point - from_;
        const float forward = glm::dot(offset, along_);
        const float aside = std::abs(along_.x * offset.y - along_.y * offset.x);
        if (forward >= -margin_ && forward <= length_ + margin_ && aside <= half_) return true;
        return is_joined_ && glm::dot(offset, offset) <= half_ * half_;
    }

  private:
    glm::vec2 from_;
    float length_;
    glm::vec2 along_;
    float half_;
    float margin_;
    bool is_joined_;
};

/// Calls visit(index, centre) for the cells whose centre lies on a road.
/// @param wanted whether a cell is of interest still: many roads may lie over each other
template <class Visit, class Wanted>
void visitRoad(const FieldGrid& grid, const LocalRoad& road, float margin, Visit visit, Wanted wanted) {
    const float reach = 0.5f * road.width + 1.5f * margin;
    for (std::size_t i = 0; i + 1 < road.centreline.size(); ++i) {
        const RoadPiece piece(road, i, margin);
        visitAlong(grid, road.centreline[i], road.centreline[i + 1], reach,
                   [&](std::uint32_t cell, glm::vec2 centre) {
                       if (wanted(cell) && piece.holds(centre)) visit(cell, centre);
                   });
    }
}

inline void markRoad(const FieldGrid& grid, const LocalRoad& road, float margin, std::vector<bool>& marked) {
    visitRoad(
        grid, road, margin, [&](std::uint32_t cell, glm::vec2) { marked[cell] = true; },
        [&](std::uint32_t cell) { return !marked[cell]; });
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
