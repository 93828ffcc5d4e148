// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/fixed_squares.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "sim/gl/context.h"

namespace throng::sim {

namespace {

/// A table of them has to fit a storage block.
std::size_t checkedSquares(std::uint32_t width, std::uint32_t height) {
    constexpr std::size_t kMostSquares = std::size_t{1} << 25;
    const std::size_t squares = std::size_t{pagesAcross(width)} * pagesAcross(height);
    if (squares > kMostSquares)
        throw gl::GraphicsError(fmt::format(
            "the diagram of {} x {} pixels is too large even in pages. Set "
            "simulation.pixels_per_metre to at most {:.2g} times what it is, or split the layout.",
            width, height, std::sqrt(static_cast<double>(kMostSquares) / static_cast<double>(squares))));
    return squares;
}

}  // namespace

FixedSquares::FixedSquares(std::uint32_t width, std::uint32_t height,
                           std::span<const gpu::DiagramSite> fixed_sites)
    : per_line(pagesAcross(width)), places(checkedSquares(width, height)) {
    const glm::vec2 size(width, height);
    for (const gpu::DiagramSite& site : fixed_sites) {
        // A pixel more than the tile makes up for rounding. Clamped as floats: far away sites would overflow
        // the integers.
        const glm::uvec2 lower(glm::clamp(site.position - site.radius - 1.0f, glm::vec2(0.0f), size));
        const glm::uvec2 upper(
            glm::clamp(glm::ceil(site.position + site.radius + 1.0f), glm::vec2(0.0f), size));
        for (std::uint32_t y = lower.y / gpu::PAGE_SIDE; y < pagesAcross(upper.y); ++y)
            for (std::uint32_t x = lower.x / gpu::PAGE_SIDE; x < pagesAcross(upper.x); ++x)
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
