// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace throng::analysis {

/// Of as many values as are added; of none, 0.
class Mean {
  public:
    void add(double value) {
        sum_ += value;
        ++count_;
    }
    std::uint64_t count() const { return count_; }
    double value() const { return count_ ? sum_ / static_cast<double>(count_) : 0.0; }

  private:
    double sum_ = 0.0;
    std::uint64_t count_ = 0;
};

}  // namespace throng::analysis
