// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/cut.h"

#include <algorithm>
#include <functional>
#include <glm/common.hpp>
#include <limits>
#include <numbers>
#include <queue>

#include "authoring/storeys/chart_raster.h"

namespace throng::authoring {
namespace {

using Spots = std::vector<std::uint32_t>;

/// All that can be reached from a spot without leaving those for which `may` holds.
template <class May>
Spots reachedFrom(const Walkable& ground, std::uint32_t from, May may, std::vector<bool>& seen) {
    Spots reached = {from};
    seen[from] = true;
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (const std::uint32_t next : ground.spots()[reached[i]].next)
            if (next != kNoSpot && !seen[next] && may(next)) {
                seen[next] = true;
                reached.push_back(next);
            }
    return reached;
}

/// A part that grows, and which spot it has in each cell.
class Part {
  public:
    explicit Part(const Walkable& ground)
        : ground_(ground),
          holders_(static_cast<std::size_t>(ground.size().x) * static_cast<std::size_t>(ground.size().y),
                   kNoSpot) {}

    /// The spot that has the cell of another one.
    std::uint32_t holderAt(std::uint32_t spot) const { return holders_[cellOf(spot)]; }
    bool has(std::uint32_t spot) const { return holderAt(spot) == spot; }
    void take(std::uint32_t spot) {
        holders_[cellOf(spot)] = spot;
        spots_.push_back(spot);
    }
    void leave(const std::vector<bool>& left) {
        std::erase_if(spots_, [&](std::uint32_t spot) {
            if (left[spot]) holders_[cellOf(spot)] = kNoSpot;
            return bool{left[spot]};
        });
    }
    void clear() {
        for (const std::uint32_t spot : spots_)
            holders_[cellOf(spot)] = kNoSpot;
        spots_.clear();
    }
    const Spots& spots() const { return spots_; }

