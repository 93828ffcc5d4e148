// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "shaders/shared/simulation_types.h"

namespace throng::sim {

/// Pixels of a page, a square of PAGE_SIDE px.
inline constexpr std::size_t kPagePixels = std::size_t{gpu::PAGE_SIDE} * gpu::PAGE_SIDE;

/// Pages that so many pixels in a line reach into.
constexpr std::uint32_t pagesAcross(std::uint32_t pixels) {
    return (pixels + gpu::PAGE_SIDE - 1) / gpu::PAGE_SIDE;
}

}  // namespace throng::sim
