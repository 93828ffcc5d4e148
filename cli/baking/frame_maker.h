// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "authoring/layout.h"
#include "cli/baking/empty_watch.h"
#include "recording/audience.h"
#include "recording/bake_description.h"
#include "recording/motion_recorder.h"
#include "sim/frame_pump.h"
#include "sim/simulation.h"

namespace throng::cli {

/// Simulates a layout frame by frame, and makes of each what is shown of it, with those who have seats.
class FrameMaker {
  public:
    using Receiver = std::function<void(const Frame&)>;
    struct Diagrams {
        std::uint32_t every = 0;  ///< frames between them; 0: none
        bool seconds = false;     ///< with the second-nearest sites
    };

    /// @param simulation outlives this; @param simulated has frames as they come from it, without those who
    /// have seats; @param shown has them later, in the same order. Both are called on another thread.
    FrameMaker(sim::Simulation& simulation, const authoring::SimulationSettings& settings,
               const recording::BakeDescription& description, const Diagrams& diagrams, Receiver simulated,
               Receiver shown);

    /// Before the warm-up, or before going on: frames end a second after the last person has left.
    void endWhenEmpty(double fps);
    /// Whether they have, and all that there are have been given out or will be by finish().
    bool hasEnded() const { return empty_ && empty_->hasEnded(); }
    /// Null unless frames end.
    EmptyWatch* emptyWatch() { return empty_.get(); }

    /// What comes before the first frame. @param goes_on is asked after each step
    /// @returns false where it does not go on
    bool warmUp(const std::function<bool()>& goes_on);
    /// The next one. @returns false where it was stopped: there is no such frame then
    bool makeFrame(std::uint32_t frame);

    /// Waits until both receivers have had what there is for them.
    void wait() { pump_.finish(); }
    /// Gives out the frames that wait for later ones, when there are none.
    void finish() { recorder_.finish(); }

    recording::MotionRecorder& recorder() { return recorder_; }
    std::uint32_t frames() const { return recorder_.framesTaken(); }
    std::uint32_t warmUpSteps() const { return warmup_; }
    std::uint32_t substeps() const { return substeps_; }
    /// Who is in the scene, in one of the last frames, with those who have seats.
    std::uint32_t present() const { return walking_ + seated_; }

  private:
    void tellWhoHasGone();
    void receive(const Frame& frame);
    void countLookedAt(const Frame& frame);

    sim::Simulation& simulation_;
    Diagrams diagrams_;
    Receiver simulated_;
    recording::Audience audience_;
    std::size_t walkers_;
    std::uint32_t seated_, warmup_, substeps_;
    recording::MotionRecorder recorder_;
    std::atomic<std::uint32_t> walking_{0};
    std::atomic<bool> has_received_{false};
    std::optional<sim::LookedAtCount> looked_at_;
    std::atomic<double> looked_at_by_each_{0.0};  // px
    std::unique_ptr<EmptyWatch> empty_;
    sim::FramePump pump_;  // last: its thread uses the others
};

}  // namespace throng::cli
