// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/scene.h"
#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Walls that are too high to look over hide people from each other.
class Hiding {
  public:
    /// @param reach m: how far away people are sensed
    Hiding(const gl::ShaderLibrary& library, const Buffers& buffers, const authoring::Scene& scene,
           const gpu::Parameters& parameters, float reach);
    /// After sensing.
    void run();

  private:
    const Buffers& buffers_;
    gl::Buffer starts_, items_;
    gl::ComputeProgram program_;
};

}  // namespace throng::sim
