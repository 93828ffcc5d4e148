// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Doors of vehicles at platforms, and those who get on and off (shaders/boarding).
class Boarding {
  public:
    Boarding(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
             const MotionSettings& rules);
    /// In every step: leaves of doors go on.
    void move();
    /// Where people decide, before they do: finds out who waits where, and what doors do next.
    void serve(float now, std::uint32_t steps_done);
    /// After steering: what those want who have to do with a door.
    void wish();

  private:
    Buffers& buffers_;
    std::uint32_t rows_;
    gl::ComputeProgram move_, census_, control_, wish_;
};

}  // namespace throng::sim
