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

}  // namespace throng::authoring
