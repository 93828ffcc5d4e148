// SPDX-License-Identifier: Apache-2.0
#include <glm/packing.hpp>
#include <queue>

#include "authoring/scene/raster.h"

// How far is it to the target, everywhere at once?
//
// The walking distance T obeys the Eikonal equation |grad T| = cost: one metre further away costs one more
// metre, or several where the ground is bad. Fast marching (Sethian 1996) solves it like Dijkstra's algorithm
// solves graphs, outward from the target in the order of T, but each cell takes its value from a plane fitted
// through its settled neighbours on two axes, so distances are those of free walking and not of steps along
// the axes. People walk downhill on T: the shortest way round all walls.
namespace throng::authoring {
namespace {

constexpr float kFillCost = 10.0f;  // per metre into what is blocked, so that "downhill" points out of it
constexpr float kAgainstOneWay =
    -0.1f;  // cosine: walking more than this against a one-way road is not allowed
constexpr int kExactCells =
    12;  // around small targets, where fitted planes are poor, distances are taken exactly

struct Front {
    float distance;
    std::uint32_t cell;
    bool operator>(const Front& other) const {
        return distance > other.distance || (distance == other.distance && cell > other.cell);
    }
};
using Heap = std::priority_queue<Front, std::vector<Front>, std::greater<>>;

class Marcher {
  public:
    explicit Marcher(const WalkMap& map)
        : map_(map),
          grid_(map.grid),
          distance_(map.cost.size(), kUnreachable),
          settled_(map.cost.size(), false) {}

    void start(std::span<const std::uint32_t> targets) {
        for (const std::uint32_t cell : targets)
            if (map_.cost[cell] < kUnreachable) push(cell, 0.0f);
        if (targets.size() <= 4)
            for (const std::uint32_t cell : targets)
                startAround(cell);
    }

    void march() {
        while (!heap_.empty()) {
            const Front front = heap_.top();
            heap_.pop();
            if (settled_[front.cell]) continue;
            settled_[front.cell] = true;
            visitNeighbours(grid_, front.cell, [&](std::uint32_t cell) {
                if (settled_[cell] || map_.cost[cell] == kUnreachable) return;
                const float found = solve(cell);
                if (found < distance_[cell]) push(cell, found);
            });
        }
    }

    std::vector<float> take() { return std::move(distance_); }

  private:
    void push(std::uint32_t cell, float distance) {
        distance_[cell] = distance;
        heap_.push({distance, cell});
    }

    /// Exact distances around a point target, where no obstacle or bad ground is near.
    void startAround(std::uint32_t target) {
        const auto x0 = static_cast<int>(target % grid_.width);
        const auto y0 = static_cast<int>(target / grid_.width);
        const auto each = [&](auto&& visit) {
            for (int dy = -kExactCells; dy <= kExactCells; ++dy)
                for (int dx = -kExactCells; dx <= kExactCells; ++dx) {
                    const int x = x0 + dx;
                    const int y = y0 + dy;
                    if (x < 0 || y < 0 || x >= static_cast<int>(grid_.width) ||
                        y >= static_cast<int>(grid_.height))
                        continue;
                    visit(static_cast<std::uint32_t>(y) * grid_.width + static_cast<std::uint32_t>(x),
                          std::hypot(static_cast<float>(dx), static_cast<float>(dy)));
                }
        };
        bool open = map_.one_way.empty() && map_.open_sides.empty();
        each([&](std::uint32_t cell, float) { open = open && map_.cost[cell] == 1.0f; });
        if (!open) return;
        each([&](std::uint32_t cell, float cells) {
            const float exact = cells * grid_.cell_size;
            if (cells <= static_cast<float>(kExactCells) && exact < distance_[cell]) push(cell, exact);
        });
    }

    /// The settled distance beyond one side of a cell, if one may walk that way.
    float ahead(std::uint32_t cell, std::uint32_t neighbour, glm::vec2 step) const {
        if (!settled_[neighbour]) return kUnreachable;
        if (!map_.open_sides.empty()) {
            const std::uint8_t side = step.x != 0.0f ? gpu::OPEN_TO_X : gpu::OPEN_TO_Y;
            if (!(map_.open_sides[std::min(cell, neighbour)] & side)) return kUnreachable;
        }
        if (!map_.one_way.empty() && glm::dot(map_.one_way[cell], step) < kAgainstOneWay) return kUnreachable;
        return distance_[neighbour];
    }

