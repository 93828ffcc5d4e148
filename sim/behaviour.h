// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// What people do by their behaviours: counts who is where, lets everybody change their mind, and tells them
/// where to go. Before they decide, and only in scenes with behaviours.
class Behaviour {
  public:
    Behaviour(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
              const MotionSettings& rules);
    /// @param now s, simulation time at the start of the step; @param steps_done counted with this step
    void run(float now, std::uint32_t steps_done);

    /// What a step hands to the next one.
    std::vector<std::pair<std::string, gl::Buffer*>> remembered();

  private:
    Buffers& buffers_;
    std::uint32_t census_count_;
    gl::ComputeProgram census_, transitions_, goals_;
};

}  // namespace throng::sim
