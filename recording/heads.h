// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

/// What heads of those who walk and of those who have seats have in common.
namespace throng::recording {

/// What somebody's head does.
struct Attention {
    float yaw = 0.0f;    ///< rad, from the chest to the left
    float pitch = 0.0f;  ///< rad, up
    float weight =
        0.0f;         ///< 0 to 1: how far the head is so turned; with what is left it faces where the hips do
    float at = 0.0f;  ///< what is looked at, as the stream `gaze` tells it
};

/// As the stream `gaze` has it: 0 nothing, -1 where one goes, -2 the first EyeCatcher, -3 the next ...; a row
/// and one more of somebody.
inline constexpr int kLooksAhead = -1, kFirstThing = -2;

inline constexpr double kDegrees = std::numbers::pi / 180.0;
inline constexpr double kMostYaw = 70.0 * kDegrees;    ///< of a head on the chest, to either side
inline constexpr double kMostPitch = 35.0 * kDegrees;  ///< up and down
inline constexpr double kMostLead = 25.0 * kDegrees;   ///< ahead of a turn
inline constexpr double kEyes = 1.6;                   ///< m, over the ground
inline constexpr double kField = 110.0 * kDegrees;     ///< to either side: what heads and eyes reach
inline constexpr double kNoticed = 6.0;                ///< m: who is further away is not looked at

}  // namespace throng::recording
