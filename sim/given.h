// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/scene.h"
#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// People whose ways are given: others make room for them, and nobody moves them (shaders/given).
class Given {
  public:
    Given(const gl::ShaderLibrary& library, const Buffers& buffers, const authoring::Scene& scene);
    /// After steering. @param now, until s: of this decision, and of the next
    void wish(float now, float until);
    /// After each round of contact. @param targets where it leaves people; @param until s: when the step ends
    void hold(const gl::Buffer& targets, float until);
    /// At the end of a step. @param steps_done counted with it
    void place(std::uint32_t steps_done, float until, float step_seconds);

  private:
    const Buffers& buffers_;
    std::uint32_t count_;
    gl::Buffer ways_, places_;
    gl::ComputeProgram wish_, hold_, place_;
};

}  // namespace throng::sim
