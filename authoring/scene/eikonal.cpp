// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "authoring/scene/front_queue.h"
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

constexpr float kFillDepth = 4.0f;  // m
constexpr int kExactCells =
    12;  // around small targets, where fitted planes are poor, distances are taken exactly

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

/// Distances at the target, and around small ones. From where the way is straight they are known; where walls
/// are near, it is not the distance alone that counts.
std::vector<float> startOf(const WalkMap& map, std::span<const std::uint32_t> targets,
                           const StraightWays* straight) {
    std::vector<float> start(map.cost.size(), kUnreachable);
    if (straight && straight->is_start)
        for (std::uint32_t cell = 0; cell < start.size(); ++cell)
            if (straight->from[cell] && map.cost[cell] == 1.0f)
                start[cell] = glm::distance(
                    straight->to, cellCentre(map.grid, cell % map.grid.width, cell / map.grid.width));
    for (const std::uint32_t target : targets) {
        const std::uint32_t cell =
            map.seams ? map.seams->owner_of[target] : target;  // areas may reach over seams
        if (map.cost[cell] < kUnreachable) start[cell] = 0.0f;
    }
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
          fronts_(map.grid.cell_size) {
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
            settle(front.cell, front.distance);
            if (map_.seams) settleImages(front);
            if (map_.seams && !map_.seams->rides.empty()) ride(front);
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

    void settle(std::uint32_t at, float distance) {
        settled_[at] = distance;
        for (const std::uint32_t cell : {at - 1, at + 1, at - width_, at + width_}) {
            if (settled_[cell] < kUnreachable || steps_[cell] == kUnreachable) continue;
            const float found = solve(cell);
            if (found < tentative_[cell]) push(cell, found);
        }
    }

    /// Where other charts show the cell, the way goes on from there as well.
    void settleImages(const Front& front) {
        const auto& shown = map_.seams->shown;
        const std::uint32_t owner = unpadded(front.cell);
        auto next = std::ranges::lower_bound(shown, owner, {}, &SeamCells::Shown::owner);
        for (; next != shown.end() && next->owner == owner; ++next)
            settle(padded(next->image % grid_.width, next->image / grid_.width), front.distance);
    }

    /// Whoever is in a cabin where one may ride from is as far as one is there, and the ride.
    void ride(const Front& front) {
        for (const Detours::Ride& each : map_.seams->rides) {
            if (each.to != unpadded(front.cell)) continue;
            const std::uint32_t from = padded(each.from % grid_.width, each.from / grid_.width);
            const float found = front.distance + each.cost;
            if (settled_[from] == kUnreachable && found < tentative_[from]) push(from, found);
        }
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

/// What becomes a field's cells.
struct Solved {
    std::vector<float> distance;  // what people minimise
    std::vector<float> length;    // of that way
    std::vector<glm::vec2> direction;
    std::vector<std::uint8_t> straight;  // empty: nowhere
};

/// Gives the cells that no path leads from, as far inside as anybody could ever be pushed, a distance and a
/// direction: towards the neighbour from which the target is nearest, or, where some know that the way is
/// straight, towards the nearest neighbour, because they do not see through walls.
void fillBlocked(const FieldGrid& grid, Solved& field) {
    std::vector<float>& distance = field.distance;
    std::vector<std::uint8_t> original(distance.size());
    std::vector<float> level = distance;  // what is filled first
    for (std::size_t cell = 0; cell < distance.size(); ++cell) {
        original[cell] = distance[cell] < kUnreachable;
        if (original[cell] && !field.straight.empty()) level[cell] = 0.0f;
    }
    const auto deepest = static_cast<std::uint32_t>(std::ceil(kFillDepth / grid.cell_size));
    FrontQueue fronts(grid.cell_size);
    for (std::uint32_t cell = 0; cell < distance.size(); ++cell) {
        if (!original[cell]) continue;
        bool at_the_edge = false;
        visitNeighbours(grid, cell,
                        [&](std::uint32_t next) { at_the_edge = at_the_edge || !original[next]; });
        if (at_the_edge) fronts.push({level[cell], cell});
    }
    while (!fronts.empty()) {
        const Front front = fronts.pop();
        if (front.distance > level[front.cell]) continue;
        const std::uint32_t x = front.cell % grid.width;
        const auto spread = [&](std::uint32_t cell, glm::vec2 towards) {
            const float step = kFillCost * grid.cell_size, found = front.distance + step;
            if (original[cell] || found >= level[cell] || front.depth >= deepest) return;
            level[cell] = found;
            distance[cell] = distance[front.cell] + step;
            field.length[cell] = field.length[front.cell] + step;
            field.direction[cell] = towards;
            if (!field.straight.empty()) field.straight[cell] = field.straight[front.cell];
            fronts.push({found, cell, front.depth + 1});
        };
        if (x > 0) spread(front.cell - 1, {1.0f, 0.0f});
        if (x + 1 < grid.width) spread(front.cell + 1, {-1.0f, 0.0f});
        if (front.cell >= grid.width) spread(front.cell - grid.width, {0.0f, 1.0f});
        if (front.cell + grid.width < distance.size()) spread(front.cell + grid.width, {0.0f, -1.0f});
    }
}

/// Downhill everywhere. Inside a wide target all is zero: there it points at its middle.
std::vector<glm::vec2> directionsOf(const WalkMap& map, const std::vector<float>& distance,
                                    std::span<const std::uint32_t> targets) {
    const FieldGrid& grid = map.grid;
    glm::vec2 middle(0.0f);
    for (const std::uint32_t cell : targets)
        middle += cellCentre(grid, cell % grid.width, cell / grid.width) / static_cast<float>(targets.size());
    std::vector<glm::vec2> direction(distance.size(), glm::vec2(0.0f));
    for (std::uint32_t cell = 0; cell < direction.size(); ++cell)
        if (distance[cell] < kUnreachable) direction[cell] = downhill(grid, distance, cell);
    const auto leadInward = [&](std::uint32_t cell, std::uint32_t seen) {
        if (distance[cell] == kUnreachable || direction[cell] != glm::vec2(0.0f)) return;
        const glm::vec2 inward = middle - cellCentre(grid, seen % grid.width, seen / grid.width);
        if (glm::length(inward) > 1.0e-4f) direction[cell] = glm::normalize(inward);
    };
    // What of a target lies beyond a seam is seen from where the target is.
    if (map.seams)
        for (const std::uint32_t cell : targets)
            leadInward(map.seams->owner_of[cell], cell);
    for (std::uint32_t cell = 0; cell < direction.size(); ++cell)
        leadInward(cell, cell);
    if (map.seams)
        for (const auto& [image, owner] : map.seams->shown)
            direction[image] = direction[owner];
    return direction;
}

}  // namespace

gpu::FieldCell packFieldCell(float length, glm::vec2 direction, bool straight) {
    constexpr float kLeast = 1.0e-6f;  // zero has no sign to tell
    const float distance = length < kUnreachable ? length : 1.0e9f;
    return {straight ? -std::max(distance, kLeast) : distance, packDirection(direction)};
}

Field solveField(const WalkMap& map, std::span<const std::uint32_t> targets, DistanceSolver* solver,
                 const StraightWays* straight) {
    const std::vector<float> start = startOf(map, targets, straight);
    Solved solved;
    solved.distance = solver          ? solver->solve(map, start)
                      : map.isBound() ? marchFrom<true>(map, start)
                                      : marchFrom<false>(map, start);
    solved.length = wayLengths(map, solved.distance, start);
    solved.direction = directionsOf(map, solved.distance, targets);
    if (straight) solved.straight = straight->from;
    Field field;
    field.reachable = solved.distance;
    fillBlocked(map.grid, solved);
    field.cells.resize(field.reachable.size());
    field.is_reached.resize(field.reachable.size());
    for (std::size_t cell = 0; cell < field.cells.size(); ++cell) {
        field.is_reached[cell] = field.reachable[cell] < kUnreachable;
        field.cells[cell] = packFieldCell(solved.length[cell], solved.direction[cell],
                                          straight && solved.straight[cell] != 0);
    }
    return field;
}

}  // namespace throng::authoring
