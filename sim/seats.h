// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// People who walk to seats, sit in them and leave them: between the rows they are led, and in nobody's way
/// (shaders/seats).
class Seats {
  public:
    Seats(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
          const MotionSettings& rules);
    /// Before people are sorted into cells. @param decides whether they are in this step, so that who comes
    /// in or goes out is seen at once; @param steps_done counted with this step
    void lead(bool decides, std::uint32_t steps_done);
    /// Who does what next of those between the rows. @param now s, simulation time at the start of the step
    void think(float now, std::uint32_t steps_done);

    /// What a step hands to the next one.
    std::vector<std::pair<std::string, gl::Buffer*>> remembered();

  private:
    Buffers& buffers_;
    std::uint32_t count_;
    gl::Buffer next_;
    gl::Buffer lanes_, lane_mates_;  // who goes into a row from the same aisle
    gl::Buffer walkers_;             // of each aisle, in the step under way
    gl::WordTexture walker_texels_;
    gl::Buffer walker_counts_;
    gl::ComputeProgram list_walkers_, lead_, minds_;
};

}  // namespace throng::sim
