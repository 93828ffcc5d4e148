// SPDX-License-Identifier: Apache-2.0
#include "authoring/cli/batch/batch_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace throng::cli {

BatchProgress::BatchProgress(Progress::Style style, std::size_t of, std::size_t before)
    : style_(style), of_(of), before_(before) {}

BatchProgress::~BatchProgress() {
    if (line_open_) fmt::print(stderr, "\n");
}

void BatchProgress::update(std::size_t done, std::size_t failed) {
    if (style_ == Progress::Style::quiet || of_ == 0) return;
    const std::size_t ended = before_ + done + failed;
    const double percent = 100.0 * static_cast<double>(ended) / static_cast<double>(of_);
    const Clock::time_point now = Clock::now();
    const double since = std::chrono::duration<double>(now - last_).count();
    const bool due =
        ended == of_ ||
        (style_ == Progress::Style::plain ? percent - last_percent_ >= 10.0 || since >= 60.0 : since >= 0.2);
    if (!due || (done + failed == 0 && style_ == Progress::Style::plain)) return;
    last_ = now;
    last_percent_ = percent;
    const double elapsed = std::max(1.0e-6, std::chrono::duration<double>(now - start_).count());
    const double speed = static_cast<double>(done + failed) / elapsed;
    const double left = speed > 0.0 ? static_cast<double>(of_ - std::min(of_, ended)) / speed : 0.0;
    if (style_ == Progress::Style::json) {
        fmt::print(stderr,
                   "{{\"progress\": {:.1f}, \"done\": {}, \"failed\": {}, \"scenarios\": {}, "
                   "\"scenarios_per_second\": {:.3g}, "
                   "\"eta_seconds\": {:.1f}}}\n",
                   percent, before_ + done, failed, of_, speed, left);
        return;
    }
    const std::string text =
        fmt::format("{:3.0f} %  {} of {} scenarios{}  {:.3g}/s  {} left", percent, ended, of_,
                    failed ? fmt::format("  {} failed", failed) : "", speed, timeText(left));
    if (style_ == Progress::Style::plain) {
        fmt::print(stderr, "{}\n", text);
        return;
    }
    fmt::print(stderr, "\r{}\x1b[K", text);
    std::fflush(stderr);
    line_open_ = true;
}

}  // namespace throng::cli
