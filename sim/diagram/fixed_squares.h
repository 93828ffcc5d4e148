// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shaders/shared/simulation_types.h"

namespace throng::sim {

/// The squares of PAGE_SIDE px of a window that tiles of sites which never move reach, each with a place in a
/// store. Place 0 stands for all other squares: looking something up there never branches.
struct FixedSquares {
    FixedSquares(std::uint32_t width, std::uint32_t height, std::span<const gpu::DiagramSite> fixed_sites);

    std::uint32_t per_line;              ///< squares in a line of the window
    std::vector<std::uint32_t> places;   ///< per square of the window, line by line
    std::vector<std::uint32_t> squares;  ///< per place, which square; place 0 has none

    /// Squares that so many pixels reach into.
    static std::uint32_t across(std::uint32_t pixels) {
        return (pixels + gpu::PAGE_SIDE - 1) / gpu::PAGE_SIDE;
    }
    static constexpr std::size_t kPixels = std::size_t{gpu::PAGE_SIDE} * gpu::PAGE_SIDE;  ///< of a square
};

}  // namespace throng::sim
