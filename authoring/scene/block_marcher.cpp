// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "authoring/scene/field_blocks.h"
#include "authoring/scene/front_queue.h"
#include "authoring/scene/raster.h"

// Distances on ground in blocks. Between fine cells the Eikonal equation is solved as on a raster
// (authoring/scene/eikonal.cpp). An open block is a room without anything in it: from every node on its edge,
// its own corners and the cells just across, the way to every other one is straight. A front that comes to
// the edge between two of them goes on from the point between that serves each of the others best, as on
// triangles (Kimmel and Sethian 1998). Rooms join blocks of different kinds, so a node may be reached again
// by a way that is a little better, and then goes on again.
namespace throng::authoring {
namespace {

constexpr float kBetter = 1.0e-4f;      // m: less is none
constexpr std::uint32_t kDeepest = 20;  // cells into what is blocked
constexpr std::uint32_t kSide = FieldBlocks::kSide;

struct Value {
    float distance = kUnreachable;  // what people minimise
    float length = 0.0f;            // of that way
    glm::vec2 direction{0.0f};
    bool straight = false;
    bool is_reached = false;  // by a path, not only filled in
};

/// The nodes round an open block, in the order of its edge.
struct Room {
    static constexpr std::size_t kMost = 4 * (kSide + 1);
    std::array<std::uint32_t, kMost> nodes;
    std::array<glm::vec2, kMost> at;  // m from the block's lower corner
    std::size_t count = 0;

    void add(std::uint32_t node, glm::vec2 place) {
        nodes[count] = node;
        at[count++] = place;
    }
};

class BlockMarcher {
  public:
    explicit BlockMarcher(const BlockMap& map)
        : map_(map),
          blocks_(*map.blocks),
          h_(blocks_.cells.cell_size),
          values_(map.cost.size()),
          fronts_(h_) {}

    void start(std::uint32_t node, float distance, glm::vec2 direction) {
        if (map_.cost[node] == kUnreachable || distance >= values_[node].distance) return;
        values_[node] = {distance, distance, direction};
        fronts_.push({distance, node});
    }

    void march() {
        while (!fronts_.empty()) {
            const Front front = fronts_.pop();
            if (front.distance > values_[front.cell].distance) continue;
            if (front.cell < blocks_.fine_nodes)
                spreadFromCell(front.cell);
            else
                spreadFromCorner(front.cell);
        }
    }

    /// Into what is blocked, so that "downhill" points out of it: each cell as its nearest neighbour.
    void fill() {
        std::vector<float> depths(blocks_.fine_nodes, kUnreachable);
        FrontQueue fronts(h_);
        for (std::uint32_t node = 0; node < blocks_.fine_nodes; ++node) {
            if (!values_[node].is_reached) continue;
            depths[node] = 0.0f;
            bool at_the_edge = false;
            forEachSide(node, [&](std::uint32_t next, glm::vec2) {
                at_the_edge = at_the_edge || !values_[next].is_reached;
            });
            if (at_the_edge) fronts.push({0.0f, node});
        }
        while (!fronts.empty()) {
            const Front front = fronts.pop();
            if (front.distance > depths[front.cell] || front.depth >= kDeepest) continue;
            const Value from = values_[front.cell];
            forEachSide(front.cell, [&](std::uint32_t node, glm::vec2 towards) {
                const float step = kFillCost * h_, found = front.distance + step;
                if (found >= depths[node]) return;
                depths[node] = found;
                values_[node] = {from.distance + step, from.length + step, -towards, from.straight, false};
                fronts.push({found, node, front.depth + 1});
            });
        }
    }

    std::vector<Value>& values() { return values_; }

  private:
    struct Cell {
        std::uint32_t x, y;
    };
    Cell cellOf(std::uint32_t node) const {
        const std::uint32_t block = blocks_.fine_blocks[node / (kSide * kSide)];
        return {block % blocks_.across * kSide + node % kSide,
                block / blocks_.across * kSide + node / kSide % kSide};
    }

