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
/// a planted foot, except where it is under the body: that is where strides change.
namespace throng::recording {

inline constexpr std::uint32_t kGaits = 6;      ///< clips of a walk; the last one: a run
inline constexpr float kGaitInState = 0.0625f;  ///< the stream of states adds gait * this to the activity
inline constexpr double kUnderBody = 0.28;      ///< phase of a foot's own cycle in which it is under the body

/// m per gait cycle (two steps).
double strideOf(std::uint32_t gait);

/// The gait of somebody who walks steadily at this speed, m/s.
std::uint32_t gaitFor(double speed);

std::vector<double> allStrides();

/// The gait that a value of the stream of states holds beside the activity.
std::uint32_t gaitOf(float state);

/// The gait of one person over time.
struct GaitTrack {
    double phase = 0.0;  ///< cycles, unwrapped
    std::uint32_t gait = 0;

    /// Walks on by `way` m at `speed` m/s. Where the stride changes, the way is shared out between the two.
    void advance(double way, double speed);
};

}  // namespace throng::recording
