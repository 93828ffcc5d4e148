// SPDX-License-Identifier: Apache-2.0
#include "sim/terrain_slopes.h"

namespace throng::sim {

TerrainSlopes::TerrainSlopes(std::shared_ptr<const authoring::Terrain> terrain)
    : terrain_(std::move(terrain)),
      nodes_(gl::makeBuffer("terrain nodes", terrain_->nodes(), "terrain node")) {}

void TerrainSlopes::describeTo(gl::Program& program) const {
    program.bind("TerrainNodes", nodes_);
    program.set("terrain_minimum", terrain_->minimum());
    program.set("lattice_cell", terrain_->lattice().cell);
    program.set("lattice_size", glm::uvec2(terrain_->lattice().width, terrain_->lattice().height));
}

}  // namespace throng::sim
