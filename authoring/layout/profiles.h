// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "authoring/layout.h"

namespace throng::authoring {

/// A kind of people that layouts may name.
struct Profile {
    std::string_view name;
    PersonSettings settings;
};

/// Speeds: free walking of adults (Weidmann 1993), of children of seven years (Sutherland et al. 1980), of
/// people over 65 (Knoblauch, Pietrucha and Nitzburg 1996; the deviation is that between its mean and its
/// 15th percentile), and joggers (the mean of Novacheck 1998; the deviation is ours). Radii are half the
/// shoulder breadth. Reactions to being told to leave: IMO MSC.1/Circ.1533, the day case (the logarithm of
/// the seconds has mean 3.44 and deviation 0.94, at most 300 s); runners who wait for the start: ours.
inline constexpr Distribution kDayReaction{Distribution::Kind::log_normal, 3.44, 0.94, 0.0, 300.0};

inline const std::array<Profile, 4> kProfiles = {{
    {"adult", {.reaction = kDayReaction}},
    {"child",
     {.speed = {Distribution::Kind::normal, 1.14, 0.17, 0.63, 1.65},
      .radius = {Distribution::Kind::uniform, 0.175, 0.0, 0.15, 0.2},
      .reaction = kDayReaction}},
    {"elderly", {.speed = {Distribution::Kind::normal, 1.25, 0.27, 0.44, 2.06}, .reaction = kDayReaction}},
    {"runner",
     {.speed = {Distribution::Kind::normal, 3.2, 0.4, 2.0, 4.4},
      .reaction = {Distribution::Kind::uniform, 0.35, 0.0, 0.2, 0.5}}},
}};

}  // namespace throng::authoring
