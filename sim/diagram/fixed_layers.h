// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

struct DiagramSetup;

/// The diagram of the sites that never move, worked out once: however many walls there are, a build then
/// takes no longer than reading two words a pixel where it writes one.
class FixedLayers {
  public:
    explicit FixedLayers(const DiagramSetup& setup);
    const gl::Buffer& owners() const { return owners_; }        ///< NO_INDEX where there is none
    const gl::Buffer& distances() const { return distances_; }  ///< squared, as bits; above all others there

  private:
    gl::Buffer owners_, distances_;
};

/// The two passes of shaders/diagram/splat.glsl, over whatever sites are bound.
class Splat {
  public:
    Splat(const DiagramSetup& setup, const gl::Buffer& owners, const gl::Buffer& distances);
    void bindSites(const gl::Buffer& sites, const gl::Buffer& live_dispatch);
    void run() const;

  private:
    gl::ComputeProgram distance_pass_, site_pass_;
    const gl::Buffer* live_dispatch_ = nullptr;
};

}  // namespace throng::sim