    /// visit(node, unit vector that leads there) for the fine cells beside one.
    template <class Visit>
    void forEachSide(std::uint32_t node, Visit visit) const {
        const std::uint32_t x = node % kSide, y = node / kSide % kSide;
        const auto visitSide = [&](bool is_in_block, std::uint32_t next, int dx, int dy) {
            if (!is_in_block) next = besideBlock(node, dx, dy);
            if (next != gpu::NO_INDEX) visit(next, glm::vec2(dx, dy));
        };
        visitSide(x > 0, node - 1, -1, 0);
        visitSide(x + 1 < kSide, node + 1, 1, 0);
        visitSide(y > 0, node - kSide, 0, -1);
        visitSide(y + 1 < kSide, node + kSide, 0, 1);
    }

    std::uint32_t besideBlock(std::uint32_t node, int dx, int dy) const {
        const Cell cell = cellOf(node);
        // Cells before the first have huge numbers, and no node.
        return blocks_.fineNode(cell.x + static_cast<std::uint32_t>(dx),
                                cell.y + static_cast<std::uint32_t>(dy));
    }

    /// What is as near as it is was reached from what is nearer than both, and gains nothing from here.
    void spreadFromCell(std::uint32_t node) {
        const float reached = values_[node].distance;
        forEachSide(node, [&](std::uint32_t next, glm::vec2) {
            if (map_.cost[next] < kUnreachable && values_[next].distance > reached) solveCell(next);
        });
        const std::uint32_t i = node % kSide, j = node / kSide % kSide;
        if (i % (kSide - 1) != 0 && j % (kSide - 1) != 0) return;
        const Cell cell = cellOf(node);
        const std::uint32_t x = cell.x / kSide, y = cell.y / kSide;
        if (i == 0 && blocks_.isOpen(x - 1, y)) spreadInRoom(node, x - 1, y);
        if (i == kSide - 1 && blocks_.isOpen(x + 1, y)) spreadInRoom(node, x + 1, y);
        if (j == 0 && blocks_.isOpen(x, y - 1)) spreadInRoom(node, x, y - 1);
        if (j == kSide - 1 && blocks_.isOpen(x, y + 1)) spreadInRoom(node, x, y + 1);
    }

    void spreadFromCorner(std::uint32_t node) {
        const std::uint32_t crossing = blocks_.crossings[node - blocks_.fine_nodes];
        const std::uint32_t x = crossing % (blocks_.across + 1), y = crossing / (blocks_.across + 1);
        for (std::uint32_t dy = 0; dy < 2; ++dy)
            for (std::uint32_t dx = 0; dx < 2; ++dx)
                if (blocks_.isOpen(x - dx, y - dy)) spreadInRoom(node, x - dx, y - dy);
    }

    bool mayGo(std::uint32_t node, glm::vec2 direction) const {
        return map_.one_way.empty() || glm::dot(map_.one_way[node], direction) >= gpu::AGAINST_ONE_WAY;
    }

    bool isBetter(std::uint32_t node, float distance) const {
        return distance < values_[node].distance - kBetter;
    }

    void improve(std::uint32_t node, const Value& found) {
        if (!isBetter(node, found.distance)) return;
        values_[node] = found;
        fronts_.push({found.distance, node});
    }

