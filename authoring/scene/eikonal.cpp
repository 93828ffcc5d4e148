// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

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
constexpr float kFillDepth = 4.0f;  // m
constexpr int kExactCells =
    12;  // around small targets, where fitted planes are poor, distances are taken exactly

constexpr float kBucketCells = 0.06f;  // width of the queue's buckets

struct Front {
    float distance;
    std::uint32_t cell;
    std::uint32_t depth = 0;  // cells into what is blocked
    bool operator>(const Front& other) const {
        return distance > other.distance || (distance == other.distance && cell > other.cell);
    }
};

/// A priority queue for fronts, the nearest first and equal ones by their cells: as one heap would have them,
/// but in buckets of nearly equal distances, each a heap of its own when its turn comes. Small heaps stay in
/// the processor's cache: three times as fast as one for all.
class FrontQueue {
  public:
    /// @param width of a bucket, m
    explicit FrontQueue(float width) : per_metre_(1.0f / width) {}

    /// Nothing may be nearer than what was popped last.
    void push(const Front& front) {
        const auto bucket = static_cast<std::size_t>(front.distance * per_metre_);
        if (bucket >= buckets_.size()) buckets_.resize(bucket + 1 + bucket / 2);
        buckets_[bucket].push_back(front);
        if (bucket == current_)
            std::push_heap(buckets_[bucket].begin(), buckets_[bucket].end(), std::greater<>());
        ++count_;
    }
    bool empty() const { return count_ == 0; }
    Front pop() {
        if (buckets_[current_].empty()) advance();
        std::vector<Front>& bucket = buckets_[current_];
        std::pop_heap(bucket.begin(), bucket.end(), std::greater<>());
        const Front front = bucket.back();
        bucket.pop_back();
        --count_;
        return front;
    }

  private:
    void advance() {
        std::vector<Front> spare = std::move(buckets_[current_]);
        while (buckets_[current_].empty())
            ++current_;
        std::make_heap(buckets_[current_].begin(), buckets_[current_].end(), std::greater<>());
        // The memory of a bucket that is done serves one that is just beginning.
        const std::size_t ahead = current_ + 2;
        if (ahead < buckets_.size() && buckets_[ahead].empty()) buckets_[ahead] = std::move(spare);
    }

    float per_metre_;
    std::vector<std::vector<Front>> buckets_;
    std::size_t current_ = 0;
    std::size_t count_ = 0;
};

/// Exact distances around a point target, where no obstacle or bad ground is near.
void startAround(const WalkMap& map, std::uint32_t target, std::vector<float>& start) {
    const FieldGrid& grid = map.grid;
    const auto x0 = static_cast<int>(target % grid.width);
    const auto y0 = static_cast<int>(target / grid.width);
    const auto each = [&](auto&& visit) {
        for (int dy = -kExactCells; dy <= kExactCells; ++dy)
            for (int dx = -kExactCells; dx <= kExactCells; ++dx) {
                const int x = x0 + dx;
                const int y = y0 + dy;
                if (x < 0 || y < 0 || x >= static_cast<int>(grid.width) || y >= static_cast<int>(grid.height))
                    continue;
                visit(static_cast<std::uint32_t>(y) * grid.width + static_cast<std::uint32_t>(x),
                      std::hypot(static_cast<float>(dx), static_cast<float>(dy)));
            }
    };
    bool open = true;
    each([&](std::uint32_t cell, float) { open = open && map.cost[cell] == 1.0f; });
    if (!open) return;
    each([&](std::uint32_t cell, float cells) {
        if (cells <= static_cast<float>(kExactCells))
            start[cell] = std::min(start[cell], cells * grid.cell_size);
    });
}

/// Distances at the target, and around small ones.
std::vector<float> startOf(const WalkMap& map, std::span<const std::uint32_t> targets) {
    std::vector<float> start(map.cost.size(), kUnreachable);
    for (const std::uint32_t cell : targets)
        if (map.cost[cell] < kUnreachable) start[cell] = 0.0f;
    if (targets.size() <= 4 && !map.isBound())
        for (const std::uint32_t cell : targets)
            startAround(map, cell, start);
    return start;
}

