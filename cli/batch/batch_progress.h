// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "cli/terminal/progress.h"

namespace throng::cli {

/// Tells how far a batch is, as Progress does of a bake.
class BatchProgress {
  public:
    /// @param of all scenarios; @param before done by earlier runs
    BatchProgress(ProgressStyle style, std::size_t of, std::size_t before);
    void update(std::size_t done, std::size_t failed);

  private:
    StatusLine line_;
    std::size_t of_, before_;
};

}  // namespace throng::cli
