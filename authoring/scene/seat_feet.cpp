// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/seat_feet.h"

#include <fmt/format.h>

#include <algorithm>

#include "authoring/layout/seat_mouths.h"
#include "authoring/layout/seat_rows.h"
#include "base/polygon.h"

namespace throng::authoring {
namespace {

constexpr double kBody = 0.25;  // m

bool isInWall(const Wall& wall, glm::dvec2 place) {
    if (wall.closed) return distanceToPolygon(wall.points, place) < kBody;
    return distanceToPieces(wall.points, wall.points.size() - 1, place) < kBody + 0.5 * wall.thickness;
}

class FeetCheck {
  public:
    FeetCheck(const Layout& layout, Diagnostics& diagnostics) : layout_(layout), diagnostics_(diagnostics) {}

    bool check(const SeatBlock& block, std::size_t aisle) const {
        const glm::dvec2 foot =
            hasPassages(block) ? passageFoot(block, aisle) : aisleLine(block, aisle).front();
        if (!layout_.levels.empty() && !isOnFloor(block, aisle, foot)) return false;
        const auto wall = std::ranges::find_if(layout_.walls, [&](const Wall& each) {
            return each.level == block.mouths.level && isInWall(each, foot);
        });
        if (wall == layout_.walls.end()) return true;
        diagnostics_.error(block.mouths.where,
                           fmt::format("aisle {} of block `{}` ends in wall `{}`, at [{:.2f}, {:.2f}]",
                                       aisle + 1, block.id, wall->id, foot.x, foot.y),
                           hasPassages(block)
                               ? "make its `passage` longer or shorter, or let it end on another `level`"
                               : "move the wall, or the block");
        return false;
    }

  private:
    bool isOnFloor(const SeatBlock& block, std::size_t aisle, glm::dvec2 foot) const {
        const Level& level = layout_.levels[block.mouths.level];
        if (level.floor.empty() || isWithin(level.floor, foot)) return true;
        diagnostics_.error(
            block.mouths.where,
            fmt::format("aisle {} of block `{}` ends at [{:.2f}, {:.2f}], beside the floor of level `{}`",
                        aisle + 1, block.id, foot.x, foot.y, level.id),
            hasPassages(block) ? "make its `passage` longer or shorter, or let it end on another `level`"
                               : "let it end on another `level`");
        return false;
    }

    const Layout& layout_;
    Diagnostics& diagnostics_;
};

}  // namespace

bool areFeetOnGround(const Layout& layout, Diagnostics& diagnostics) {
    const FeetCheck feet(layout, diagnostics);
    bool all = true;
    for (const SeatBlock& block : layout.seats) {
        const bool is_told = block.mouths.where.line > 0 || !layout.levels.empty();
        if (!block.isOpen() || !is_told) continue;
        // One is enough to tell of a block.
        bool good = true;
        for (std::size_t aisle = 0; good && aisle < countAisles(block); ++aisle)
            good = feet.check(block, aisle);
        all = all && good;
    }
    return all;
}

}  // namespace throng::authoring