    /// A fine cell from its better neighbours on the two axes.
    void solveCell(std::uint32_t node) {
        const Value* best[2] = {nullptr, nullptr};
        glm::vec2 towards[2];
        forEachSide(node, [&](std::uint32_t next, glm::vec2 direction) {
            const int axis = direction.x != 0.0f ? 0 : 1;
            const Value& value = values_[next];
            if (value.distance == kUnreachable || !mayGo(node, direction)) return;
            if (best[axis] && best[axis]->distance <= value.distance) return;
            best[axis] = &value;
            towards[axis] = direction;
        });
        if (!best[0] && !best[1]) return;
        const int first = !best[1] || (best[0] && best[0]->distance <= best[1]->distance) ? 0 : 1;
        const Value& near = *best[first];
        const Value* far = best[1 - first];
        const float step = map_.cost[node] * h_;
        // A cell is at least half of a diagonal further than the nearest beside it.
        constexpr float kLeastShare = 0.7f;  // of a step
        if (!isBetter(node, near.distance + kLeastShare * step)) return;
        if (!far || far->distance - near.distance >= step)
            return improve(node, {near.distance + step, near.length + h_, towards[first]});
        const float difference = far->distance - near.distance;
        const float distance =
            near.distance +
            0.5f * (difference + std::sqrt(std::max(0.0f, 2.0f * step * step - difference * difference)));
        if (!isBetter(node, distance)) return;
        const float fall = distance - near.distance, other_fall = std::max(distance - far->distance, 0.0f);
        const float slope = std::hypot(fall, other_fall);
        improve(node,
                {distance, (fall * near.length + other_fall * far->length + h_ * slope) / (fall + other_fall),
                 (fall * towards[first] + other_fall * towards[1 - first]) / slope});
    }

    Room roomOf(std::uint32_t x, std::uint32_t y) const {
        Room room;
        const float side = blocks_.side(), half = 0.5f * h_;
        const auto cells = [&](std::uint32_t first_x, std::uint32_t first_y, std::uint32_t dx,
                               std::uint32_t dy, glm::vec2 place) {
            const std::uint32_t first = blocks_.fineNode(first_x, first_y);
            if (first == gpu::NO_INDEX) return;
            // All in one block.
            for (std::uint32_t i = 0; i < kSide; ++i)
                room.add(first + i * (dx + dy * kSide),
                         place + glm::vec2(static_cast<int>(dx), static_cast<int>(dy)) *
                                     (h_ * static_cast<float>(i)));
        };
        const std::uint32_t left = x * kSide, right = left + kSide, low = y * kSide, high = low + kSide;
        const std::uint32_t back = ~0u;  // one less
        room.add(blocks_.cornerNode(x, y), {0.0f, 0.0f});
        cells(left, low - 1, 1, 0, {half, -half});
        room.add(blocks_.cornerNode(x + 1, y), {side, 0.0f});
        cells(right, low, 0, 1, {side + half, half});
        room.add(blocks_.cornerNode(x + 1, y + 1), {side, side});
        cells(right - 1, high, back, 0, {side - half, side + half});
        room.add(blocks_.cornerNode(x, y + 1), {0.0f, side});
        cells(left - 1, high - 1, 0, back, {-half, side - half});
        return room;
    }

    void spreadInRoom(std::uint32_t node, std::uint32_t x, std::uint32_t y) {
        const Room room = roomOf(x, y);
        std::size_t here = 0;
        while (here < room.count && room.nodes[here] != node)
            ++here;
        if (here == room.count) return;
        const float reached = values_[node].distance;
        for (const std::size_t beside : {(here + 1) % room.count, (here + room.count - 1) % room.count}) {
            const Edge edge = edgeOf(room, here, beside);
            for (std::size_t i = 0; i < room.count; ++i)
                if (i != here && i != beside && values_[room.nodes[i]].distance > reached)
                    crossRoom(room, i, edge);
        }
        // And along the edge.
        for (const std::size_t beside : {(here + 1) % room.count, (here + room.count - 1) % room.count})
            goStraight(room, beside, here, 0.0f, values_[node]);
    }

    /// Between two nodes beside each other, of which the first is reached.
    struct Edge {
        std::size_t a, b;
        Value first, second;
        glm::vec2 way;    // m, from the first to the second
        float per_metre;  // of the way
        float least;      // m, the lesser of the distances
    };

