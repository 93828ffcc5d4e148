// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/buffers.h"
#include "sim/gl/program.h"
#include "sim/seams.h"
#include "sim/terrain_slopes.h"

/// The passes that move people. Each owns its programs, says what they touch, binds them to the buffers once,
/// and has one verb.
namespace throng::sim {

/// The programs by which people decide and move, by rules of one's own.
/// @param ground as Avoidance
gl::ComputeProgram makeSteer(const gl::ShaderLibrary& library, const Buffers& buffers,
                             const TerrainSlopes* ground, const MotionSettings& rules);
gl::ComputeProgram makeAvoid(const gl::ShaderLibrary& library, const Buffers& buffers, int neighbours,
                             const MotionSettings& rules);
gl::ComputeProgram makeCarryOn(const gl::ShaderLibrary& library, const Buffers& buffers,
                               const MotionSettings& rules);
gl::ComputeProgram makeMove(const gl::ShaderLibrary& library, const Buffers& buffers,
                            const MotionSettings& rules);

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

/// Wished velocities along the routes, then velocities that avoid everybody sensed.
class Avoidance {
  public:
    /// @param ground that slows people down where it slopes, or null where it is flat
    /// @param seams null: there are none
    Avoidance(const gl::ShaderLibrary& library, Buffers& buffers, int neighbours, const TerrainSlopes* ground,
              const MotionSettings& rules, Seams* seams = nullptr);
    /// @param change_wishes runs what else decides on wished velocities, before anybody avoids anybody
    void run(
        std::uint32_t steps_done, const std::function<void()>& change_wishes = [] {});
    /// Steps between two decisions: as was decided.
    void carryOn();

  private:
    Buffers& buffers_;
    Seams* seams_;
    gl::ComputeProgram steer_, avoid_, carry_on_;
};

/// Keeps bodies out of each other and out of walls.
class Contacts {
  public:
    /// What it moves, and what else of it may lie elsewhere.
    struct Places {
        const gl::Buffer &targets, &targets_after, &touch_words;
    };
    Contacts(const gl::ShaderLibrary& library, Buffers& buffers, int iterations, const MotionSettings& rules,
             Seams* seams = nullptr);
    Contacts(const gl::ShaderLibrary& library, const Buffers& buffers, int iterations,
             const MotionSettings& rules, const Places& places);
    /// @param hold is called after each round with the positions that it has made
    void run(const std::function<void(const gl::Buffer&)>& hold = [](const gl::Buffer&) {});
    /// Where run() leaves the positions.
    const gl::Buffer& result() const { return iterations_ % 2 ? places_.targets_after : places_.targets; }

  private:
    void makeFirstRounds(const gl::ShaderLibrary& library, const MotionSettings& rules);
    gl::ComputeProgram& programOf(int iteration);

    const Buffers& buffers_;
    Places places_;
    Seams* seams_ = nullptr;
    int iterations_;
    int braced_;             // of these, the first ones, in which weights count
    float spectral_radius_;  // 0 = without momentum
    gl::ComputeProgram weigh_, forth_, back_;
    /// The first round, which differs where bodies are no discs, and those with weights, back and forth. The
    /// others are spared what only these do.
    std::vector<gl::ComputeProgram> first_rounds_;
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
