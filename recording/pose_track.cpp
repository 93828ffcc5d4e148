// SPDX-License-Identifier: Apache-2.0
#include "recording/pose_track.h"

#include <algorithm>
#include <cmath>

namespace throng::recording {
namespace {

using Code = ActivityCode;

constexpr double kHair = 1.0e-9;
constexpr double kHalf = 0.5;
constexpr double kRaisesHandsBelow = 0.12;  // m/s: who is slower raises its hands
constexpr double kLowersHandsFrom = 0.35;   // m/s: who is faster has let them down
constexpr double kEndsWithin = 0.4;         // s: a cycle, before something else (with the way down, what
                                     // shaders/behaviour/letting_go.glsl and shaders/seats/in_seat.glsl give)

bool isSeated(Code code) {
    return code >= Code::sits && code <= Code::settles;
}

/// Of what leads from one to the other: there, and back.
bool isWay(Code code) {
    return code == Code::readies || code == Code::rises || code == Code::raises;
}

/// What leads to it; itself where nothing has to.
Code wayTo(Code code) {
    if (code == Code::claps) return Code::readies;
    if (code == Code::cheers || code == Code::sings) return Code::rises;
    return code >= Code::applauds ? Code::raises : code;
}

struct Times {
    double up, down;  // s
};
Times timesOf(Code way) {
    return way == Code::rises ? Times{0.6, 0.8} : Times{0.35, 0.45};
}

/// Cycles/s; those of audiences (authoring/scene/audience.cpp).
double rateOf(Code code, double pace) {
    const auto among = [&](double slowest, double fastest) { return slowest + (fastest - slowest) * pace; };
    switch (code) {
        case Code::sits:
            return among(0.12, 0.2);
        case Code::claps:
        case Code::applauds:
            return among(3.4, 4.6);
        case Code::cheers:
        case Code::jubilates:
            return among(1.3, 1.9);
        case Code::waves:
            return among(0.55, 0.75);
        default:
            return 1.0 / kSwaySeconds;
    }
}

double wholeFrom(double phase) {
    return std::ceil(phase - kHair);
}

}  // namespace

void PoseTrack::set(Code activity, double phase) {
    activity_ = static_cast<std::int32_t>(activity);
    phase_ = phase;
}

/// There and back: up in the first half of a cycle, down in the second.
void PoseTrack::settle(double share) {
    const bool begins = activity() != Code::settles;
    if (begins) goes_down_ = share >= 1.0 ? 1 : 0;
    if (!begins && share != share_) goes_down_ = share < share_ ? 1 : 0;
    share_ = share;
    // The next moment at which it is so far up, or down.
    const double into = goes_down_ ? 1.0 - kHalf * share : kHalf * share;
    set(Code::settles, std::max(phase_, std::ceil(phase_ - into - kHair) + into));
}

void PoseTrack::step(const PoseWish& wish, double phase) {
    const Code wanted = wish.activity;
    const bool was_shown = isShown();
    if (!was_shown) phase_ = std::max(phase_, phase);
    if (wanted == Code::settles) {
        settle(wish.share);
        return;
    }
    const bool walks = wish.speed > (was_shown ? kLowersHandsFrom : kRaisesHandsBelow);
    if (isSeated(wanted)) {
        if (!was_shown || !isSeated(activity()) || activity() == Code::settles) {
            set(Code::sits, wholeFrom(phase_));
            return;
        }
    } else if (walks || (was_shown && isSeated(activity())) || (!was_shown && wanted < Code::applauds)) {
        if (was_shown) phase_ = wholeFrom(phase_);
        activity_ = 0;
        return;
    }
    goOn(wanted, wish);
}

void PoseTrack::goOn(Code wanted, const PoseWish& how) {
    if (wanted == Code::rises) {
        riseOnce(how);
    } else if (!isShown()) {
        set(Code::raises, wholeFrom(phase_));
    } else if (isWay(activity())) {
        swing(wanted, how);
    } else if (activity() != wanted) {
        finish(how, wanted);
    } else {
        phase_ += rateOf(wanted, how.pace) * how.seconds;
    }
}

/// Up and down again, as a wave passes.
void PoseTrack::riseOnce(const PoseWish& how) {
    if (activity() == Code::sits) set(Code::rises, wholeFrom(phase_));
    const double end = std::floor(phase_ + kHair) + 1.0;
    phase_ += how.seconds / how.lasts;
    if (phase_ >= end - kHair) set(Code::sits, end);
}

/// Comes to the end of a cycle, soon; who sways is upright in its middle, too.
void PoseTrack::finish(const PoseWish& how, Code wanted) {
    const bool sways = activity() == Code::sways || activity() == Code::sings;
    const double step = sways ? kHalf : 1.0;
    const double end = step * std::ceil(phase_ / step - kHair);
    const double rate = std::max(rateOf(activity(), how.pace), step / kEndsWithin);
    phase_ += rate * how.seconds;
    if (phase_ < end - kHair) return;
    phase_ = wholeFrom(end);
    if (activity() == Code::sits)
        set(wayTo(wanted), phase_);
    else
        set(wayTo(activity()), phase_ + kHalf);
}

/// On the way to something with one's hands, or back from it.
void PoseTrack::swing(Code wanted, const PoseWish& how) {
    const Code way = activity();
    const double into = phase_ - std::floor(phase_ + kHair);
    const bool on = wayTo(wanted) == way && wanted != way;
    if (!on && into < kHalf - kHair) phase_ = std::floor(phase_ + kHair) + 1.0 - into;  // the same pose
    if (on && into > kHalf + kHair) phase_ = std::floor(phase_) + 2.0 - into;
    const Times times = timesOf(way);
    const double whole = std::floor(phase_ + kHair);
    phase_ += kHalf * how.seconds / (on ? times.up : times.down);
    if (on && how.waits) phase_ = std::min(phase_, whole + kHalf - 2.0 * kHair);
    if (on && phase_ >= whole + kHalf - kHair) {
        set(wanted, whole + 1.0);
    } else if (!on && phase_ >= whole + 1.0 - kHair) {
        phase_ = whole + 1.0;
        if (way == Code::raises)
            activity_ = 0;
        else
            set(Code::sits, phase_);
    }
}

}  // namespace throng::recording
