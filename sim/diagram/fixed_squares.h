// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/diagram/page_size.h"

namespace throng::sim {

/// The squares of PAGE_SIDE px of a window that tiles of sites which never move reach, each with a place in a
/// store. Place 0 stands for all other squares: looking something up there never branches.
struct FixedSquares {
    /// @throws gl::GraphicsError where a window has more squares than a table of them on the device
    FixedSquares(std::uint32_t width, std::uint32_t height, std::span<const gpu::DiagramSite> fixed_sites);

    std::uint32_t per_line;              ///< squares in a line of the window
    std::vector<std::uint32_t> places;   ///< per square of the window, line by line
    std::vector<std::uint32_t> squares;  ///< per place, which square; place 0 has none
};

}  // namespace throng::sim