  private:
    std::size_t cellOf(std::uint32_t spot) const {
        const glm::ivec2 at = ground_.spots()[spot].cell - ground_.first();
        return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(ground_.size().x) +
               static_cast<std::size_t>(at.x);
    }
    const Walkable& ground_;
    Spots holders_, spots_;
};

/// The lowest first, and of several as high the first.
struct IsHigher {
    const Walkable* ground;
    bool operator()(std::uint32_t a, std::uint32_t b) const {
        const float height_a = ground->spots()[a].height, height_b = ground->spots()[b].height;
        return height_a != height_b ? height_a > height_b : a > b;
    }
};

/// @returns where it would have come to lie over itself
Spots grow(const Walkable& ground, const Spots& among, const std::vector<bool>& is_left, Part& part) {
    const IsHigher is_higher{&ground};
    Spots over;
    std::priority_queue<std::uint32_t, Spots, IsHigher> shore(is_higher);
    shore.push(*std::max_element(among.begin(), among.end(), is_higher));
    while (!shore.empty()) {
        const std::uint32_t spot = shore.top();
        shore.pop();
        if (part.has(spot)) continue;
        if (part.holderAt(spot) != kNoSpot) {
            over.push_back(spot);
            continue;
        }
        part.take(spot);
        for (const std::uint32_t next : ground.spots()[spot].next)
            if (next != kNoSpot && is_left[next]) shore.push(next);
    }
    return over;
}

/// What of a part is nearer than a margin, on foot, to where it would lie over itself: beyond its seam,
/// people on it look into the next part, and so none of its own ground may be there.
/// @returns by spot, whether it is too near
std::vector<bool> nearTo(const Walkable& ground, const Spots& over, const Part& part, double margin) {
    using Reached = std::pair<double, std::uint32_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> reached;
    std::vector<double> away(ground.spots().size(), std::numeric_limits<double>::infinity());
    std::vector<bool> near(ground.spots().size(), false);
    const auto reach = [&](std::uint32_t spot, double distance) {
        if (spot == kNoSpot || distance > margin || distance >= away[spot]) return;
        away[spot] = distance;
        reached.push({distance, spot});
    };
    for (const std::uint32_t spot : over)
        reach(spot, 0.0);
    while (!reached.empty()) {
        const auto [distance, spot] = reached.top();
        reached.pop();
        if (distance > away[spot]) continue;
        near[spot] = part.has(spot);
        for (std::size_t side = 0; side < kSides.size(); ++side) {
            const std::uint32_t next = ground.spots()[spot].next[side];
            if (next == kNoSpot || !part.has(next)) continue;
            reach(next, distance + kChartCell);
            const std::uint32_t aside = ground.spots()[next].next[(side + 1) % kSides.size()];
            if (aside != kNoSpot && part.has(aside))
                reach(aside, distance + kChartCell * std::numbers::sqrt2);
        }
    }
    return near;
}

/// Draws back from where a part would lie over itself; not as far where not much would be left of it.
void drawBack(const Walkable& ground, const Spots& over, double margin, Part& part) {
    constexpr double kLeast = 0.25;  // of it
    while (!over.empty() && margin > kChartCell) {
        const std::vector<bool> near = nearTo(ground, over, part, margin);
        const auto kept = std::count_if(part.spots().begin(), part.spots().end(),
                                        [&](std::uint32_t spot) { return !near[spot]; });
        if (static_cast<double>(kept) >= kLeast * static_cast<double>(part.spots().size()))
            return part.leave(near);
        margin *= 0.5;
    }
}

}  // namespace

Surface surfaceOf(const std::shared_ptr<const Walkable>& ground, const Spots& spots) {
    Surface surface;
    surface.ground = ground;
    glm::ivec2 lower = ground->spots()[spots.front()].cell, upper = lower;
    for (const std::uint32_t spot : spots) {
        lower = glm::min(lower, ground->spots()[spot].cell);
        upper = glm::max(upper, ground->spots()[spot].cell);
    }
    surface.first = lower;
    surface.size = upper + 1 - lower;
    surface.spots.assign(static_cast<std::size_t>(surface.size.x) * static_cast<std::size_t>(surface.size.y),
                         kNoSpot);
    for (const std::uint32_t spot : spots) {
        const glm::ivec2 at = ground->spots()[spot].cell - lower;
        surface.spots[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(surface.size.x) +
                      static_cast<std::size_t>(at.x)] = spot;
    }
    return surface;
}

Pieces piecesOf(const Walkable& ground) {
    Pieces pieces;
    pieces.piece_of.assign(ground.spots().size(), 0);
    std::vector<bool> seen(ground.spots().size(), false);
    for (std::uint32_t spot = 0; spot < ground.spots().size(); ++spot) {
        if (seen[spot]) continue;
        const Spots reached = reachedFrom(
            ground, spot, [](std::uint32_t) { return true; }, seen);
        for (const std::uint32_t each : reached)
            pieces.piece_of[each] = static_cast<std::uint32_t>(pieces.spots.size());
        pieces.spots.push_back(reached.size());
    }
    return pieces;
}

bool lieAboveEachOther(const Walkable& ground, const Pieces& pieces, const std::vector<bool>& used) {
    glm::ivec2 last(-1);
    bool has_one = false;
    for (std::uint32_t spot = 0; spot < ground.spots().size(); ++spot) {
        if (!used[pieces.piece_of[spot]]) continue;
        const glm::ivec2 cell = ground.spots()[spot].cell;
        if (has_one && cell == last) return true;
        last = cell;
        has_one = true;
    }
    return false;
}

std::vector<Surface> cutIntoSurfaces(const std::shared_ptr<const Walkable>& ground, const Pieces& pieces,
                                     const std::vector<bool>& used, double margin,
                                     const std::vector<bool>& taken) {
    std::vector<bool> is_left(ground->spots().size(), false);
    for (std::uint32_t spot = 0; spot < is_left.size(); ++spot)
        is_left[spot] = used[pieces.piece_of[spot]] && (taken.empty() || !taken[spot]);
    std::vector<Surface> surfaces;
    Part part(*ground);
    for (;;) {
        // What hangs together of what is left, the largest first.
        std::vector<Spots> rests;
        std::vector<bool> seen(is_left.size(), false);
        for (std::uint32_t spot = 0; spot < is_left.size(); ++spot)
            if (is_left[spot] && !seen[spot])
                rests.push_back(reachedFrom(
                    *ground, spot, [&](std::uint32_t next) { return bool{is_left[next]}; }, seen));
        if (rests.empty()) return surfaces;
        std::stable_sort(rests.begin(), rests.end(),
                         [](const Spots& a, const Spots& b) { return a.size() > b.size(); });
        for (const Spots& rest : rests) {
            part.clear();
            drawBack(*ground, grow(*ground, rest, is_left, part), margin, part);
            for (const std::uint32_t spot : part.spots())
                is_left[spot] = false;
            surfaces.push_back(surfaceOf(ground, part.spots()));
        }
    }
}

}  // namespace throng::authoring
