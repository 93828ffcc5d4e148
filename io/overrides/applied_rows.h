// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "io/overrides/layered_crowd.h"

namespace throng::io {

inline constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

/// A row that changes, and what came of it.
struct ChangedRow {
    std::uint32_t row = 0;
    std::uint32_t first_alive = kNever;  ///< in the new bake
    glm::vec2 place{0.0f};               ///< m, in the frame before
    bool is_held = false;                ///< it stands where the bake has no frames for it
};

/// Writes into the crowd's table what has been done to a row: looks, goal, when it comes and goes.
void writeAppliedRow(LayeredCrowd& crowd, const ChangedRow& each);

}  // namespace throng::io