    float solve(std::uint32_t cell) const {
        const std::uint32_t x = cell % grid_.width;
        const float left = x > 0 ? ahead(cell, cell - 1, {-1.0f, 0.0f}) : kUnreachable;
        const float right = x + 1 < grid_.width ? ahead(cell, cell + 1, {1.0f, 0.0f}) : kUnreachable;
        const float below =
            cell >= grid_.width ? ahead(cell, cell - grid_.width, {0.0f, -1.0f}) : kUnreachable;
        const float above = cell + grid_.width < distance_.size()
                                ? ahead(cell, cell + grid_.width, {0.0f, 1.0f})
                                : kUnreachable;
        const float across = std::min(left, right);
        const float along = std::min(below, above);
        const float step = map_.cost[cell] * grid_.cell_size;
        const float near = std::min(across, along);
        const float far = std::max(across, along);
        if (far - near >= step) return near + step;
        const float difference = far - near;
        return 0.5f * (near + far + std::sqrt(std::max(0.0f, 2.0f * step * step - difference * difference)));
    }

    const WalkMap& map_;
    const FieldGrid& grid_;
    std::vector<float> distance_;
    std::vector<bool> settled_;
    Heap heap_;
};

/// Downhill at a reachable cell: central differences, one-sided beside what is blocked.
glm::vec2 downhill(const FieldGrid& grid, const std::vector<float>& distance, std::uint32_t cell) {
    const auto slope = [&](bool has_lower, bool has_upper, std::uint32_t stride) {
        const float here = distance[cell];
        const float lower = has_lower ? distance[cell - stride] : kUnreachable;
        const float upper = has_upper ? distance[cell + stride] : kUnreachable;
        if (lower < kUnreachable && upper < kUnreachable) return 0.5f * (upper - lower);
        if (lower < kUnreachable) return here - lower;
        if (upper < kUnreachable) return upper - here;
        return 0.0f;
    };
    const std::uint32_t x = cell % grid.width;
    const glm::vec2 gradient(slope(x > 0, x + 1 < grid.width, 1),
                             slope(cell >= grid.width, cell + grid.width < distance.size(), grid.width));
    const float size = glm::length(gradient);
    return size > 1.0e-6f ? -gradient / size : glm::vec2(0.0f);
}

/// Gives every cell that no path leads from a finite distance and a direction towards the nearest cell that
/// has one.
void fillBlocked(const FieldGrid& grid, std::vector<float>& distance, std::vector<glm::vec2>& direction) {
    Heap heap;
    for (std::uint32_t cell = 0; cell < distance.size(); ++cell)
        if (distance[cell] < kUnreachable) heap.push({distance[cell], cell});
    std::vector<bool> original(distance.size());
    for (std::size_t cell = 0; cell < distance.size(); ++cell)
        original[cell] = distance[cell] < kUnreachable;
    while (!heap.empty()) {
        const Front front = heap.top();
        heap.pop();
        if (front.distance > distance[front.cell]) continue;
        const std::uint32_t x = front.cell % grid.width;
        const auto spread = [&](std::uint32_t cell, glm::vec2 towards) {
            const float found = front.distance + kFillCost * grid.cell_size;
            if (original[cell] || found >= distance[cell]) return;
            distance[cell] = found;
            direction[cell] = towards;
            heap.push({found, cell});
        };
        if (x > 0) spread(front.cell - 1, {1.0f, 0.0f});
        if (x + 1 < grid.width) spread(front.cell + 1, {-1.0f, 0.0f});
        if (front.cell >= grid.width) spread(front.cell - grid.width, {0.0f, 1.0f});
        if (front.cell + grid.width < distance.size()) spread(front.cell + grid.width, {0.0f, -1.0f});
    }
}

}  // namespace

Field solveField(const WalkMap& map, std::span<const std::uint32_t> targets) {
    Marcher marcher(map);
    marcher.start(targets);
    marcher.march();
    Field field;
    field.reachable = marcher.take();

    // Inside a wide target all is zero: point at its middle.
    glm::vec2 middle(0.0f);
    for (const std::uint32_t cell : targets)
        middle += cellCentre(map.grid, cell % map.grid.width, cell / map.grid.width) /
                  static_cast<float>(targets.size());
    std::vector<glm::vec2> direction(field.reachable.size(), glm::vec2(0.0f));
    for (std::uint32_t cell = 0; cell < direction.size(); ++cell) {
        if (field.reachable[cell] == kUnreachable) continue;
        direction[cell] = downhill(map.grid, field.reachable, cell);
        const glm::vec2 inward = middle - cellCentre(map.grid, cell % map.grid.width, cell / map.grid.width);
        if (direction[cell] == glm::vec2(0.0f) && glm::length(inward) > 1.0e-4f)
            direction[cell] = glm::normalize(inward);
    }
    std::vector<float> distance = field.reachable;
    fillBlocked(map.grid, distance, direction);
    field.cells.resize(distance.size());
    for (std::size_t cell = 0; cell < distance.size(); ++cell)
        field.cells[cell] = {distance[cell] < kUnreachable ? distance[cell] : 1.0e9f,
                             glm::packSnorm2x16(direction[cell])};
    return field;
}

}  // namespace throng::authoring
