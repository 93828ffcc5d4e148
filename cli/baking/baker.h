// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cli/baking/bake_description.h"
#include "cli/baking/load_layout.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/progress.h"
#include "io/bake_writer.h"
#include "sim/diagram/cost_model.h"
#include "sim/frame_pump.h"
#include "sim/gl/context.h"
#include "sim/gl/shader_source.h"
#include "sim/simulation.h"

namespace throng::cli {

/// What becomes of a bake that is stopped before its last frame.
enum class WhenStopped {
    keep_partial,  ///< what there is becomes NAME.partial
    checkpoint,    ///< it stays as NAME.unfinished, with a checkpoint to go on from
    discard,
};

/// How a layout is baked.
struct BakeJob {
    BakeOptions options;
    std::uint32_t diagram_every = 0;  ///< frames between diagram images, 0 for none
    bool seconds = false;             ///< diagrams with the second-nearest sites
    StreamChoice streams{};           ///< asked for, besides those of every bake
    double checkpoint_seconds = 0.0;  ///< between checkpoints; 0: none, and nothing is left to go on from
    bool resume = false;              ///< go on from an earlier run's checkpoint where there is one
    /// @param signal that came; @param seconds that the bake has taken so far
    std::function<WhenStopped(int signal, double seconds)> when_stopped = [](int, double) {
        return WhenStopped::keep_partial;
    };
    ProgressStyle progress = ProgressStyle::quiet;
};

/// What came of it.
struct BakeRun {
    enum class End { complete, partial, checkpointed, discarded, was_complete } end = End::complete;
    int signal = 0;            ///< that stopped it, or 0
    std::uint32_t frames = 0;  ///< written
    io::BakeResult result;     ///< complete and partial ones
    Account account;
    io::BakeTiming timing;
    double setup_seconds = 0.0;  ///< until the simulation could begin
};

/// Crowds smaller than this are drawn faster by Mesa's software renderer without threads.
inline constexpr double kWorthThreads = 1000.0;

/// Bakes one layout after the other on one device, with programs compiled once.
class Baker {
  public:
    /// @param device as gl::Context::Options::device; @param shader_dir empty for the shaders in the binary
    /// @param people about as many as there will be in each bake
    Baker(int device, const std::string& shader_dir, std::size_t people);

    const gl::Device& device() const { return context_.device(); }
    const gl::Context& context() const { return context_; }

    /// A simulation on this device, with its programs.
    sim::Simulation simulate(const authoring::Scene& scene) const { return {scene, shaders_, costs_}; }

    /// @throws whatever simulating and writing throw; nothing is left behind then but checkpoints
    BakeRun bake(LoadedLayout& loaded, const BakeJob& job, const InterruptGuard& interrupt);

  private:
    gl::Context context_;
    gl::ShaderLibrary shaders_;  // after the context: its programs go first
    sim::CostModel costs_;
};

}  // namespace throng::cli
