// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "authoring/scene/fields.h"
#include "authoring/scene/sight.h"

namespace throng::authoring {

/// Large ground in blocks of 8 x 8 cells: fine where walls, kerbs or the edges of areas are near, and in one
/// piece where nothing is. Doors need fine cells, and most of a large site has no doors.
///
/// Distances are worked out at nodes: the middles of fine blocks' cells, and the corners of open blocks.
struct FieldBlocks {
    enum class Kind : std::uint8_t { open, fine, solid };

    FieldGrid cells;  ///< as if all blocks were fine
    std::uint32_t across = 0;
    std::uint32_t up = 0;
    std::vector<Kind> kinds;
    std::vector<std::uint32_t> order;        ///< of each fine block: how many are before it
    std::vector<std::uint32_t> fine_blocks;  ///< in their order
    std::vector<std::uint32_t>
        first_cells;  ///< where each fine block's cells begin in a field, after all crossings
    std::vector<std::uint32_t> corner_nodes;  ///< of each crossing of the blocks' edges, or gpu::NO_INDEX
    std::vector<std::uint32_t> crossings;     ///< of each corner node
    std::uint32_t fine_nodes = 0;             ///< come before the corners
    std::uint32_t cell_count = 0;             ///< of one field, as it is stored

    static constexpr std::uint32_t kSide = gpu::FIELD_BLOCK_CELLS_ACROSS;
    bool empty() const { return kinds.empty(); }
    float side() const { return static_cast<float>(kSide) * cells.cell_size; }
    std::uint32_t nodeCount() const { return fine_nodes + static_cast<std::uint32_t>(crossings.size()); }

    /// gpu::NO_INDEX for what is not in a fine block, or outside.
    std::uint32_t fineNode(std::uint32_t x, std::uint32_t y) const {
        if (x >= cells.width || y >= cells.height) return gpu::NO_INDEX;
        const std::size_t block = std::size_t{y / kSide} * across + x / kSide;
        if (kinds[block] != Kind::fine) return gpu::NO_INDEX;
        return order[block] * kSide * kSide + y % kSide * kSide + x % kSide;
    }
    std::uint32_t cornerNode(std::uint32_t x, std::uint32_t y) const {
        return corner_nodes[std::size_t{y} * (across + 1) + x];
    }
    glm::vec2 cornerAt(std::uint32_t x, std::uint32_t y) const {
        return cells.minimum + glm::vec2(x, y) * side();
    }
    bool isOpen(std::uint32_t x, std::uint32_t y) const {
        return x < across && y < up && kinds[std::size_t{y} * across + x] == Kind::open;
    }

    glm::vec2 positionOf(std::uint32_t node) const;
    /// The node that stands for a point; gpu::NO_INDEX within solids.
    std::uint32_t nodeAt(glm::vec2 point) const;
    /// Where a node's value is in a field.
    std::uint32_t cellOf(std::uint32_t node) const;

    /// Calls visit(node, position) for all nodes in a box.
    template <class Visit>
    void visitNodes(glm::vec2 lower, glm::vec2 upper, Visit visit) const;
};

/// @param most_cells of a field as stored: cells grow until there are no more than that
FieldBlocks makeFieldBlocks(const WalkGeometry& geometry, float cell_size, std::uint32_t most_cells);

/// How hard it is to walk, node by node.
struct BlockMap {
    const FieldBlocks* blocks = nullptr;
    std::vector<float> cost;         ///< as of WalkMap
    std::vector<glm::vec2> one_way;  ///< as of WalkMap
};
BlockMap makeBlockMap(const WalkGeometry& geometry, const FieldBlocks& blocks, bool keep_to_roads);

/// As for a WalkMap. @param targets nodes
Field solveField(const BlockMap& map, std::span<const std::uint32_t> targets,
                 const StraightWays* straight = nullptr);

template <class Visit>
void FieldBlocks::visitNodes(glm::vec2 lower, glm::vec2 upper, Visit visit) const {
    const auto blockAlong = [&](float at, float minimum, std::uint32_t count) {
        const float block = std::floor((at - minimum) / side());
        return static_cast<std::uint32_t>(std::min(std::max(block, 0.0f), static_cast<float>(count - 1)));
    };
    const std::uint32_t x0 = blockAlong(lower.x, cells.minimum.x, across),
                        x1 = blockAlong(upper.x, cells.minimum.x, across),
                        y0 = blockAlong(lower.y, cells.minimum.y, up),
                        y1 = blockAlong(upper.y, cells.minimum.y, up);
    for (std::uint32_t y = y0; y <= y1; ++y)
        for (std::uint32_t x = x0; x <= x1; ++x) {
            if (kinds[std::size_t{y} * across + x] != Kind::fine) continue;
            for (std::uint32_t j = y * kSide; j < (y + 1) * kSide; ++j)
                for (std::uint32_t i = x * kSide; i < (x + 1) * kSide; ++i)
                    visit(fineNode(i, j), cells.minimum + (glm::vec2(i, j) + 0.5f) * cells.cell_size);
        }
    for (std::uint32_t y = y0; y <= y1 + 1; ++y)
        for (std::uint32_t x = x0; x <= x1 + 1; ++x)
            if (cornerNode(x, y) != gpu::NO_INDEX) visit(cornerNode(x, y), cornerAt(x, y));
}

}  // namespace throng::authoring
