// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Takes people over the seams of charts, and their images along (authoring/storeys/charts.h).
class Seams {
  public:
    /// After which pass something of people has changed that others look at.
    enum class After { steering, avoiding, carrying_on, round_forth, round_back };
    static constexpr std::size_t kPasses = 5;

    Seams(const gl::ShaderLibrary& library, Buffers& buffers, const MotionSettings& rules);
    /// Before people are sorted into cells.
    void cross();
    void takeAlong(After pass);

  private:
    Buffers& buffers_;
    gl::ComputeProgram cross_;
    std::array<gl::ComputeProgram, kPasses> follow_;
};

}  // namespace throng::sim
