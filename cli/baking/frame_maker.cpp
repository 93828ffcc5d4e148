// SPDX-License-Identifier: Apache-2.0
#include "cli/baking/frame_maker.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace throng::cli {
namespace {

/// Crowds spread slowly, and nothing but speed depends on it.
constexpr std::uint32_t kFramesBetweenCounts = 12;

/// Those who are simulated.
recording::BakeDescription withoutAudience(recording::BakeDescription description) {
    description.agents.resize(description.walkers());
    description.audience.clear();
    return description;
}

}  // namespace

FrameMaker::FrameMaker(sim::Simulation& simulation, const authoring::SimulationSettings& settings,
                       const recording::BakeDescription& description, const Diagrams& diagrams,
                       Receiver simulated, Receiver shown)
    : simulation_(simulation),
      diagrams_(diagrams),
      simulated_(std::move(simulated)),
      audience_(description),
      walkers_(description.walkers()),
      seated_(static_cast<std::uint32_t>(description.audience.size())),
      warmup_(sim::warmupSteps(settings)),
      substeps_(static_cast<std::uint32_t>(settings.substeps)),
      recorder_(withoutAudience(description),
                [this, to = std::move(shown)](const Frame& frame) { to(audience_.with(frame)); }),
      looked_at_(simulation.lookedAtCount()),
      pump_(simulation, {diagrams.every > 0, diagrams.seconds, fromDevice(description.asked)},
            [this](const Frame& frame) { receive(frame); }) {}

void FrameMaker::endWhenEmpty(double fps) {
    if (seated_ > 0) return;  // who sits there for good does not leave
    empty_ = std::make_unique<EmptyWatch>(walkers_, static_cast<std::uint32_t>(std::lround(fps)));
}

bool FrameMaker::warmUp(const std::function<bool()>& goes_on) {
    for (std::uint32_t step = simulation_.stepsDone(); step < warmup_; ++step) {
        if (!simulation_.step()) return false;
        // Once in a while it is waited for: nobody could stop what has only been asked for.
        if (step % substeps_ == 0) simulation_.wait();
        if (!goes_on()) return false;
    }
    if (empty_ && warmup_ > 0 && frames() == 0) tellWhoHasGone();
    return true;
}

bool FrameMaker::makeFrame(std::uint32_t frame) {
    for (std::uint32_t step = 0; frame > 0 && step < substeps_; ++step)
        if (!simulation_.step()) return false;
    if (!pump_.submit(frame, diagrams_.every > 0 && frame % diagrams_.every == 0)) return false;
    if (has_received_) simulation_.adaptTo(walking_, walking_ * looked_at_by_each_);
    return true;
}

/// Of those who came and went in the warm-up, no frame tells.
void FrameMaker::tellWhoHasGone() {
    const std::vector<AgentOutcome> agents = simulation_.account().agents;
    for (std::size_t row = 0; row < agents.size(); ++row)
        if (agents[row].status == AgentStatus::arrived) empty_->hasGone(row);
}

void FrameMaker::countLookedAt(const Frame& frame) {
    const std::span<const float> states = frame[Stream::state], places = frame[Stream::pos];
    looked_at_->begin();
    for (std::size_t at = 0; at < states.size(); at += kComponents)
        if (states[at] > 0.5f) looked_at_->add({places[at], places[at + 1]});
    looked_at_by_each_ = looked_at_->pixels() / std::max(walking_.load(), 1u);
}

void FrameMaker::receive(const Frame& frame) {
    std::uint32_t alive = 0;
    const std::span<const float> states = frame[Stream::state];
    for (std::size_t at = 0; at < states.size(); at += kComponents)
        alive += states[at] > 0.5f;
    walking_ = alive;
    if (looked_at_ && (!has_received_ || frame.index % kFramesBetweenCounts == 0)) countLookedAt(frame);
    has_received_ = true;
    if (empty_ && !empty_->take(frame)) return;
    simulated_(frame);
    recorder_.take(frame);
}

}  // namespace throng::cli