    Edge edgeOf(const Room& room, std::size_t a, std::size_t b) const {
        const Value &first = values_[room.nodes[a]], &second = values_[room.nodes[b]];
        const glm::vec2 way = room.at[b] - room.at[a];
        return {a, b, first, second, way, 1.0f / glm::length(way), std::min(first.distance, second.distance)};
    }

    /// From a node through such an edge.
    void crossRoom(const Room& room, std::size_t from, const Edge& edge) {
        const std::uint32_t node = room.nodes[from];
        const Value &first = edge.first, &second = edge.second;
        const float cost = map_.cost[node];
        if (cost == kUnreachable) return;
        if (second.distance == kUnreachable) return goStraight(room, from, edge.a, 0.0f, first);
        const glm::vec2 offset = room.at[from] - room.at[edge.a];
        const float away = std::abs(offset.x * edge.way.y - offset.y * edge.way.x) * edge.per_metre;
        if (!isBetter(node, edge.least + cost * away)) return;  // no way through there is shorter
        const float slope = (second.distance - first.distance) / cost * edge.per_metre;
        if (std::abs(slope) >= 1.0f) return goStraight(room, from, edge.a, 0.0f, first);
        const float along = glm::dot(offset, edge.way) * edge.per_metre;
        const float through = along - slope * away / std::sqrt(1.0f - slope * slope);
        const float share = std::clamp(through * edge.per_metre, 0.0f, 1.0f);
        const Value between{first.distance + share * (second.distance - first.distance),
                            first.length + share * (second.length - first.length),
                            {}};
        goStraight(room, from, edge.a, share, between, edge.b);
    }

    /// Straight to a point on the way from a to b, of which this is known.
    void goStraight(const Room& room, std::size_t from, std::size_t a, float share, const Value& there,
                    std::size_t b = 0) {
        const std::uint32_t node = room.nodes[from];
        if (map_.cost[node] == kUnreachable) return;
        const glm::vec2 target = share > 0.0f ? room.at[a] + share * (room.at[b] - room.at[a]) : room.at[a];
        const glm::vec2 way = target - room.at[from];
        const float metres = glm::length(way);
        const glm::vec2 direction = metres > 1.0e-6f ? way / metres : there.direction;
        if (!mayGo(node, direction)) return;
        improve(node, {there.distance + map_.cost[node] * metres, there.length + metres, direction});
    }

    const BlockMap& map_;
    const FieldBlocks& blocks_;
    float h_;  // m, a cell
    std::vector<Value> values_;
    FrontQueue fronts_;
};

/// A field's cells as the device reads them: see shaders/routes/route.glsl.
class Storer {
  public:
    Storer(const FieldBlocks& blocks, const std::vector<Value>& values) : blocks_(blocks), values_(values) {
        field_.cells.assign(blocks.cell_count, packFieldCell(kUnreachable, glm::vec2(0.0f), false));
        field_.is_reached.assign(blocks.cell_count, false);
    }

    Field run() {
        for (std::uint32_t crossing = 0; crossing < blocks_.corner_nodes.size(); ++crossing)
            if (const std::uint32_t node = blocks_.corner_nodes[crossing]; node != gpu::NO_INDEX)
                store(crossing, values_[node]);
        for (std::uint32_t y = 0; y < blocks_.up; ++y)
            for (std::uint32_t x = 0; x < blocks_.across; ++x)
                storeBlock(x, y);
        return std::move(field_);
    }

  private:
    void store(std::uint32_t cell, const Value& value) {
        field_.cells[cell] = packFieldCell(value.distance < kUnreachable ? value.length : kUnreachable,
                                           value.direction, value.straight);
        field_.is_reached[cell] = value.is_reached;
    }

