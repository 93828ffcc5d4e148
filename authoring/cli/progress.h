// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace throng::cli {

/// "1:02" or "1:02:03".
std::string timeText(double seconds);

/// Tells how far a bake is: one line that rewrites itself on a terminal, a line every ten percent elsewhere,
/// JSON lines for machines. Everything goes to stderr, so that stdout holds results only.
class Progress {
  public:
    enum class Style { terminal, plain, json, quiet };

    /// The style that suits stderr.
    static Style detectStyle();

    /// @param steps_before done by an earlier run
    Progress(Style style, std::uint32_t frames, std::uint32_t warmup_steps, std::uint32_t substeps,
             std::uint32_t steps_before = 0);
    /// Ends a line that is being rewritten.
    ~Progress();

    /// @param frames_done captured so far; @param agents in the scene now; @param steps_done simulated so far
    void update(std::uint32_t frames_done, std::uint32_t agents, std::uint32_t steps_done);

  private:
    using Clock = std::chrono::steady_clock;
    bool isDue(double percent);

    Style style_;
    std::uint32_t frames_;
    double steps_;
    std::uint32_t steps_before_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = {};
    double last_percent_ = -100.0;
    bool line_open_ = false;
};

}  // namespace throng::cli
