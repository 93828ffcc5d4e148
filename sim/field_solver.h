// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/scene/distance_solver.h"
#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Works distance fields out on the device, by the fast iterative method (Jeong and Whitaker 2008): the grid
/// is cut into square blocks, and those that may still change go on, all at once, until none does. It ends in
/// the distances of fast marching, up to rounding, and in the same ones every time.
class FieldSolver : public authoring::DistanceSolver {
  public:
    explicit FieldSolver(const gl::ShaderLibrary& library);

    /// @throws gl::GraphicsError when the device has no room
    std::vector<float> solve(const authoring::WalkMap& map, const std::vector<float>& start) override;

  private:
    struct Programs {
        gl::ComputeProgram relax, keep, list;
    };
    Programs programsFor(const authoring::WalkMap& map) const;
    void iterate(Programs& programs, std::uint32_t blocks);

    gl::ShaderLibrary library_;
    gl::Buffer steps_, open_sides_, one_way_, distances_, next_distances_, changed_, listed_;
    gl::Buffer no_blocks_, block_dispatch_;
};

}  // namespace throng::sim
