// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/seat_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "authoring/layout/row_floor.h"
#include "authoring/layout/seat_mouths.h"
#include "authoring/layout/seat_rows.h"
#include "authoring/terrain/face_grid.h"

namespace throng::authoring {
namespace {

constexpr double kSteepest = 0.8;  // rise over run, as of passages

/// Heights of the terrain in world coordinates, near some blocks.
class SeatGround {
  public:
    SeatGround(const TerrainMesh& mesh, glm::dvec2 origin, glm::dvec2 minimum, glm::dvec2 maximum,
               bool highest)
        : origin_(origin),
          faces_(mesh, origin, glm::vec2(minimum - origin), glm::vec2(maximum - origin),
                 FaceGrid::Keep::looking_up),
          highest_(highest) {}

    double at(glm::dvec2 place) const {
        double found = std::numeric_limits<double>::quiet_NaN();
        faces_.visitHits(glm::vec2(place - origin_), [&](const TerrainTriangle&, float height) {
            found = highest_ ? std::fmax(found, height) : std::fmin(found, height);
        });
        return found;
    }

  private:
    glm::dvec2 origin_;
    FaceGrid faces_;
    bool highest_;
};

void reachOver(const SeatBlock& block, glm::dvec2& minimum, glm::dvec2& maximum) {
    constexpr double kAround = 2.0;  // m: the feet of aisles
    for (const double back : {-0.5 * block.pitch, (static_cast<double>(block.rows) - 0.5) * block.pitch}) {
        const RowLine line(block, back);
        for (const double corner : line.corners()) {
            minimum = glm::min(minimum, line.at(corner) - kAround);
            maximum = glm::max(maximum, line.at(corner) + kAround);
        }
    }
}

/// One mistake of a block is enough to tell of it.
class GroundCheck {
  public:
    GroundCheck(const SeatBlock& block, Diagnostics& diagnostics)
        : block_(block), diagnostics_(diagnostics) {}

    void check() {
        if (block_.on_terrain) checkRows();
        for (std::size_t aisle = 0; fine_ && block_.isOpen() && aisle < countAisles(block_); ++aisle)
            checkAisle(aisle);
    }

  private:
    void checkRows() {
        for (const Seat& seat : seatsOf(block_))
            if (fine_ && std::isnan(block_.ground(seat.place)))
                tellOfHole(fmt::format("under row {}", seat.row + 1), seat.place);
        for (std::size_t row = 0; fine_ && row < block_.rows; ++row) {
            const RowLine line(block_, static_cast<double>(row) * block_.pitch);
            const RowFloor floor(block_, row);
            const std::vector<double> shares = sharesOnFloor(block_, line, 0.0, 1.0);
            for (const double share : shares)
                if (fine_ && std::isnan(floor.at(share)))
                    tellOfHole(fmt::format("under an end of row {}", row + 1), line.at(share));
            for (std::size_t i = 1; fine_ && i < shares.size(); ++i)
                checkClimb(fmt::format("row {}", row + 1), line.at(shares[i - 1]), line.at(shares[i]),
                           floor.at(shares[i - 1]), floor.at(shares[i]));
        }
    }

    void checkAisle(std::size_t aisle) {
        const std::vector<glm::dvec2> line = aisleLine(block_, aisle);
        if (std::isnan(block_.ground(line.front()))) {
            tellOfHole(fmt::format("where aisle {} ends", aisle + 1), line.front());
            return;
        }
        const std::vector<double> heights = aisleHeights(block_, aisle);
        for (std::size_t i = 0; i < line.size(); ++i)
            if (fine_ && std::isnan(heights[i]))
                tellOfHole(fmt::format("under aisle {}", aisle + 1), line[i]);
        for (std::size_t i = 1; fine_ && i < line.size(); ++i)
            if (i == 1 || block_.on_terrain)
                checkClimb(i == 1 ? fmt::format("aisle {}, from the ground to its first row,", aisle + 1)
                                  : fmt::format("aisle {}", aisle + 1),
                           line[i - 1], line[i], heights[i - 1], heights[i]);
    }

    void tellOfHole(const std::string& where, glm::dvec2 place) {
        fine_ = false;
        diagnostics_.error(
            block_.where,
            fmt::format("block `{}`: there is no ground of the terrain {}, at [{:.2f}, {:.2f}]", block_.id,
                        where, place.x, place.y),
            "move the block, or let the terrain reach further");
    }

    void checkClimb(const std::string& what, glm::dvec2 from, glm::dvec2 to, double low, double high) {
        const double climb = std::abs(high - low), length = glm::distance(from, to);
        if (climb <= kSteepest * length + 0.01) return;
        fine_ = false;
        diagnostics_.error(
            block_.where,
            fmt::format("block `{}`: {} climbs {:.2f} m over {:.2f} m at [{:.2f}, {:.2f}]: people climb at "
                        "most {:.0f} %",
                        block_.id, what, climb, length, to.x, to.y, 100.0 * kSteepest),
            block_.on_terrain
                ? "move it to where the terrain is less steep"
                : R"(set its `height` to that of the ground there, or write "on_terrain": true)");
    }

    const SeatBlock& block_;
    Diagnostics& diagnostics_;
    bool fine_ = true;
};

}  // namespace

void layOnTerrain(Layout& layout, const TerrainMesh& mesh, Diagnostics& diagnostics) {
    if (layout.seats.empty() || !layout.terrain) return;
    glm::dvec2 minimum = layout.seats.front().front.front(), maximum = minimum;
    for (const SeatBlock& block : layout.seats)
        reachOver(block, minimum, maximum);
    const auto ground = std::make_shared<const SeatGround>(mesh, layout.seats.front().front.front(), minimum,
                                                           maximum, layout.terrain->highest);
    for (SeatBlock& block : layout.seats) {
        block.ground = [ground](glm::dvec2 place) { return ground->at(place); };
        if (!hasPassages(block)) GroundCheck(block, diagnostics).check();
    }
}

bool haveGround(const Layout& layout, bool has_storeys, Diagnostics& diagnostics) {
    if (!layout.terrain) return true;
    for (const SeatBlock& block : layout.seats) {
        if (block.isOpen() && hasPassages(block)) {
            diagnostics.error(
                block.where,
                fmt::format(
                    "people walk to the seats of block `{}`, or leave them, by passages: these are for "
                    "flat ground and levels only",
                    block.id),
                "leave out its `mouths`, so that aisles go out before it, or the `terrain`");
            return false;
        }
        if (has_storeys && (block.isOpen() || block.on_terrain)) {
            diagnostics.error(
                block.where,
                fmt::format("block `{}` {} a terrain that has grounds above each other", block.id,
                            block.on_terrain ? "goes up and down with" : "has seats that people walk to, on"),
                R"(write "surface": "highest" or "lowest" in `terrain`, so that it has one storey)");
            return false;
        }
    }
    return true;
}

}  // namespace throng::authoring
