// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "authoring/terrain/terrain_mesh.h"

namespace throng::authoring {

/// What is on one side of a plane: the places for which dot(normal, place) is at most `most`.
struct HalfSpace {
    glm::dvec3 normal{0.0};
    double most = 0.0;

    double beyond(glm::dvec3 place) const;  ///< m where the normal is a unit vector; negative within
};

/// Convex, and upright but for its top and bottom.
struct UprightSolid {
    std::vector<HalfSpace> sides, ends;  ///< the latter are its top and its bottom
    bool takes_floors = true;            ///< false: only faces that are about upright give way to it
};

/// A mesh without what of its faces lies within solids.
struct CutMesh {
    TerrainMesh mesh;
    /// By solid: where upright faces were taken out that are as high as a wall, the first of them.
    std::vector<std::optional<glm::dvec3>> walls;
};

/// @param lined whether slabs get sides where they are cut
CutMesh cutOut(const TerrainMesh& mesh, const std::vector<UprightSolid>& solids, bool lined);

/// Adds all faces of one mesh to another.
void addMesh(TerrainMesh& mesh, const TerrainMesh& other);

}  // namespace throng::authoring
