// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/terrain/terrain_mesh.h"

namespace throng::fuzz {

/// Builds the scene of a layout whose site and people are few enough for some scenes a second.
void buildIfSmall(const authoring::Layout& layout, authoring::Diagnostics& diagnostics,
                  const authoring::TerrainMesh* terrain = nullptr);

/// Makes the texts of all that was found, as the command line shows them; these have an end.
void tell(const authoring::Diagnostics& diagnostics, std::string_view text);

}  // namespace throng::fuzz
