// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/storeys/chart.h"
#include "authoring/storeys/chart_raster.h"
#include "authoring/terrain/terrain_mesh.h"

// People above people, in a simulation that is flat
//
// Everything that people sense with - the diagram, the cells, the distance fields - lies in a plane, and
// there is one person at most in a place. So the ground is cut into *charts* of which each has one height at
// a place, floors and links, and these are laid out side by side in the plane, each moved by its *shift* as a
// whole.
//
// Where two charts meet there is a *seam*. Beyond it, each has a margin as wide as people sense, in which it
// shows the other's ground: the walls that stand there are copied into it, its cells of the distance fields
// are those of the other chart, and everybody who is that near to the seam on the other side is present in
// it, too, as an *image*. Images are sensed, felt in contact and counted like anybody else; nobody asks what
// they want, and they move as the person does whose image they are. Who has walked over a seam is moved by
// the difference of the two shifts before people look round the next time, and notices nothing of it.
//
// The plane is nobody's business but the simulation's: layouts, recordings and reports are in home
// coordinates, in which floors lie above each other.
namespace throng::authoring {

/// The railing of a floor or link, or the piece of one.
struct Railing {
    std::vector<glm::dvec2> points;  ///< home, the middle of the railing
    double low = 0.0, high = 0.0;    ///< m, of the ground along it
};

/// What was found on a terrain that is cut.
struct TerrainFindings {
    struct Piece {
        double area = 0.0;  ///< m^2
        glm::dvec3 at{0.0};
    };
    std::size_t unreached_count = 0;
    std::vector<Piece> unreached;  ///< grounds that nobody of the layout gets to, the largest of them first
};

/// What of a layout that is cut from a terrain is not in the plane.
struct TerrainGrounds {
    /// As the layout names them, and if it names none, one for each chart; their floors are outlines.
    std::vector<Level> levels;
    Layout home;                             ///< the layout, everything on one of these levels
    std::vector<double> attraction_heights;  ///< m, of the ground there
    TerrainFindings findings;
    /// With links and their openings, as it is seen and as people get on it; null where there are none.
    std::shared_ptr<const TerrainMesh> seen = {}, walked = {};
};

/// By group of given people, way and point of it: its chart.
using GivenCharts = std::vector<std::vector<std::vector<std::uint32_t>>>;

struct Charts {
    std::vector<Chart> charts;
    std::vector<ChartRaster> rasters;  ///< one per chart

    /// The layout in the plane: everything on its chart, and behind its walls the railings and the copies of
    /// walls beyond seams.
    Layout plane;
    /// All that stands in home coordinates: the layout's walls and the railings.
    std::vector<Wall> walls;
    std::vector<glm::dvec2> ground_along_walls;  ///< m, lowest and highest, one per wall

    TerrainMesh home_mesh;                               ///< slabs and stairs as they are built
    TerrainMesh plane_mesh;                              ///< what people stand on, in the plane
    std::shared_ptr<const TerrainGrounds> grounds = {};  ///< of a terrain; then there are no such meshes
    double reach = 0.0;                                  ///< m: the width of margins
    GivenCharts given;                                   ///< where the plane has the points of given ways
    std::uint32_t most_images = 0;
};

/// @returns null where the layout has mistakes, which are told
std::shared_ptr<const Charts> layOut(const Layout& layout, Diagnostics& diagnostics);

}  // namespace throng::authoring
