// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

/// What people do, as whole numbers of the first component of the stream of states (docs/bake.md).
namespace throng {

enum class ActivityCode {
    away = 0,
    under_way = 1,
    stands = 2,
    looks = 3,
    queues = 4,
    sits = 5,
    readies = 6,  ///< raises its hands to clap, and lets them down again
    claps = 7,
    rises = 8,  ///< stands up, arms up, and sits down again
    cheers = 9,
    sings = 10,
    settles = 11,  ///< stands up, arms down, and sits down again
    raises = 12,   ///< of who stands: its hands, and lets them down again
    applauds = 13,
    jubilates = 14,
    sways = 15,
    waves = 16,
};

/// Whether a value of that component is of somebody who has a seat: it sits in it, or stands before it.
inline bool hasSeat(float state) {
    return std::floor(state) >= static_cast<float>(ActivityCode::sits) &&
           std::floor(state) <= static_cast<float>(ActivityCode::settles);
}

/// Whether it is of somebody with a pose of its own: in a seat, or with its hands up.
inline bool hasPose(float state) {
    return std::floor(state) >= static_cast<float>(ActivityCode::sits);
}

/// One appearance of somebody in a show, where it has come to its seat, or may have left it.
struct SeatCue {
    double at = 0.0;                              ///< s
    double lasts = 0.0;                           ///< s
    double beat = 0.0;                            ///< s: sings: a moment at which a cycle begins
    ActivityCode activity = ActivityCode::claps;  ///< rises: once up and down, as a wave passes
};

/// Something that somebody does for a while. The phase goes evenly from the one to the other.
struct Deed {
    double begin = 0.0;  ///< s; it ends when the next begins
    ActivityCode activity = ActivityCode::sits;
    double phase = 0.0;  ///< cycles, at its beginning
    double rate = 0.0;   ///< cycles/s
};

}  // namespace throng
