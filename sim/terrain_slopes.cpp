// SPDX-License-Identifier: Apache-2.0
#include "sim/terrain_slopes.h"

namespace throng::sim {

TerrainSlopes::TerrainSlopes(std::shared_ptr<const authoring::Terrain> terrain)
    : terrain_(std::move(terrain)),
      nodes_(gl::makeBuffer("terrain nodes", terrain_->nodes(), "terrain node")) {}

std::optional<TerrainSlopes> TerrainSlopes::of(const authoring::Scene& scene) {
    if (!scene.terrain || !scene.settings.motion.isOn("slope_pace")) return std::nullopt;
    return TerrainSlopes(scene.terrain);
}

void TerrainSlopes::describeTo(gl::Program& program) const {
    program.bind("TerrainNodes", nodes_);
    program.set("terrain_minimum", terrain_->minimum());
    program.set("lattice_cell", terrain_->lattice().cell);
    program.set("lattice_size", glm::uvec2(terrain_->lattice().width, terrain_->lattice().height));
}

}  // namespace throng::sim
