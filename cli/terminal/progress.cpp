// SPDX-License-Identifier: Apache-2.0
#include "cli/terminal/progress.h"

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

ProgressStyle progressStyle(bool quiet, bool json) {
    if (quiet) return ProgressStyle::quiet;
    if (json) return ProgressStyle::json;
    const char* terminal = std::getenv("TERM");
    const bool dumb = !terminal || std::string(terminal) == "dumb";
    return isatty(STDERR_FILENO) && !dumb ? ProgressStyle::terminal : ProgressStyle::plain;
}

StatusLine::~StatusLine() {
    if (line_open_) fmt::print(stderr, "\n");
}

bool StatusLine::isDue(double percent) {
    constexpr double kTerminalSeconds = 0.1, kJsonSeconds = 0.5, kPlainPercent = 10.0, kPlainSeconds = 60.0;
    if (style_ == ProgressStyle::quiet) return false;
    const double since = last_percent_ < 0.0 ? kPlainSeconds : secondsSince(last_);
    const bool due = percent >= 100.0 ? last_percent_ < 100.0
                     : style_ == ProgressStyle::plain
                         ? percent - last_percent_ >= kPlainPercent || since >= kPlainSeconds
                         : since >= (style_ == ProgressStyle::json ? kJsonSeconds : kTerminalSeconds);
    if (due) {
        last_ = Clock::now();
        last_percent_ = percent;
    }
    return due;
}

void StatusLine::write(const std::string& json, const std::string& text) {
    if (style_ == ProgressStyle::quiet) return;
    if (style_ == ProgressStyle::json) {
        fmt::print(stderr, "{{{}}}\n", json);
    } else if (style_ == ProgressStyle::plain) {
        fmt::print(stderr, "{}\n", text);
    } else {
        fmt::print(stderr, "\r{}\x1b[K", text);
        std::fflush(stderr);
        line_open_ = true;
    }
}

Progress::Progress(ProgressStyle style, std::uint32_t frames, std::uint32_t warmup_steps,
                   std::uint32_t substeps, std::uint32_t steps_before)
    : line_(style),
      frames_(frames),
      steps_(static_cast<double>(warmup_steps) + static_cast<double>(frames) * substeps),
      steps_before_(steps_before) {}

void Progress::update(std::uint32_t frames_done, std::uint32_t agents, std::uint32_t steps_done) {
    const double percent = steps_ > 0.0 ? std::min(100.0, 100.0 * steps_done / steps_) : 100.0;
    if (!line_.isDue(percent)) return;
    const double speed = (steps_done - steps_before_) / std::max(1.0e-6, line_.elapsed());
    const double left = speed > 0.0 ? (steps_ - steps_done) / speed : 0.0;
    line_.write(fmt::format("\"progress\": {:.1f}, \"frame\": {}, \"frames\": {}, \"agents\": {}, "
                            "\"steps_per_second\": {:.1f}, \"eta_seconds\": {:.1f}",
                            percent, frames_done, frames_, agents, speed, left),
                fmt::format("{:3.0f} %  frame {} of {}  {} people  {:.0f} steps/s  {} left", percent,
                            frames_done, frames_, agents, speed, timeText(left)));
}

}  // namespace throng::cli
