// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "sim/diagram/diagram.h"
#include "sim/diagram/site_bins.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// What the program that gathers diagrams (shaders/diagram/binned.comp) leaves behind.
enum class Gathering {
    whole,        ///< owners, everywhere
    near_people,  ///< owners in the listed pages of a whole picture
    pages,        ///< owners in a store of pages
    layers,       ///< owners and distances in a store of pages
};

/// @param fixed_layers whether the diagram of sites that never move is laid under it
gl::ComputeProgram gatherProgram(const gl::ShaderLibrary& library, const DiagramOptions& options,
                                 Gathering gathering, bool fixed_layers);

/// Bins that start where they say, whatever the strip (shaders/cells/cell_starts.glsl).
gl::Buffer noStrips(const BinGrid& grid);

std::uint64_t blocksAcross(std::uint32_t pixels, std::uint32_t block);
std::uint32_t blocksPerPage(const GatherShape& shape);

/// Pages of a store that one binding of a storage block can show, and one dispatch can work on.
std::uint32_t pagesPerRange(const GatherShape& shape, std::size_t bytes_of_page);

}  // namespace throng::sim
