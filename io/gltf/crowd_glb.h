// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "io/gltf/lift_nodes.h"
#include "io/gltf/vehicle_nodes.h"
#include "io/streams/stream_set.h"
#include "recording/bake_description.h"

namespace throng::io {

struct GltfSummary {
    std::uint32_t agents = 0;  ///< people in the file
    std::uint32_t of = 0;      ///< people in the bake
};

/// What moves besides people.
struct MovingTracks {
    VehicleTracks vehicles = {};
    LiftTracks lifts = {};
};

/// Writes crowd.glb (glTF 2.0, Y up): ground, roads, areas, walls and stands as meshes, vehicles and lifts,
/// and one animated node for each person, at most `description.gltf_agents` of them, evenly chosen; fewer
/// where the file would pass 2 GiB. Memory stays bounded however long the bake. Throws OutputError and
/// InputError.
GltfSummary writeCrowdGlb(const std::filesystem::path& path, const recording::BakeDescription& description,
                          const StreamSet& streams, const MovingTracks& moving = {});

/// Writes the terrain alone, as it lies in the scene: one mesh, below a node at the bake's origin. Throws
/// OutputError.
void writeTerrainGlb(const std::filesystem::path& path, const recording::BakeDescription& description);

}  // namespace throng::io
