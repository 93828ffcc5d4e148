// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/field_blocks.h"

#include "authoring/scene/raster.h"
#include "authoring/scene/slope_costs.h"

namespace throng::authoring {
namespace {

using Kind = FieldBlocks::Kind;

constexpr float kAround = 0.3f;  // m of fine cells beyond where walls make walking harder

/// Calls visit(a, b) for pieces of a segment no longer than `longest`: long slanted ones have vast bounds.
template <class Visit>
void forEachPiece(glm::vec2 a, glm::vec2 b, float longest, Visit visit) {
    const int count = std::max(1, static_cast<int>(std::ceil(glm::distance(a, b) / longest)));
    const auto at = [&](int i) { return a + (b - a) * (static_cast<float>(i) / static_cast<float>(count)); };
    for (int i = 0; i < count; ++i)
        visit(at(i), at(i + 1));
}

class BlockMaker {
  public:
    BlockMaker(const WalkGeometry& geometry, float cell_size) : geometry_(geometry) {
        const glm::vec2 extent = geometry.maximum - geometry.minimum;
        const float side = static_cast<float>(FieldBlocks::kSide) * cell_size;
        blocks_.across = std::max(1u, static_cast<std::uint32_t>(std::ceil(extent.x / side)));
        blocks_.up = std::max(1u, static_cast<std::uint32_t>(std::ceil(extent.y / side)));
        blocks_.cells = {geometry.minimum, cell_size, blocks_.across * FieldBlocks::kSide,
                         blocks_.up * FieldBlocks::kSide};
        raster_ = {geometry.minimum, side, blocks_.across, blocks_.up};
        blocks_.kinds.assign(cellCount(raster_), Kind::open);
    }

    FieldBlocks run() {
        markSolids();
        const float near_walls = geometry_.largest_radius + kWallComfort + kAround;
        for (const gpu::WallSegment& wall : geometry_.walls)
            markFine(wall.a, wall.b, near_walls + wall.half_thickness);
        for (const LocalRoad& road : geometry_.roads)
            markKerbs(road);
        for (const LocalPolygon& area : geometry_.areas)
            for (std::size_t i = 0; i < area.size(); ++i)
                markFine(area[i], area[(i + 1) % area.size()], kAround);
        for (const CostlyGround& ground : geometry_.costly)
            for (std::size_t i = 0; i < ground.outline.size(); ++i)
                markFine(ground.outline[i], ground.outline[(i + 1) % ground.outline.size()], kAround);
        if (geometry_.slopes) markSlopes(*geometry_.slopes);
        number();
        return std::move(blocks_);
    }

  private:
    void markFine(glm::vec2 a, glm::vec2 b, float reach) {
        const float half_diagonal = 0.7072f * raster_.cell_size;
        visitAlong(raster_, a, b, reach + half_diagonal, [&](std::uint32_t block, glm::vec2 middle) {
            if (segmentDistance(middle, a, b) <= reach + half_diagonal) blocks_.kinds[block] = Kind::fine;
        });
    }

    /// Stairs and banks that its corners would not show.
    void markSlopes(const SlopeCosts& slopes) {
        constexpr float kMuchMore = 1.5f;
        constexpr int kAcross = 8;
        for (std::uint32_t block = 0; block < blocks_.kinds.size(); ++block) {
            if (blocks_.kinds[block] != Kind::open) continue;
            const glm::vec2 corner =
                raster_.minimum + glm::vec2(block % raster_.width, block / raster_.width) * raster_.cell_size;
            float least = kUnreachable, most = 0.0f;
            for (int y = 0; y <= kAcross; ++y)
                for (int x = 0; x <= kAcross; ++x) {
                    const glm::vec2 at = corner + glm::vec2(x, y) * (raster_.cell_size / float{kAcross});
                    least = std::min(least, slopes.at(at));
                    most = std::max(most, slopes.at(at));
                }
            if (most > kMuchMore * least) blocks_.kinds[block] = Kind::fine;
        }
    }

    void markKerbs(const LocalRoad& road) {
        const float half = 0.5f * road.width;
        for (std::size_t i = 0; i + 1 < road.centreline.size(); ++i) {
            const glm::vec2 a = road.centreline[i], b = road.centreline[i + 1];
            const glm::vec2 along = (b - a) / std::max(glm::distance(a, b), 1.0e-6f);
            const glm::vec2 aside = glm::vec2(-along.y, along.x) * half;
            markFine(a + aside, b + aside, kAround);
            markFine(a - aside, b - aside, kAround);
        }
        for (const glm::vec2 joint : road.centreline)
            markFine(joint, joint, half + kAround);
    }

