// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/scene.h"
#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Ground that people walk on at another pace.
class Patches {
  public:
    Patches(const gl::ShaderLibrary& library, const Buffers& buffers, const authoring::Scene& scene);
    /// After steering. @param now s, simulation time at the start of the step
    void run(float now);

  private:
    const Buffers& buffers_;
    gl::Buffer patches_, points_;
    gl::ComputeProgram program_;
};

}  // namespace throng::sim
