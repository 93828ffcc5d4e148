// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/diagnostics.h"
#include "authoring/storeys/charts.h"

/// What links need at their ends, whether they lead to floors or onto a terrain.
namespace throng::authoring {

inline constexpr double kBeforeDoors = 0.8;  ///< m: what stays free before a lift

/// Whether a wall stands where people step out of a cabin, or off a link.
/// @param at_end of a link: where it ends, and else where it begins
bool standsBefore(const Wall& wall, const Chart& link, bool at_end);

/// Tells of a cabin that has no room for as many as are to ride.
void checkRoomInCabin(const Layout& layout, const Link& lift, Diagnostics& diagnostics);

}  // namespace throng::authoring
