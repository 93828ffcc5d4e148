// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "base/stopwatch.h"

namespace throng::cli {

/// "1:02" or "1:02:03".
std::string timeText(double seconds);

/// How progress is told. Everything goes to stderr, so that stdout holds results only.
enum class ProgressStyle {
    terminal,  ///< one line that rewrites itself
    plain,     ///< a line every ten percent, or every minute
    json,      ///< JSON lines for machines
    quiet,
};

/// What was asked for, or the style that suits stderr.
ProgressStyle progressStyle(bool quiet, bool json);

/// The line on stderr that says how far something is, and when it is worth writing again.
class StatusLine {
  public:
    explicit StatusLine(ProgressStyle style) : style_(style) {}
    StatusLine(const StatusLine&) = delete;
    StatusLine& operator=(const StatusLine&) = delete;
    /// Ends a line that is being rewritten.
    ~StatusLine();

    ProgressStyle style() const { return style_; }
    /// Whether it is time to write again; then it counts as written.
    bool isDue(double percent);
    /// @param json without its braces, for style json; @param text for people
    void write(const std::string& json, const std::string& text);
    /// s since this line began.
    double elapsed() const { return secondsSince(start_); }

  private:
    ProgressStyle style_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
    double last_percent_ = -100.0;
    bool line_open_ = false;
};

/// Tells how far a bake is.
class Progress {
  public:
    /// @param steps_before done by an earlier run
    Progress(ProgressStyle style, std::uint32_t frames, std::uint32_t warmup_steps, std::uint32_t substeps,
             std::uint32_t steps_before = 0);
    /// @param frames_done captured so far; @param agents in the scene now; @param steps_done simulated so far
    void update(std::uint32_t frames_done, std::uint32_t agents, std::uint32_t steps_done);

  private:
    StatusLine line_;
    std::uint32_t frames_;
    double steps_;
    std::uint32_t steps_before_;
};

}  // namespace throng::cli
