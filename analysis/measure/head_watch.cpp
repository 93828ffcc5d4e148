// SPDX-License-Identifier: Apache-2.0
#include "analysis/measure/head_watch.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace throng::analysis {
HeadWatch::HeadWatch(io::CrowdReader& crowd)
    : people_(crowd.people()),
      fps_(crowd.bake().fps),
      has_rates_(crowd.streams().has(Stream::attention)),
      has_targets_(crowd.streams().has(Stream::gaze)),
      has_trunks_(crowd.streams().has(Stream::carriage)) {}

/// How the head is on the chest, rad: to the left, and up.
glm::dvec2 HeadWatch::turnOf(const io::CrowdFrame& frame, std::uint32_t row) const {
    const auto head = rowOf(frame[Stream::attention], row);
    const double ahead = has_trunks_ ? -double{rowOf(frame[Stream::carriage], row)[1]} : 0.0;
    return {std::lerp(ahead, double{head[0]}, double{head[2]}), double{head[1]} * double{head[2]}};
}

LooksAt HeadWatch::targetOf(float at, std::uint32_t row) const {
    const auto whole = static_cast<std::int64_t>(at);
    if (whole == 0) return LooksAt::nothing;
    if (whole < 0) return whole == -1 ? LooksAt::way : LooksAt::things;
    const auto other = static_cast<std::size_t>(whole - 1);
    return other < people_.size() && people_[other].party == people_[row].party ? LooksAt::company
                                                                                : LooksAt::people;
}

void HeadWatch::look(const io::CrowdFrame& now, const io::CrowdFrame* before, std::uint32_t row) {
    if (has_rates_ && before) {
        const glm::dvec2 turned = turnOf(now, row) - turnOf(*before, row);
        rates_.add(std::hypot(turned.x, turned.y) * fps_ * 180.0 / std::numbers::pi);
    }
    if (has_targets_) ++frames_[static_cast<std::size_t>(targetOf(rowOf(now[Stream::gaze], row)[2], row))];
}

std::vector<double> HeadWatch::shares() const {
    const auto all = std::accumulate(frames_.begin(), frames_.end(), std::uint64_t{0});
    std::vector<double> found;
    if (has_targets_)
        for (const std::uint64_t each : frames_)
            found.push_back(all ? 100.0 * static_cast<double>(each) / static_cast<double>(all) : 0.0);
    return found;
}

}  // namespace throng::analysis
