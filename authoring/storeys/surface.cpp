// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/surface.h"

#include "authoring/storeys/chart_raster.h"

namespace throng::authoring {

std::uint32_t Surface::spotAt(glm::ivec2 cell) const {
    const glm::ivec2 at = cell - first;
    if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) return kNoSpot;
    return spots[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size.x) +
                 static_cast<std::size_t>(at.x)];
}

bool Surface::contains(glm::dvec2 home) const {
    return spotAt(chartCellOf(home)) != kNoSpot;
}

double Surface::heightAt(glm::dvec2 home) const {
    const glm::ivec2 cell = chartCellOf(home);
    for (int reach = 0; reach <= 2; ++reach)
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx)
                if (const std::uint32_t spot = spotAt(cell + glm::ivec2(dx, dy)); spot != kNoSpot)
                    return double{ground->spots()[spot].height};
    return 0.0;
}

bool areJoined(const Surface& a, glm::dvec2 in_a, const Surface& b, glm::dvec2 in_b) {
    const glm::ivec2 from = chartCellOf(in_a), to = chartCellOf(in_b);
    const std::uint32_t spot = a.spotAt(from);
    if (spot == kNoSpot) return false;
    for (std::size_t side = 0; side < kSides.size(); ++side)
        if (from + kSides[side] == to) {
            const std::uint32_t next = a.ground->spots()[spot].next[side];
            return next != kNoSpot && b.spotAt(to) == next;
        }
    return false;
}

}  // namespace throng::authoring
