// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "authoring/scene.h"

// Only simulations ask, which do without the library that builds scenes.
namespace throng::authoring {

bool LightPlan::isGreen(double time) const {
    double into = std::fmod(time + offset, cycle);
    if (into < 0.0) into += cycle;
    return std::ranges::any_of(green,
                               [&](const Span& span) { return into >= span.begin && into < span.end; });
}

}  // namespace throng::authoring