    void markSolids() {
        for (const LocalPolygon& solid : geometry_.solids)
            visitInside(raster_, solid,
                        [&](std::uint32_t block, glm::vec2) { blocks_.kinds[block] = Kind::solid; });
    }

    /// First the crossings, then the fine blocks' cells.
    void number() {
        const std::size_t count = blocks_.kinds.size();
        blocks_.order.assign(count, gpu::NO_INDEX);
        blocks_.first_cells.assign(count, 0);
        blocks_.corner_nodes.assign(std::size_t{blocks_.across + 1} * (blocks_.up + 1), gpu::NO_INDEX);
        blocks_.cell_count = static_cast<std::uint32_t>(blocks_.corner_nodes.size());
        std::uint32_t fine = 0;
        for (std::size_t block = 0; block < count; ++block) {
            if (blocks_.kinds[block] != Kind::fine) continue;
            blocks_.first_cells[block] = blocks_.cell_count;
            blocks_.cell_count += gpu::FIELD_BLOCK_ROW * gpu::FIELD_BLOCK_ROW;
            blocks_.order[block] = fine++;
            blocks_.fine_blocks.push_back(static_cast<std::uint32_t>(block));
        }
        blocks_.fine_nodes = fine * FieldBlocks::kSide * FieldBlocks::kSide;
        for (std::uint32_t y = 0; y <= blocks_.up; ++y)
            for (std::uint32_t x = 0; x <= blocks_.across; ++x) {
                // Blocks before the first one have huge numbers and are not open.
                if (!blocks_.isOpen(x, y) && !blocks_.isOpen(x - 1, y) && !blocks_.isOpen(x, y - 1) &&
                    !blocks_.isOpen(x - 1, y - 1))
                    continue;
                const std::uint32_t crossing = y * (blocks_.across + 1) + x;
                blocks_.corner_nodes[crossing] = blocks_.nodeCount();
                blocks_.crossings.push_back(crossing);
            }
    }

