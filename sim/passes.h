// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "sim/buffers.h"
#include "sim/diagram/diagram.h"
#include "sim/gl/program.h"
#include "sim/sensing_pattern.h"
#include "sim/terrain_slopes.h"

/// The passes of a step. Each owns its programs, binds them to the buffers once, and has one verb.
namespace throng::sim {

/// Sorts people into cells and gathers their bodies in that order (counting sort, deterministic).
class CellSort {
  public:
    /// What a diagram built afterwards has for owners: slots to sense with, rows to look at.
    enum class SiteIds { slots, rows };

    CellSort(const gl::ShaderLibrary& library, Buffers& buffers, const gpu::Parameters& parameters);
    void run(SiteIds ids = SiteIds::slots);

  private:
    Buffers& buffers_;
    std::uint32_t rows_;
    std::uint64_t scan_threads_;
    gl::ComputeProgram count_, sum_, scan_, fill_, scatter_, gather_;
};

/// Lets people enter where there is room.
class Spawner {
  public:
    Spawner(const gl::ShaderLibrary& library, Buffers& buffers, const gpu::Parameters& parameters,
            const MotionSettings& rules);
    /// @param now s, simulation time at the start of the step; @param steps_done counted with this step
    void run(float now, std::uint32_t steps_done);

  private:
    std::uint64_t invocations_;
    gl::ComputeProgram propose_, accept_;
};

/// Hands out places in the lines that people wait in.
class WaitingLines {
  public:
    WaitingLines(const gl::ShaderLibrary& library, Buffers& buffers, std::uint32_t count);
    void run();

  private:
    std::uint32_t count_;
    gl::ComputeProgram program_;
};

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
    /// Whether run() reads the diagram.
    bool needsDiagram() const { return proximity_ == authoring::Proximity::voronoi; }

  private:
    void marchRays(const gl::ShaderLibrary& library, const Diagram& diagram, const SensingOptions& options);
    void compareExactly(const gl::ShaderLibrary& library, const SensingOptions& options,
                        const authoring::Scene& scene, const gpu::Parameters& parameters);

    Buffers& buffers_;
    authoring::Proximity proximity_;
    gl::Buffer far_wall_starts_, far_wall_items_;
    gl::ComputeProgram program_;
};

/// Wished velocities along the routes, then velocities that avoid everybody sensed.
class Avoidance {
  public:
    /// @param ground that slows people down where it slopes, or null where it is flat
    Avoidance(const gl::ShaderLibrary& library, Buffers& buffers, int neighbours, const TerrainSlopes* ground,
              const MotionSettings& rules);
    void run(std::uint32_t steps_done);

  private:
    Buffers& buffers_;
    gl::ComputeProgram steer_, avoid_;
};

/// Keeps bodies out of each other and out of walls.
class Contacts {
  public:
    Contacts(const gl::ShaderLibrary& library, Buffers& buffers, int iterations, const MotionSettings& rules);
    void run();
    /// Where run() leaves the positions.
    const gl::Buffer& result() const { return iterations_ % 2 ? buffers_.targets_after : buffers_.targets; }

  private:
    Buffers& buffers_;
    int iterations_;
    int braced_;             // of these, the first ones, in which weights count
    float spectral_radius_;  // 0 = without momentum
    gl::ComputeProgram forth_, back_;
};

/// Ends the step: positions, headings, gait, routes, arrivals.
class Motion {
  public:
    Motion(const gl::ShaderLibrary& library, Buffers& buffers, const gl::Buffer& targets,
           const MotionSettings& rules);
    void run(std::uint32_t steps_done);

  private:
    Buffers& buffers_;
    gl::ComputeProgram program_;
};

}  // namespace throng::sim
