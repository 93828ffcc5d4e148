// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/fixed_squares.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace throng::sim {

FixedSquares::FixedSquares(std::uint32_t width, std::uint32_t height,
                           std::span<const gpu::DiagramSite> fixed_sites)
    : per_line(across(width)), places(std::size_t{per_line} * across(height)) {
    const glm::vec2 size(width, height);
    for (const gpu::DiagramSite& site : fixed_sites) {
        // A pixel more than the tile makes up for rounding. Clamped as floats: far away sites would overflow
        // the integers.
        const glm::uvec2 lower(glm::clamp(site.position - site.radius - 1.0f, glm::vec2(0.0f), size));
        const glm::uvec2 upper(
            glm::clamp(glm::ceil(site.position + site.radius + 1.0f), glm::vec2(0.0f), size));
        for (std::uint32_t y = lower.y / gpu::PAGE_SIDE; y < across(upper.y); ++y)
            for (std::uint32_t x = lower.x / gpu::PAGE_SIDE; x < across(upper.x); ++x)
                places[std::size_t{y} * per_line + x] = 1;
    }
    squares.assign(1, gpu::NO_INDEX);
    for (std::uint32_t square = 0; square < places.size(); ++square) {
        if (places[square] == 0) continue;
        places[square] = static_cast<std::uint32_t>(squares.size());
        squares.push_back(square);
    }
}

}  // namespace throng::sim
