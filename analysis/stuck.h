// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "analysis/between_rows.h"
#include "base/outcomes.h"
#include "io/crowd_reader.h"

namespace throng::analysis {

/// Neither at a stop nor in a line.
inline bool isUnderWay(const io::CrowdFrame& frame, std::size_t row) {
    constexpr float kAtStop = 1.5f;  // from here on, an activity is one of those who stand
    return frame.isThere(row) && frame.activity(row) < kAtStop;
}

/// Who is stuck when a bake ends (Fate::stuck). Looks at its frames in their order, the last seconds of which
/// matter: who stood at a stop meanwhile has not been held up, nor who waits between rows of seats.
class StuckWatch {
  public:
    explicit StuckWatch(io::CrowdReader& crowd) : rows_(crowd.people()), between_rows_(crowd.bake()) {
        const auto wait = static_cast<std::uint32_t>(kStuckSeconds * crowd.bake().fps);
        if (crowd.frames() > wait) first_ = crowd.frames() - 1 - wait;
    }

    /// From when on frames matter; nothing for bakes that are shorter than anybody can be stuck.
    std::optional<std::uint32_t> firstFrame() const { return first_; }

    void look(const io::CrowdFrame& frame) {
        if (!first_ || frame.index() < *first_) return;
        if (frame.index() == *first_) {
            before_ = frame;
            under_way_.assign(rows_.size(), true);
        }
        for (std::size_t row = 0; row < rows_.size(); ++row)
            under_way_[row] = under_way_[row] && isUnderWay(frame, row) &&
                              !between_rows_.has(frame.place(row), frame.height(row));
        end_ = frame;
    }

    bool isStuck(std::size_t row) const {
        return before_ && !rows_[row].is_given && rows_[row].outcome == wordFor(Fate::walking) &&
               under_way_[row] && glm::distance(before_->place(row), end_->place(row)) < kStuckMetres;
    }

  private:
    const std::vector<io::AgentRow>& rows_;
    BetweenRows between_rows_;
    std::optional<std::uint32_t> first_;
    std::optional<io::CrowdFrame> before_, end_;
    std::vector<bool> under_way_;
};

}  // namespace throng::analysis
