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

/// Parts of these pieces with one height at a place, as large as can be. As water rises, each part grows from
/// the lowest place that is left: so what is below comes first, and a part ends before it would come to lie
/// above itself.
/// @param margin m: how far before
std::vector<Surface> cutIntoSurfaces(const std::shared_ptr<const Walkable>& ground, const Pieces& pieces,
                                     const std::vector<bool>& used, double margin);

}  // namespace throng::authoring
