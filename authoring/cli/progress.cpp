// SPDX-License-Identifier: Apache-2.0
#include "authoring/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace throng::cli {
std::string timeText(double seconds) {
    const auto whole = static_cast<long>(std::lround(seconds));
    return whole >= 3600 ? fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60)
                         : fmt::format("{}:{:02}", whole / 60, whole % 60);
}

Progress::Style Progress::detectStyle() {
    const char* terminal = std::getenv("TERM");
    const bool dumb = !terminal || std::string(terminal) == "dumb";
    return isatty(STDERR_FILENO) && !dumb ? Style::terminal : Style::plain;
}

Progress::Progress(Style style, std::uint32_t frames, std::uint32_t warmup_steps, std::uint32_t substeps,
                   std::uint32_t steps_before)
    : style_(style),
      frames_(frames),
      steps_(static_cast<double>(warmup_steps) + static_cast<double>(frames) * substeps),
      steps_before_(steps_before) {}

Progress::~Progress() {
    if (line_open_) fmt::print(stderr, "\n");
}

bool Progress::isDue(double percent) {
    if (style_ == Style::quiet) return false;
    const Clock::time_point now = Clock::now();
    const double since = std::chrono::duration<double>(now - last_).count();
    const bool due = percent >= 100.0         ? last_percent_ < 100.0
                     : style_ == Style::plain ? percent - last_percent_ >= 10.0
                                              : since >= (style_ == Style::json ? 0.5 : 0.1);
    if (due) {
        last_ = now;
        last_percent_ = percent;
    }
    return due;
}

void Progress::update(std::uint32_t frames_done, std::uint32_t agents, std::uint32_t steps_done) {
    const double percent = steps_ > 0.0 ? std::min(100.0, 100.0 * steps_done / steps_) : 100.0;
    if (!isDue(percent)) return;
    const double elapsed = std::max(1.0e-6, std::chrono::duration<double>(Clock::now() - start_).count());
    const double speed = (steps_done - steps_before_) / elapsed;
    const double left = speed > 0.0 ? (steps_ - steps_done) / speed : 0.0;
    if (style_ == Style::json) {
        fmt::print(stderr,
                   "{{\"progress\": {:.1f}, \"frame\": {}, \"frames\": {}, \"agents\": {}, "
                   "\"steps_per_second\": {:.1f}, "
                   "\"eta_seconds\": {:.1f}}}\n",
                   percent, frames_done, frames_, agents, speed, left);
        return;
    }
    const std::string text = fmt::format("{:3.0f} %  frame {} of {}  {} people  {:.0f} steps/s  {} left",
                                         percent, frames_done, frames_, agents, speed, timeText(left));
    if (style_ == Style::plain) {
        fmt::print(stderr, "{}\n", text);
        return;
    }
    fmt::print(stderr, "\r{}\x1b[K", text);
    std::fflush(stderr);
    line_open_ = true;
}

}  // namespace throng::cli