/// Works on a grid with a blocked margin of one cell all round, so that no cell has to ask whether it has a
/// neighbour.
/// @tparam kBound whether sides of cells are closed or roads one-way
template <bool kBound>
class Marcher {
  public:
    explicit Marcher(const WalkMap& map)
        : map_(map),
          grid_(map.grid),
          width_(grid_.width + 2),
          steps_(std::size_t{width_} * (grid_.height + 2), kUnreachable),
          settled_(steps_.size(), kUnreachable),
          tentative_(steps_.size(), kUnreachable),
          fronts_(kBucketCells * map.grid.cell_size) {
        for (std::uint32_t y = 0; y < grid_.height; ++y)
            for (std::uint32_t x = 0; x < grid_.width; ++x)
                steps_[padded(x, y)] = map.cost[std::size_t{y} * grid_.width + x] * grid_.cell_size;
    }

    void start(const std::vector<float>& distances) {
        for (std::uint32_t cell = 0; cell < distances.size(); ++cell)
            if (distances[cell] < kUnreachable)
                push(padded(cell % grid_.width, cell / grid_.width), distances[cell]);
    }

    void march() {
        while (!fronts_.empty()) {
            const Front front = fronts_.pop();
            if (settled_[front.cell] < kUnreachable) continue;
            settled_[front.cell] = front.distance;
            for (const std::uint32_t cell :
                 {front.cell - 1, front.cell + 1, front.cell - width_, front.cell + width_}) {
                if (settled_[cell] < kUnreachable || steps_[cell] == kUnreachable) continue;
                const float found = solve(cell);
                if (found < tentative_[cell]) push(cell, found);
            }
        }
    }

    /// Distances of the cells of the map.
    std::vector<float> take() const {
        std::vector<float> distances;
        distances.reserve(map_.cost.size());
        for (std::uint32_t y = 0; y < grid_.height; ++y) {
            const auto line = settled_.begin() + padded(0, y);
            distances.insert(distances.end(), line, line + grid_.width);
        }
        return distances;
    }

  private:
    std::uint32_t padded(std::uint32_t x, std::uint32_t y) const { return (y + 1) * width_ + x + 1; }
    std::uint32_t unpadded(std::uint32_t cell) const {
        return (cell / width_ - 1) * grid_.width + cell % width_ - 1;
    }

    void push(std::uint32_t cell, float distance) {
        tentative_[cell] = distance;
        fronts_.push({distance, cell});
    }

    /// The settled distance beyond one side of a cell, if one may walk that way.
    float ahead(std::uint32_t cell, std::uint32_t neighbour, glm::vec2 step) const {
        if constexpr (kBound) {
            if (settled_[neighbour] == kUnreachable) return kUnreachable;
            const std::uint32_t here = unpadded(cell);
            if (!map_.open_sides.empty()) {
                const std::uint8_t side = step.x != 0.0f ? gpu::OPEN_TO_X : gpu::OPEN_TO_Y;
                if (!(map_.open_sides[std::min(here, unpadded(neighbour))] & side)) return kUnreachable;
            }
            if (!map_.one_way.empty() && glm::dot(map_.one_way[here], step) < gpu::AGAINST_ONE_WAY)
                return kUnreachable;
        }
        return settled_[neighbour];
    }

    float solve(std::uint32_t cell) const {
        const float across =
            std::min(ahead(cell, cell - 1, {-1.0f, 0.0f}), ahead(cell, cell + 1, {1.0f, 0.0f}));
        const float along =
            std::min(ahead(cell, cell - width_, {0.0f, -1.0f}), ahead(cell, cell + width_, {0.0f, 1.0f}));
        const float step = steps_[cell];
        const float near = std::min(across, along);
        const float far = std::max(across, along);
        if (far - near >= step) return near + step;
        const float difference = far - near;
        return 0.5f * (near + far + std::sqrt(std::max(0.0f, 2.0f * step * step - difference * difference)));
    }

    const WalkMap& map_;
    const FieldGrid& grid_;
    std::uint32_t width_;           // with the margin
    std::vector<float> steps_;      // m that crossing a cell costs
    std::vector<float> settled_;    // distances that are final
    std::vector<float> tentative_;  // the best so far
    FrontQueue fronts_;
};

