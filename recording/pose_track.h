// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/activities.h"

namespace throng::recording {

inline constexpr double kSwaySeconds = 2.4;  ///< a cycle of those who sing: the same for all

/// What somebody is to do in a frame, as the simulation has it.
struct PoseWish {
    ActivityCode activity = ActivityCode::stands;
    double share = 0.0;    ///< settles: how far up it is, from 0 to 1
    double speed = 0.0;    ///< m/s, of what is shown
    double pace = 0.5;     ///< 0 to 1: how fast it does things, among others
    double seconds = 0.0;  ///< from frame to frame
    bool waits = false;    ///< sings: the next beat has not come
    double lasts = 1.0;    ///< s; rises: up and down
};

/// What somebody is shown to do: what is wished, and what leads from one to the next, at whole and half
/// cycles, so that no pose jumps. Who stands raises its hands first, and lets them down; who sits rises, and
/// sits down. The phase never goes back.
class PoseTrack {
  public:
    /// @param phase cycles: that of the gait, which goes on from where poses end
    void step(const PoseWish& wish, double phase);

    /// Whether there is a pose to show in place of the gait.
    bool isShown() const { return activity_ >= static_cast<std::int32_t>(ActivityCode::sits); }
    ActivityCode activity() const { return static_cast<ActivityCode>(activity_); }
    double phase() const { return phase_; }

  private:
    void set(ActivityCode activity, double phase);
    void settle(double share);
    void goOn(ActivityCode wish, const PoseWish& how);
    void riseOnce(const PoseWish& how);
    void finish(const PoseWish& how, ActivityCode next);
    void swing(ActivityCode wish, const PoseWish& how);

    std::int32_t activity_ = 0;  ///< an ActivityCode; below that of sitting none is shown
    std::int32_t goes_down_ = 0;
    double phase_ = 0.0;
    double share_ = 0.0;
};

}  // namespace throng::recording
