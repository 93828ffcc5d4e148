// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/scene.h"
#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Signals and vehicles.
class Traffic {
  public:
    /// @param targets where contact leaves people
    Traffic(const gl::ShaderLibrary& library, const authoring::Scene& scene, Buffers& buffers,
            const gl::Buffer& targets);
    /// Puts signals as they are at a time.
    /// @param now s, at the start of the coming step
    void switchLights(double now);
    /// All vehicles go on by a step.
    void drive(float now);
    /// After contact: nobody is left in a vehicle, or on a crossing that is red and was not theirs.
    void keepOff();
    std::size_t vehicles() const { return vehicles_; }

  private:
    Buffers& buffers_;
    std::vector<authoring::LightPlan> plans_;
    std::vector<std::uint32_t> lights_;
    std::uint32_t rows_;
    std::size_t vehicles_;
    gl::ComputeProgram look_, drive_, keep_off_;
};

}  // namespace throng::sim
