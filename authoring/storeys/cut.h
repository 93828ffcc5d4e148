// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "authoring/storeys/surface.h"

namespace throng::authoring {

/// Which spots belong together: from each one gets to all others of its piece.
struct Pieces {
    std::vector<std::uint32_t> piece_of;  ///< by spot
    std::vector<std::size_t> spots;       ///< by piece: how many
};
Pieces piecesOf(const Walkable& ground);

/// Whether there is any place where some of the pieces lie above each other, or above themselves.
bool lieAboveEachOther(const Walkable& ground, const Pieces& pieces, const std::vector<bool>& used);

/// The surface of some spots, at most one in a cell.
Surface surfaceOf(const std::shared_ptr<const Walkable>& ground, const std::vector<std::uint32_t>& spots);

/// Parts of these pieces with one height at a place, as large as can be. As water rises, each part grows from
/// the lowest place that is left: so what is below comes first, and a part ends before it would come to lie
/// above itself.
/// @param taken by spot: those that are no part of it; empty: none
/// @param margin m: how far before
std::vector<Surface> cutIntoSurfaces(const std::shared_ptr<const Walkable>& ground, const Pieces& pieces,
                                     const std::vector<bool>& used, double margin,
                                     const std::vector<bool>& taken = {});

}  // namespace throng::authoring
