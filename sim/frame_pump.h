// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "base/frame.h"
#include "sim/simulation.h"

namespace throng::sim {

/// So many frames may be on their way at once. Of large crowds two: a frame of theirs takes many times longer
/// to make than a hiccup of its receiver lasts, and each is as large as all that two of their lists hold.
constexpr std::uint32_t framesUnderWay(std::uint32_t people) {
    constexpr std::uint32_t kLargeCrowd = 16384;
    return people < kLargeCrowd ? 3 : 2;
}

/// Carries frames from the device to a receiver on another thread, without stopping the simulation: the
/// device packs a frame into one of a few persistently mapped buffers, a fence says when it is there, and the
/// receiver reads it in place.
///
/// submit() and finish() belong to the GL thread. Frames arrive in order. An exception of the receiver comes
/// out of the next submit() or of finish().
class FramePump {
  public:
    using Receiver = std::function<void(const Frame&)>;

    /// What frames carry besides the state of everybody. Diagrams are large: submit() asks for them singly.
    struct Cargo {
        bool diagrams = false;   ///< submit() may ask for the diagram
        bool seconds = false;    ///< diagrams with the second-nearest sites
        StreamChoice streams{};  ///< from the device, in every frame
    };

    /// @throws GraphicsError where diagrams are too large to be read back
    FramePump(Simulation& simulation, const Cargo& cargo, Receiver receiver);
    /// Waits for the receiver; frames not yet handed over are dropped.
    ~FramePump();

    /// Captures the present state as frame `index`. Waits only when all buffers are still being read.
    /// @returns false where its diagram was stopped: there is no such frame then
    bool submit(std::uint32_t index, bool with_diagram);
    /// Waits until the receiver has had every frame.
    void finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace throng::sim
