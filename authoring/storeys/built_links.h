// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "authoring/storeys/charts.h"

/// Links and lifts that are built onto a terrain. They become a part of its mesh, so that all that finds
/// ground, edges and ways on a mesh finds them, too; where they go through a floor of the mesh, it is open.
namespace throng::authoring {

/// m: parapets before the ends of links are opened that are not further away.
inline constexpr double kThrough = 0.35;

struct BuiltLink {
    Chart chart;                    ///< of a flight, a landing, or a cabin at one of its stops
    std::vector<Railing> railings;  ///< along its sides
};

/// Where something of the terrain is in the way that is as high as a wall.
struct WallInTheWay {
    std::size_t link = 0;  ///< index into the layout's
    glm::dvec3 at{0.0};
};

struct BuiltLinks {
    std::vector<BuiltLink> parts;
    TerrainMesh seen;  ///< the terrain with its openings, and links
    TerrainMesh
        walked;  ///< the same as people get on: railings stand upright, and low under links is no ground
    std::vector<WallInTheWay> walls;
};

/// @param layout whose links know how high their ends are, and whose landings have heights
BuiltLinks buildLinks(const TerrainMesh& terrain, const Layout& layout);

/// m, of the walls that railings are.
double railingHeight(const Chart& chart);

}  // namespace throng::authoring
