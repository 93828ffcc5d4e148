// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "base/frame.h"
#include "recording/bake_description.h"
#include "recording/seated_heads.h"

namespace throng::recording {

/// Adds those who have seats to the frames of those who are simulated: their rows come last. They stay where
/// they are, so what they do follows from the time alone.
class Audience {
  public:
    explicit Audience(const BakeDescription& description);

    bool empty() const { return people_.empty(); }
    /// The frame with everybody; valid until the next call.
    Frame with(const Frame& frame);

  private:
    void fill(Stream stream, std::span<float> values, double time) const;

    double fps_;
    std::vector<BakeSpectator> people_;
    SeatedHeads heads_;
    PerStream<std::vector<float>> values_;
    StreamChoice written_;
};

/// What somebody does at a time, and how far it is with it.
struct ActivityNow {
    ActivityCode activity = ActivityCode::sits;
    double phase = 0.0;  ///< cycles
};
ActivityNow activityAt(std::span<const Deed> deeds, double time);

}  // namespace throng::recording
