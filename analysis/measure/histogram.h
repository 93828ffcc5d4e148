// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace throng::analysis {

/// Percentiles of millions of samples in little memory: bins of equal width, and the exact largest value.
class Histogram {
  public:
    /// @param limit samples above share the last bin
    Histogram(double limit, std::size_t bins)
        : width_(limit / static_cast<double>(bins)), counts_(bins + 1) {}

    void add(double value) {
        const double bin = std::max(0.0, value) / width_;
        ++counts_[bin < static_cast<double>(counts_.size() - 1) ? static_cast<std::size_t>(bin)
                                                                : counts_.size() - 1];
        ++total_;
        worst_ = std::max(worst_, value);
    }
    std::uint64_t count() const { return total_; }
    double worst() const { return worst_; }
    /// To within one bin's width; the worst value where the share falls into the last bin.
    double percentile(double share) const {
        const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(total_)));
        std::uint64_t passed = 0;
        for (std::size_t bin = 0; bin + 1 < counts_.size(); ++bin) {
            passed += counts_[bin];
            if (passed >= rank && passed > 0)
                return std::min(worst_, width_ * (static_cast<double>(bin) + 0.5));
        }
        return worst_;
    }

  private:
    double width_;
    std::vector<std::uint64_t> counts_;
    std::uint64_t total_ = 0;
    double worst_ = 0.0;
};

}  // namespace throng::analysis
