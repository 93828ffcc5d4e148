// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/scene.h"
#include "sim/buffers.h"
#include "sim/diagram/diagram.h"

namespace throng::sim {

/// Takes walls away and puts them back at their times. Where a wall is indexed does not change: an open one
/// is a point far outside the scene, and its tiles are too small to own a pixel.
class Gates {
  public:
    Gates(const authoring::Scene& scene, Buffers& buffers, Diagram& diagram,
          const gpu::Parameters& parameters);
    /// @param now s, at the start of the coming step
    void move(double now);

  private:
    void upload();

    Buffers& buffers_;
    Diagram& diagram_;
    std::vector<authoring::GateMove> moves_;
    std::size_t moves_done_ = 0;
    std::vector<bool> open_;  // by wall
    std::vector<gpu::WallSegment> segments_;
    std::vector<gpu::WallTile> tiles_;
    std::vector<gpu::DiagramSite> sites_;
    std::size_t first_site_ = 0;
};

}  // namespace throng::sim