template <bool kBound>
std::vector<float> marchFrom(const WalkMap& map, const std::vector<float>& start) {
    Marcher<kBound> marcher(map);
    marcher.start(start);
    marcher.march();
    return marcher.take();
}

/// As glm::packSnorm2x16, without its calls of a library for each number.
std::uint32_t packDirection(glm::vec2 direction) {
    const auto word = [](float value) {
        const float scaled = value * 32767.0f;
        return static_cast<std::uint32_t>(
            static_cast<std::uint16_t>(static_cast<std::int16_t>(scaled + std::copysign(0.5f, scaled))));
    };
    return word(direction.x) | word(direction.y) << 16;
}

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

/// Gives the cells that no path leads from, as far inside as anybody could ever be pushed, a distance and a
/// direction towards the nearest cell that has one.
void fillBlocked(const FieldGrid& grid, std::vector<float>& distance, std::vector<glm::vec2>& direction) {
    std::vector<std::uint8_t> original(distance.size());
    for (std::size_t cell = 0; cell < distance.size(); ++cell)
        original[cell] = distance[cell] < kUnreachable;
    const auto deepest = static_cast<std::uint32_t>(std::ceil(kFillDepth / grid.cell_size));
    FrontQueue fronts(kBucketCells * grid.cell_size);
    for (std::uint32_t cell = 0; cell < distance.size(); ++cell) {
        if (!original[cell]) continue;
        bool at_the_edge = false;
        visitNeighbours(grid, cell,
                        [&](std::uint32_t next) { at_the_edge = at_the_edge || !original[next]; });
        if (at_the_edge) fronts.push({distance[cell], cell});
    }
    while (!fronts.empty()) {
        const Front front = fronts.pop();
        if (front.distance > distance[front.cell]) continue;
        const std::uint32_t x = front.cell % grid.width;
        const auto spread = [&](std::uint32_t cell, glm::vec2 towards) {
            const float found = front.distance + kFillCost * grid.cell_size;
            if (original[cell] || found >= distance[cell] || front.depth >= deepest) return;
            distance[cell] = found;
            direction[cell] = towards;
            fronts.push({found, cell, front.depth + 1});
        };
        if (x > 0) spread(front.cell - 1, {1.0f, 0.0f});
        if (x + 1 < grid.width) spread(front.cell + 1, {-1.0f, 0.0f});
        if (front.cell >= grid.width) spread(front.cell - grid.width, {0.0f, 1.0f});
        if (front.cell + grid.width < distance.size()) spread(front.cell + grid.width, {0.0f, -1.0f});
    }
}

}  // namespace

Field solveField(const WalkMap& map, std::span<const std::uint32_t> targets, DistanceSolver* solver) {
    Field field;
    const std::vector<float> start = startOf(map, targets);
    field.reachable = solver          ? solver->solve(map, start)
                      : map.isBound() ? marchFrom<true>(map, start)
                                      : marchFrom<false>(map, start);

    // Inside a wide target all is zero: point at its middle.
    glm::vec2 middle(0.0f);
    for (const std::uint32_t cell : targets)
        middle += cellCentre(map.grid, cell % map.grid.width, cell / map.grid.width) /
                  static_cast<float>(targets.size());
    std::vector<glm::vec2> direction(field.reachable.size(), glm::vec2(0.0f));
    for (std::uint32_t cell = 0; cell < direction.size(); ++cell) {
        if (field.reachable[cell] == kUnreachable) continue;
        direction[cell] = downhill(map.grid, field.reachable, cell);
        if (direction[cell] != glm::vec2(0.0f)) continue;
        const glm::vec2 inward = middle - cellCentre(map.grid, cell % map.grid.width, cell / map.grid.width);
        if (glm::length(inward) > 1.0e-4f) direction[cell] = glm::normalize(inward);
    }
    std::vector<float> distance = field.reachable;
    fillBlocked(map.grid, distance, direction);
    field.cells.resize(distance.size());
    for (std::size_t cell = 0; cell < distance.size(); ++cell)
        field.cells[cell] = {distance[cell] < kUnreachable ? distance[cell] : 1.0e9f,
                             packDirection(direction[cell])};
    return field;
}

}  // namespace throng::authoring
