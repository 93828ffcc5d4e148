// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace throng::recording {

/// An angle of a head, on its way.
struct HeadTurn {
    float angle = 0.0f, rate = 0.0f, acceleration = 0.0f;  ///< rad, rad/s, rad/s^2
};

/// s: as long as heads take to turn by so many radians. The larger the turn, the faster and the longer it is
/// (the main sequence of head movements: Zangemeister, Lehman and Stark 1981). From rest to rest the
/// smoothest way is fastest in its middle, 1.875 times its mean: 87 deg/s in turns of 20 degrees, 153 in
/// those of 60, 196 in those of 140, which is from one shoulder to the other. People in motion were measured
/// to turn their heads by at most 185 deg/s (Pozzo, Berthoz and Lefort 1989).
inline double secondsToTurn(double amplitude) {
    constexpr double kLeast = 0.28, kPerRadian = 0.433;
    return kLeast + kPerRadian * amplitude;
}

/// Goes on for an interval along the smoothest way (of the least jerk: Flash and Hogan 1985) from how the
/// head turns now to where a target will be. The way is found anew in every frame, so targets may move
/// (Hoff and Arbib 1993).
/// @param rate rad/s, of the target; @param left s, until the head is there
inline void turnTowards(HeadTurn& turn, double target, double rate, double left, double interval) {
    const double x = turn.angle, v = turn.rate, a = turn.acceleration, t = std::min(interval, left);
    const double way = target + rate * left - x, square = left * left, cube = square * left;
    const double c3 = (20.0 * way - (8.0 * rate + 12.0 * v) * left - 3.0 * a * square) / (2.0 * cube);
    const double c4 =
        (-30.0 * way + (14.0 * rate + 16.0 * v) * left + 3.0 * a * square) / (2.0 * cube * left);
    const double c5 = (12.0 * way - 6.0 * (rate + v) * left - a * square) / (2.0 * cube * square);
    turn.angle = static_cast<float>(x + t * (v + t * (0.5 * a + t * (c3 + t * (c4 + t * c5)))));
    turn.rate = static_cast<float>(v + t * (a + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5))));
    turn.acceleration = static_cast<float>(a + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5)));
}

}  // namespace throng::recording
