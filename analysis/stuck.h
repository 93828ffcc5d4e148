// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/geometric.hpp>

#include "base/outcomes.h"
#include "io/crowd_reader.h"

namespace throng::analysis {

/// Who walks, is neither at a stop nor in a line, and does not get on (Fate::stuck).
/// @param before kStuckSeconds before the bake's last frame, which `end` is
inline bool isStuck(const io::AgentRow& agent, const io::CrowdFrame& before, const io::CrowdFrame& end,
                    std::size_t row) {
    constexpr float kAtStop = 1.5f;  // from here on, an activity is one of those who stand
    return agent.outcome == wordFor(Fate::walking) && before.isThere(row) && end.isThere(row) &&
           end.activity(row) < kAtStop && glm::distance(before.place(row), end.place(row)) < kStuckMetres;
}

}  // namespace throng::analysis
