// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Cabins that go up and down, and those who wait for them and ride (shaders/lifts).
class Lifts {
  public:
    Lifts(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
          const MotionSettings& rules);
    /// In every step: cabins and their doors go on.
    void move();
    /// Where people decide, before they do: finds out who wants what, and what each lift does next.
    void serve();
    /// After steering: what those want who have to do with a lift.
    void wish();
    /// After contact: doors are a wall to all who are not to go through them.
    /// @param targets where contact leaves people
    void keepOut(const gl::Buffer& targets);
    std::size_t count() const { return count_; }

  private:
    Buffers& buffers_;
    std::size_t count_;
    std::uint32_t rows_;
    gl::ComputeProgram move_, census_, control_, wish_, keep_out_;
};

}  // namespace throng::sim
