// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "authoring/layout.h"
#include "authoring/terrain/terrain_mesh.h"

namespace throng::io {

/// The triangles of a terrain's file in world coordinates, as the layout places them. The file may come from
/// anybody.
/// @throws InputError: the file cannot be read or is not sound, holds no triangles, or no node of the name
/// asked for
authoring::TerrainMesh readTerrain(const std::filesystem::path& path,
                                   const authoring::TerrainSettings& settings);

}  // namespace throng::io