    const WalkGeometry& geometry_;
    FieldGrid raster_;  // of blocks
    FieldBlocks blocks_;
};

void addWallCosts(const WalkGeometry& geometry, const FieldBlocks& blocks, std::vector<float>& cost) {
    const WallCost wall_cost(geometry, blocks.cells.cell_size);
    std::vector<float> distance(cost.size(), kUnreachable);
    for (const gpu::WallSegment& wall : geometry.walls) {
        const float reach = wall_cost.reach() + wall.half_thickness;
        forEachPiece(wall.a, wall.b, 2.0f * blocks.side(), [&](glm::vec2 from, glm::vec2 to) {
            const glm::vec2 ends[] = {from, to};
            const Box box = boundsOf(ends, reach);
            blocks.visitNodes(box.lower, box.upper, [&](std::uint32_t node, glm::vec2 at) {
                distance[node] =
                    std::min(distance[node], segmentDistance(at, from, to) - wall.half_thickness);
            });
        });
    }
    for (std::size_t node = 0; node < cost.size(); ++node)
        cost[node] += wall_cost(distance[node]);
    for (const LocalPolygon& solid : geometry.solids) {
        const Box box = boundsOf(solid, 0.0f);
        blocks.visitNodes(box.lower, box.upper, [&](std::uint32_t node, glm::vec2 at) {
            if (insidePolygon(solid, at)) cost[node] = kUnreachable;
        });
    }
}

template <class Visit>
void visitRoad(const FieldBlocks& blocks, const LocalRoad& road, Visit visit) {
    for (std::size_t i = 0; i + 1 < road.centreline.size(); ++i) {
        const RoadPiece piece(road, i, 0.0f);
        const glm::vec2 ends[] = {road.centreline[i], road.centreline[i + 1]};
        const glm::vec2 along = glm::normalize(ends[1] - ends[0]);
        const Box box = boundsOf(ends, 0.5f * road.width);
        blocks.visitNodes(box.lower, box.upper, [&](std::uint32_t node, glm::vec2 at) {
            if (piece.holds(at)) visit(node, along);
        });
    }
}

template <class Visit>
void visitAreas(const WalkGeometry& geometry, const FieldBlocks& blocks, Visit visit) {
    for (const LocalPolygon& area : geometry.areas) {
        const Box box = boundsOf(area, 0.0f);
        blocks.visitNodes(box.lower, box.upper, [&](std::uint32_t node, glm::vec2 at) {
            if (insidePolygon(area, at)) visit(node);
        });
    }
}

void chargePatches(const WalkGeometry& geometry, const FieldBlocks& blocks, std::vector<float>& cost) {
    for (const CostlyGround& ground : geometry.costly) {
        if (ground.is_for_a_time) continue;
        const Box box = boundsOf(ground.outline, 0.0f);
        blocks.visitNodes(box.lower, box.upper, [&](std::uint32_t node, glm::vec2 at) {
            if (insidePolygon(ground.outline, at)) cost[node] = charged(cost[node], ground.cost);
        });
    }
}

void keepToRoads(const WalkGeometry& geometry, const FieldBlocks& blocks, BlockMap& map) {
    map.cost.assign(blocks.nodeCount(), kOffRoadCost);
    bool one_way = false;
    for (const LocalRoad& road : geometry.roads) {
        visitRoad(blocks, road, [&](std::uint32_t node, glm::vec2) { map.cost[node] = 1.0f; });
        one_way = one_way || road.one_way;
    }
    visitAreas(geometry, blocks, [&](std::uint32_t node) { map.cost[node] = 1.0f; });
    if (!one_way) return;
    // Where another road or an area lies over it, one may also walk that road's way.
    map.one_way.assign(blocks.nodeCount(), glm::vec2(0.0f));
    for (const bool first : {true, false})
        for (const LocalRoad& road : geometry.roads)
            if (road.one_way == first)
                visitRoad(blocks, road, [&](std::uint32_t node, glm::vec2 along) {
                    map.one_way[node] = first ? along : glm::vec2(0.0f);
                });
    visitAreas(geometry, blocks, [&](std::uint32_t node) { map.one_way[node] = glm::vec2(0.0f); });
}

}  // namespace

glm::vec2 FieldBlocks::positionOf(std::uint32_t node) const {
    if (node >= fine_nodes) {
        const std::uint32_t crossing = crossings[node - fine_nodes];
        return cornerAt(crossing % (across + 1), crossing / (across + 1));
    }
    const std::uint32_t block = fine_blocks[node / (kSide * kSide)];
    return cells.minimum +
           (glm::vec2(block % across * kSide + node % kSide, block / across * kSide + node / kSide % kSide) +
            0.5f) *
               cells.cell_size;
}

std::uint32_t FieldBlocks::nodeAt(glm::vec2 point) const {
    const std::uint32_t x = column(cells, point.x), y = row(cells, point.y);
    const Kind kind = kinds[std::size_t{y / kSide} * across + x / kSide];
    if (kind == Kind::fine) return fineNode(x, y);
    if (kind == Kind::solid) return gpu::NO_INDEX;
    return cornerNode((x + kSide / 2) / kSide, (y + kSide / 2) / kSide);
}

std::uint32_t FieldBlocks::cellOf(std::uint32_t node) const {
    if (node >= fine_nodes) return crossings[node - fine_nodes];
    const std::uint32_t block = fine_blocks[node / (kSide * kSide)], local = node % (kSide * kSide);
    return first_cells[block] + (local / kSide + 1) * gpu::FIELD_BLOCK_ROW + local % kSide + 1;
}

FieldBlocks makeFieldBlocks(const WalkGeometry& geometry, float cell_size, std::uint32_t most_cells) {
    for (;; cell_size *= 1.2f) {
        FieldBlocks blocks = BlockMaker(geometry, cell_size).run();
        if (blocks.cell_count <= most_cells) return blocks;
    }
}

BlockMap makeBlockMap(const WalkGeometry& geometry, const FieldBlocks& blocks, bool keep_to_roads) {
    BlockMap map;
    map.blocks = &blocks;
    if (keep_to_roads && geometry.hasKerbs())
        keepToRoads(geometry, blocks, map);
    else
        map.cost.assign(blocks.nodeCount(), 1.0f);
    addWallCosts(geometry, blocks, map.cost);
    chargePatches(geometry, blocks, map.cost);
    if (geometry.slopes)
        blocks.visitNodes(geometry.minimum, geometry.maximum, [&](std::uint32_t node, glm::vec2 at) {
            map.cost[node] *= geometry.slopes->at(at);
        });
    return map;
}

}  // namespace throng::authoring
