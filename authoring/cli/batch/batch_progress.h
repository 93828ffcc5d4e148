// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>

#include "authoring/cli/progress.h"

namespace throng::cli {

/// Tells how far a batch is, as Progress does of a bake.
class BatchProgress {
  public:
    /// @param of all scenarios; @param before done by earlier runs
    BatchProgress(Progress::Style style, std::size_t of, std::size_t before);
    ~BatchProgress();
    void update(std::size_t done, std::size_t failed);

  private:
    using Clock = std::chrono::steady_clock;
    Progress::Style style_;
    std::size_t of_, before_;
    Clock::time_point start_ = Clock::now(), last_ = {};
    double last_percent_ = -100.0;
    bool line_open_ = false;
};

}  // namespace throng::cli
