// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace throng::authoring {

/// Triangles of a terrain in world coordinates, metres, Z up, counter-clockwise from above.
struct TerrainMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;  ///< unit length, one per position
    std::vector<std::uint32_t> indices;
};

}  // namespace throng::authoring