    void storeBlock(std::uint32_t x, std::uint32_t y) {
        const std::size_t block = std::size_t{y} * blocks_.across + x;
        const std::uint32_t first = blocks_.first_cells[block];
        if (blocks_.kinds[block] != FieldBlocks::Kind::fine) return;
        for (std::uint32_t j = 0; j < gpu::FIELD_BLOCK_ROW; ++j)
            for (std::uint32_t i = 0; i < gpu::FIELD_BLOCK_ROW; ++i) {
                // Of the row just outside, the nearest of its own cells where there is nothing to know.
                const std::uint32_t inside_x = x * kSide + std::clamp(i, 1u, kSide) - 1;
                const std::uint32_t inside_y = y * kSide + std::clamp(j, 1u, kSide) - 1;
                const std::uint32_t node = blocks_.fineNode(inside_x, inside_y);
                Value value = values_[node];
                if (i == 0 || j == 0 || i > kSide || j > kSide)
                    value = outside(x * kSide + i - 1, y * kSide + j - 1, value);
                store(first + j * gpu::FIELD_BLOCK_ROW + i, value);
            }
    }

    /// What another block knows of a cell.
    Value outside(std::uint32_t x, std::uint32_t y, const Value& otherwise) const {
        if (const std::uint32_t node = blocks_.fineNode(x, y); node != gpu::NO_INDEX)
            return values_[node].distance < kUnreachable ? values_[node] : otherwise;
        const std::uint32_t block_x = x / kSide, block_y = y / kSide;
        if (x >= blocks_.cells.width || y >= blocks_.cells.height || !blocks_.isOpen(block_x, block_y))
            return otherwise;
        const glm::vec2 at = (glm::vec2(x % kSide, y % kSide) + 0.5f) / static_cast<float>(kSide);
        Value mixed{0.0f, 0.0f, {}, true};
        for (std::uint32_t corner = 0; corner < 4; ++corner) {
            const Value& value = values_[blocks_.cornerNode(block_x + corner % 2, block_y + corner / 2)];
            if (value.distance == kUnreachable) return otherwise;
            const float weight = (corner % 2 ? at.x : 1.0f - at.x) * (corner / 2 ? at.y : 1.0f - at.y);
            mixed.distance += weight * value.distance;
            mixed.length += weight * value.length;
            mixed.direction += weight * value.direction;
            mixed.straight = mixed.straight && value.straight;
        }
        return mixed;
    }

    const FieldBlocks& blocks_;
    const std::vector<Value>& values_;
    Field field_;
};

/// Within a target nothing is left to walk: there it points at its middle.
void startFrom(BlockMarcher& marcher, const FieldBlocks& blocks, std::span<const std::uint32_t> targets) {
    glm::vec2 middle(0.0f);
    for (const std::uint32_t node : targets)
        middle += blocks.positionOf(node) / static_cast<float>(targets.size());
    for (const std::uint32_t node : targets) {
        const glm::vec2 inward = middle - blocks.positionOf(node);
        const float size = glm::length(inward);
        marcher.start(node, 0.0f, size > 1.0e-4f ? inward / size : glm::vec2(0.0f));
    }
}

}  // namespace

Field solveField(const BlockMap& map, std::span<const std::uint32_t> targets, const StraightWays* straight) {
    BlockMarcher marcher(map);
    const FieldBlocks& blocks = *map.blocks;
    startFrom(marcher, blocks, targets);
    for (std::uint32_t node = 0; straight && straight->is_start && node < straight->from.size(); ++node) {
        if (!straight->from[node] || map.cost[node] != 1.0f) continue;
        const glm::vec2 way = straight->to - blocks.positionOf(node);
        const float metres = glm::length(way);
        marcher.start(node, metres, metres > 1.0e-4f ? way / metres : glm::vec2(0.0f));
    }
    marcher.march();
    for (std::uint32_t node = 0; node < map.cost.size(); ++node) {
        Value& value = marcher.values()[node];
        value.is_reached = value.distance < kUnreachable;
        value.straight = straight && straight->from[node] != 0;
    }
    marcher.fill();
    return Storer(blocks, marcher.values()).run();
}

}  // namespace throng::authoring
