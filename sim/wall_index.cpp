// SPDX-License-Identifier: Apache-2.0
#include "sim/wall_index.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace throng::sim {
namespace {

float distanceToSegment(glm::vec2 point, const gpu::WallSegment& segment) {
    const glm::vec2 axis = segment.b - segment.a;
    const float squared = glm::dot(axis, axis);
    const float along =
        squared > 0.0f ? std::clamp(glm::dot(point - segment.a, axis) / squared, 0.0f, 1.0f) : 0.0f;
    return glm::length(point - (segment.a + along * axis));
}

int cellCoordinate(float value, float minimum, float cell, std::uint32_t count) {
    return std::clamp(static_cast<int>(std::floor((value - minimum) / cell)), 0, static_cast<int>(count) - 1);
}

template <class Visit>
void visitCells(const gpu::WallSegment& segment, const gpu::Parameters& cells, float reach, Visit visit) {
    const glm::vec2 lower = glm::min(segment.a, segment.b) - (reach + segment.half_thickness);
    const glm::vec2 upper = glm::max(segment.a, segment.b) + (reach + segment.half_thickness);
    const float half_diagonal = 0.70711f * cells.cell_size;
    const int x1 = cellCoordinate(upper.x, cells.cells_minimum.x, cells.cell_size, cells.cells_width);
    const int y1 = cellCoordinate(upper.y, cells.cells_minimum.y, cells.cell_size, cells.cells_height);
    for (int y = cellCoordinate(lower.y, cells.cells_minimum.y, cells.cell_size, cells.cells_height); y <= y1;
         ++y)
        for (int x = cellCoordinate(lower.x, cells.cells_minimum.x, cells.cell_size, cells.cells_width);
             x <= x1; ++x) {
            const glm::vec2 centre = cells.cells_minimum + (glm::vec2(x, y) + 0.5f) * cells.cell_size;
            if (distanceToSegment(centre, segment) - segment.half_thickness <= reach + half_diagonal)
                visit(static_cast<std::size_t>(y) * cells.cells_width + static_cast<std::size_t>(x));
        }
}

}  // namespace

WallIndex indexWalls(std::span<const gpu::WallSegment> segments, const gpu::Parameters& cells, float reach) {
    WallIndex index;
    index.starts.assign(static_cast<std::size_t>(cells.cells_width) * cells.cells_height + 1, 0);
    for (const gpu::WallSegment& segment : segments)
        visitCells(segment, cells, reach, [&](std::size_t cell) { ++index.starts[cell + 1]; });
    for (std::size_t cell = 1; cell < index.starts.size(); ++cell)
        index.starts[cell] += index.starts[cell - 1];
    index.items.resize(index.starts.back());
    std::vector<std::uint32_t> cursors(index.starts.begin(), index.starts.end() - 1);
    for (std::uint32_t i = 0; i < segments.size(); ++i)
        visitCells(segments[i], cells, reach, [&](std::size_t cell) { index.items[cursors[cell]++] = i; });
    return index;
}

std::vector<std::uint32_t> startsOfMarked(const WallIndex& index) {
    const std::size_t cells = index.starts.size() - 1;
    const std::size_t words = 2 * ((cells + 31) / 32);
    std::vector<std::uint32_t> starts(words, 0);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        std::uint32_t* mark = &starts[cell / 32 * 2];
        if (cell % 32 == 0) mark[1] = static_cast<std::uint32_t>(starts.size());
        if (index.starts[cell] == index.starts[cell + 1]) continue;
        mark[0] |= 1u << cell % 32;
        starts.push_back(index.starts[cell]);
    }
    starts.push_back(index.starts.back());
    return starts;
}

glm::uvec2 wallsNear(std::span<const std::uint32_t> starts, std::size_t cell) {
    const std::uint32_t marks = starts[cell / 32 * 2], bit = 1u << cell % 32;
    if ((marks & bit) == 0) return {0, 0};
    const std::size_t at =
        starts[cell / 32 * 2 + 1] + static_cast<std::size_t>(std::popcount(marks & (bit - 1)));
    return {starts[at], starts[at + 1]};
}

std::vector<std::uint32_t> markCells(std::span<const glm::vec2> places, const gpu::Parameters& cells,
                                     float reach) {
    const std::size_t count = std::size_t{cells.cells_width} * cells.cells_height;
    std::vector<std::uint32_t> words((count + 31) / 32, 0);
    for (const glm::vec2 place : places) {
        gpu::WallSegment point{};
        point.a = point.b = place;
        visitCells(point, cells, reach, [&](std::size_t cell) { words[cell / 32] |= 1u << cell % 32; });
    }
    return words;
}

}  // namespace throng::sim
