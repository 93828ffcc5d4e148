// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace throng {

/// What a frame says of a lift, and in lifts.npy the last axis.
enum class LiftColumn { height, open, aboard, stop };
inline constexpr std::array<const char*, 4> kLiftColumns = {"height", "open", "aboard", "stop"};
inline constexpr std::size_t kLiftFloats = kLiftColumns.size();

}  // namespace throng
