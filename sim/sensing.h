// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/buffers.h"
#include "sim/diagram/diagram.h"
#include "sim/gl/program.h"
#include "sim/sensing_pattern.h"

namespace throng::sim {

/// What sensing needs to know besides the diagram.
struct SensingOptions {
    authoring::Proximity proximity = authoring::Proximity::voronoi;
    SensingGeometry geometry;
    int neighbours = 10;      ///< the length of each person's list
    float felt_range = 1.0f;  ///< m: everybody within is found whatever the field of view
};

/// Finds each person's nearest neighbours: by marching rays through the diagram, or, for comparison, exactly.
class Sensing {
  public:
    Sensing(const gl::ShaderLibrary& library, Buffers& buffers, const Diagram& diagram,
            const SensingOptions& options, const authoring::Scene& scene, const gpu::Parameters& parameters);
    void run();
    /// Of a diagram in bands: those who stand in the one that has been built.
    void run(std::uint32_t band);
    /// Whether run() reads the diagram.
    bool needsDiagram() const { return proximity_ == authoring::Proximity::voronoi; }

  private:
    void marchRays(const gl::ShaderLibrary& library, const Diagram& diagram, const SensingOptions& options);
    void compareExactly(const gl::ShaderLibrary& library, const SensingOptions& options,
                        const authoring::Scene& scene, const gpu::Parameters& parameters);

    Buffers& buffers_;
    const Diagram& diagram_;
    authoring::Proximity proximity_;
    gl::Buffer pattern_;  ///< where people look: what rays are marched with
    gl::Buffer far_wall_starts_, far_wall_items_;
    gl::ComputeProgram program_;
};

}  // namespace throng::sim
