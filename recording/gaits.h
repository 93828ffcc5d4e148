// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

/// How long strides are at what speed, and when they change.
///
/// People who walk faster take longer steps and more of them, both in the same proportion: the ratio of step
/// length to step rate, the walk ratio, stays at about 0.0065 m per step/min over all speeds of free walking
/// (Sekiya, Nagasaki, Ito and Furuna 1996). A stride of two steps is then as long as the root of the speed:
/// 1.249 m at 1 m/s.
///
/// A renderer has clips of a few strides, not of all: the gaits, a fixed ratio apart, each walked with its
/// own stride, so that the phase always follows the way and feet do not slide. Changing the stride would move
/// a planted foot, except where it is under the body: that is where strides change. The rest of the body
/// would jump there, so for some of a cycle the gait before is told, too, and how much of it is left to be
/// shown.
namespace throng::recording {

inline constexpr std::uint32_t kGaits = 6;      ///< clips of a walk; the last one: a run
inline constexpr double kNormalStride = 1.446;  ///< m per cycle of two steps, of an adult at 1.34 m/s
inline constexpr float kGaitInState = 0.0625f;  ///< the stream of states adds gait * this to the activity
inline constexpr float kBeforeInState = kGaitInState / 32.0f;  ///< and of the gait before * this,
inline constexpr float kLeftInState = kBeforeInState / 16.0f;  ///< and of the sixteenths left of it * this
inline constexpr double kGaitsBlendOver = 0.3;                 ///< cycles
inline constexpr double kUnderBody = 0.28;  ///< phase of a foot's own cycle in which it is under the body

/// m per gait cycle (two steps).
double strideOf(std::uint32_t gait);

/// The gait of somebody who walks steadily at this speed, m/s.
std::uint32_t gaitFor(double speed);

std::vector<double> allStrides();

/// What a value of the stream of states holds beside the activity.
struct GaitInState {
    std::uint32_t gait = 0, before = 0;
    double left = 0.0;  ///< of the gait before, from 1 to 0
};
GaitInState gaitsOf(float state);
inline std::uint32_t gaitOf(float state) {
    return gaitsOf(state).gait;
}

/// The gait of one person over time.
struct GaitTrack {
    static constexpr double kLongAgo = -1.0e9;

    double phase = 0.0;  ///< cycles, unwrapped
    std::uint32_t gait = 0;
    std::uint32_t before = 0;   ///< the gait before
    double changed = kLongAgo;  ///< phase at which it ended
    double stood = 0.0;         ///< s, up to now

    /// How much of the gait before is left to be shown, from 1 to 0.
    double left() const;
    /// What the stream of states has of all this: less than 1.
    float inState() const;
    /// Walks on by `way` m in so many seconds. Where the stride changes, the way is shared out between the
    /// two.
    void advance(double way, double seconds);
};

}  // namespace throng::recording
