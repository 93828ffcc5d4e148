// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace throng::recording {

/// A critically damped spring over an interval, exactly: frames may be as long as they like.
/// @param stiffness 1/s; after three to five times its inverse, what is left is not seen
template <class Value>
void approach(Value& value, Value& rate, Value target, float stiffness, float interval) {
    const float decay = std::exp(-stiffness * interval);
    const Value apart = value - target;
    const Value push = rate + stiffness * apart;
    value = target + (apart + push * interval) * decay;
    rate = (rate - stiffness * interval * push) * decay;
}

/// A share from 0 to 1 without a corner at either end.
inline double eased(double share) {
    return share * share * (3.0 - 2.0 * share);
}
/// That of the way of a value from one to another.
inline double easedFrom(double value, double low, double high) {
    return eased(std::clamp((value - low) / (high - low), 0.0, 1.0));
}

}  // namespace throng::recording
