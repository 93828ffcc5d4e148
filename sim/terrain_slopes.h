// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "authoring/scene.h"
#include "authoring/terrain/terrain.h"
#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// A terrain on the device, as far as walking has to know it: how it slopes, without its steps.
class TerrainSlopes {
  public:
    explicit TerrainSlopes(std::shared_ptr<const authoring::Terrain> terrain);
    /// None on flat ground, and where slopes slow nobody.
    static std::optional<TerrainSlopes> of(const authoring::Scene& scene);

    /// Connects a program that reads shaders/shared/terrain.glsl.
    void describeTo(gl::Program& program) const;

  private:
    std::shared_ptr<const authoring::Terrain> terrain_;
    gl::Buffer nodes_;
};

}  // namespace throng::sim
