// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/scene.h"
#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Ground that bodies take another room on.
class Sizes {
  public:
    Sizes(const gl::ShaderLibrary& library, const Buffers& buffers, const authoring::Scene& scene);
    /// Where people decide, once they are in their slots. @param now s, simulation time at the start of the
    /// step
    void run(float now);

  private:
    const Buffers& buffers_;
    gl::Buffer patches_, points_;
    gl::ComputeProgram grow_, take_;
};

}  // namespace throng::sim
