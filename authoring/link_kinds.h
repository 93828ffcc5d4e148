// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "authoring/layout.h"

namespace throng::authoring {

/// What links can be, as layouts and bake.json call it.
inline constexpr std::array<std::pair<std::string_view, Link::Kind>, 5> kLinkKinds = {
    {{"stairs", Link::Kind::stairs},
     {"ramp", Link::Kind::ramp},
     {"escalator", Link::Kind::escalator},
     {"travelator", Link::Kind::travelator},
     {"lift", Link::Kind::lift}}};

/// m: railings stand on the outer side of what they bound.
inline constexpr double kRailing = 0.1;
/// m: shoulders reach so far over either side of the steps of an escalator, below its handrails.
inline constexpr double kBesideSteps = 0.1;

/// m: from the middle of a link to its outer side.
inline double halfWidthOf(const Link& link) {
    return 0.5 * (link.width + kRailing) + (link.moves() ? kBesideSteps : 0.0);
}

}  // namespace throng::authoring
