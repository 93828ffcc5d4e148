// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Keeps routes up to date with the crowd: where it jams, distances grow and people walk round.
/// Does nothing for scenes without detours.
class Congestion {
  public:
    Congestion(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
               const gpu::Parameters& parameters);
    void run();

  private:
    void relax(std::uint32_t field);

    std::uint32_t cells_ = 0;
    std::uint32_t fields_ = 0;
    std::uint32_t fields_per_step_ = 0;
    std::uint32_t next_field_ = 0;
    std::uint32_t steps_ = 0;
    std::vector<std::uint32_t> ground_of_field_;
    std::vector<bool> has_choice_;  // by field
    gl::Buffer ground_, free_distances_, distances_, next_distances_, flows_;
    gl::ComputeProgram flow_, relax_, slope_;
};

}  // namespace throng::sim
