// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/batch_progress.h"

#include <fmt/format.h>

#include <algorithm>

namespace throng::cli {

BatchProgress::BatchProgress(ProgressStyle style, std::size_t of, std::size_t before)
    : line_(style), of_(of), before_(before) {}

void BatchProgress::update(std::size_t done, std::size_t failed) {
    if (of_ == 0 || (done + failed == 0 && line_.style() == ProgressStyle::plain)) return;
    const std::size_t ended = before_ + done + failed;
    const double percent = 100.0 * static_cast<double>(ended) / static_cast<double>(of_);
    if (!line_.isDue(percent)) return;
    const double speed = static_cast<double>(done + failed) / std::max(1.0e-6, line_.elapsed());
    const double left = speed > 0.0 ? static_cast<double>(of_ - std::min(of_, ended)) / speed : 0.0;
    line_.write(fmt::format("\"progress\": {:.1f}, \"done\": {}, \"failed\": {}, \"scenarios\": {}, "
                            "\"scenarios_per_second\": {:.3g}, \"eta_seconds\": {:.1f}",
                            percent, before_ + done, failed, of_, speed, left),
                fmt::format("{:3.0f} %  {} of {} scenarios{}  {:.3g}/s  {} left", percent, ended, of_,
                            failed ? fmt::format("  {} failed", failed) : "", speed, timeText(left)));
}

}  // namespace throng::cli
