// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/wall_grid.h"

#include <cmath>

namespace throng::authoring {
namespace {

constexpr float kSmallestGridCell = 2.0f;  // m
constexpr double kMostGridCells = 250'000.0;
constexpr std::size_t kMostItems = 8'000'000;

FieldGrid gridOf(glm::vec2 minimum, glm::vec2 maximum, float cell) {
    FieldGrid grid;
    const glm::vec2 extent = maximum - minimum;
    grid.minimum = minimum;
    grid.cell_size = cell;
    grid.width = static_cast<std::uint32_t>(std::ceil(extent.x / cell)) + 1;
    grid.height = static_cast<std::uint32_t>(std::ceil(extent.y / cell)) + 1;
    return grid;
}

}  // namespace

WallGrid::WallGrid(std::span<const gpu::WallSegment> walls, glm::vec2 minimum, glm::vec2 maximum) {
    const glm::vec2 extent = maximum - minimum;
    double cell =
        std::max({double{kSmallestGridCell}, std::sqrt(double{extent.x} * double{extent.y} / kMostGridCells),
                  4.0 * std::max(extent.x, extent.y) / kMostGridCells});
    const auto eachCell = [&](auto&& visit) {
        for (std::uint32_t i = 0; i < walls.size(); ++i)
            visitAlong(grid_, walls[i].a, walls[i].b,
                       walls[i].half_thickness + kReach + 0.75f * grid_.cell_size,
                       [&](std::uint32_t at, glm::vec2) { visit(at, i); });
    };
    std::size_t items = 0;
    do {  // of thick walls, larger cells
        grid_ = gridOf(minimum, maximum, static_cast<float>(cell));
        items = 0;
        eachCell([&](std::uint32_t, std::uint32_t) { ++items; });
        cell *= 2.0;
    } while (items > kMostItems && cellCount(grid_) > 4);
    starts_.assign(cellCount(grid_) + 1, 0);
    eachCell([&](std::uint32_t at, std::uint32_t) { ++starts_[at + 1]; });
    for (std::size_t i = 1; i < starts_.size(); ++i)
        starts_[i] += starts_[i - 1];
    items_.resize(items);
    std::vector<std::uint32_t> cursors(starts_.begin(), starts_.end() - 1);
    eachCell([&](std::uint32_t at, std::uint32_t wall) { items_[cursors[at]++] = wall; });
}

std::span<const std::uint32_t> WallGrid::near(glm::vec2 point) const {
    return inCell(std::size_t{row(grid_, point.y)} * grid_.width + column(grid_, point.x));
}

}  // namespace throng::authoring
