// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "sim/diagram/diagram.h"
#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// A diagram of which one band of lines is kept at a time.
///
/// It is looked at once, by people who stand in the order of cells, line by line: those in some lines of
/// cells look at the pixels of these lines and as far beyond as people look, no more. So one band after the
/// other is built, and those who stand in it look round; the diagram of a large crowd then takes a fraction
/// of its room, for the lines that are built twice where bands meet.
class Bands {
  public:
    /// @param input its sites come sorted, by the bins that the options' bands are lines of
    Bands(const gl::ShaderLibrary& library, const DiagramOptions& options, const DiagramInput& input);

    std::uint32_t count() const { return count_; }
    /// px: the first line that a band keeps, and one past the last.
    glm::uvec2 lines(std::uint32_t band) const;

    /// Finds out who stands where, for the bands of this build.
    void findSlots() const { find_.dispatch(count_); }
    /// Runs a program with shaders/diagram/band_slots.glsl over those who stand in a band.
    void dispatch(gl::ComputeProgram& program, std::uint32_t band) const;

  private:
    BandShape shape_;
    std::uint32_t height_;  // px, of the window
    float look_;            // px
    std::uint32_t count_;
    gl::Buffer bands_;
    gl::ComputeProgram find_;
};

}  // namespace throng::sim
