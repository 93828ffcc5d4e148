// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "analysis/measure/histogram.h"
#include "io/crowd_reader.h"

namespace throng::analysis {

/// What people look at, of bakes that tell it (the streams `gaze` and `attention`).
enum class LooksAt { way, company, people, things, nothing };
inline constexpr std::array<std::string_view, 5> kLooksAt{"way", "company", "people", "things", "nothing"};

/// How fast heads turn on their chests, and what people look at, from the files of a bake.
class HeadWatch {
  public:
    explicit HeadWatch(io::CrowdReader& crowd);

    /// Whether the bake tells anything of heads.
    bool empty() const { return !has_rates_ && !has_targets_; }
    /// Somebody who has no seat and is there in a frame. @param before the frame before, where it was there,
    /// too
    void look(const io::CrowdFrame& now, const io::CrowdFrame* before, std::uint32_t row);

    bool hasRates() const { return has_rates_; }
    /// deg/s
    const Histogram& rates() const { return rates_; }
    /// Percent of the time of all, by LooksAt; empty where the bake does not tell.
    std::vector<double> shares() const;

  private:
    glm::dvec2 turnOf(const io::CrowdFrame& frame, std::uint32_t row) const;
    LooksAt targetOf(float at, std::uint32_t row) const;

    const std::vector<io::AgentRow>& people_;
    double fps_;
    bool has_rates_, has_targets_, has_trunks_;
    Histogram rates_{1800.0, 3600};
    std::array<std::uint64_t, kLooksAt.size()> frames_{};
};

}  // namespace throng::analysis
