// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace throng::analysis {

/// How often a quantity had which value, in bins of equal width: distances between two of them are exact to a
/// bin.
class Distribution {
  public:
    static constexpr std::size_t kBins = 2000;
    static constexpr double kDrawn = 0.998;

    /// @param limit what is above counts as this much
    explicit Distribution(double limit) : width_(limit / kBins), counts_(kBins, 0) {}

    void add(double value) {
        const double bin = std::clamp(value / width_, 0.0, static_cast<double>(kBins - 1));
        ++counts_[static_cast<std::size_t>(bin)];
        ++count_;
        sum_ += std::clamp(value, 0.0, width_ * kBins);
    }
    std::uint64_t count() const { return count_; }
    double mean() const { return count_ ? sum_ / static_cast<double>(count_) : 0.0; }
    /// The value that so large a share of the samples does not exceed.
    double quantile(double share) const {
        const double wanted = share * static_cast<double>(count_);
        double passed = 0.0;
        for (std::size_t bin = 0; bin < kBins; ++bin) {
            const auto here = static_cast<double>(counts_[bin]);
            if (passed + here >= wanted && here > 0.0)
                return width_ * (static_cast<double>(bin) + (wanted - passed) / here);
            passed += here;
        }
        return 0.0;
    }
    /// (value, share of the samples up to it), where it changes; without the last few of a long tail.
    std::vector<glm::dvec2> shares() const {
        std::vector<glm::dvec2> points;
        std::uint64_t passed = 0;
        for (std::size_t bin = 0; bin < kBins; ++bin) {
            if (counts_[bin] == 0) continue;
            if (points.empty()) points.emplace_back(width_ * static_cast<double>(bin), 0.0);
            if (passed > 0 && static_cast<double>(passed) > kDrawn * static_cast<double>(count_)) break;
            passed += counts_[bin];
            points.emplace_back(width_ * static_cast<double>(bin + 1),
                                static_cast<double>(passed) / static_cast<double>(count_));
        }
        return points;
    }

    /// How far samples of one have to be moved on average to make the other: Wasserstein's distance of order
    /// one, in the quantity's unit.
    friend double meanDistance(const Distribution& a, const Distribution& b) {
        double sum = 0.0;
        compare(a, b, [&](double apart) { sum += apart; });
        return sum * a.width_;
    }
    /// The largest difference between the shares of samples up to any value: Kolmogorov's and Smirnov's, 0
    /// to 1.
    friend double largestDifference(const Distribution& a, const Distribution& b) {
        double most = 0.0;
        compare(a, b, [&](double apart) { most = std::max(most, apart); });
        return most;
    }

  private:
    template <class Visit>
    static void compare(const Distribution& a, const Distribution& b, Visit visit) {
        if (a.count_ == 0 || b.count_ == 0) return;
        std::uint64_t up_to_a = 0, up_to_b = 0;
        for (std::size_t bin = 0; bin < kBins; ++bin) {
            up_to_a += a.counts_[bin];
            up_to_b += b.counts_[bin];
            visit(std::abs(static_cast<double>(up_to_a) / static_cast<double>(a.count_) -
                           static_cast<double>(up_to_b) / static_cast<double>(b.count_)));
        }
    }

    double width_;
    std::vector<std::uint64_t> counts_;
    std::uint64_t count_ = 0;
    double sum_ = 0.0;
};

}  // namespace throng::analysis
