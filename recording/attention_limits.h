// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

/// What the parts of AttentionTrack share.
namespace throng::recording {

inline constexpr double kDegrees = std::numbers::pi / 180.0;
inline constexpr double kMostYaw = 70.0 * kDegrees;    ///< of a head on the chest, to either side
inline constexpr double kMostPitch = 35.0 * kDegrees;  ///< up and down
inline constexpr double kMostLead = 25.0 * kDegrees;   ///< ahead of a turn
inline constexpr double kEyes = 1.6;                   ///< m, over the ground
inline constexpr double kNoticed = 6.0;                ///< m: who is further away is not looked at

}  // namespace throng::recording
