// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/storeys/charts.h"

namespace throng::authoring {

/// m: the ground that a way speaks of is no further above or below it.
inline constexpr double kNearGround = 1.0;

/// The chart where somebody on `chart` is who has gone straight to a place, over seams as the simulation goes
/// (shaders/charts/cross_seams.comp); nothing where it has left the ground or stepped into a lift.
std::optional<std::uint32_t> chartAfter(const Charts& charts, std::uint32_t chart, glm::dvec2 from,
                                        glm::dvec2 to);

/// The chart at a place that is nearest in height, if it is near enough and no lift.
std::optional<std::uint32_t> chartAtHeight(const Charts& charts, glm::dvec2 place, double height);

/// On which charts the points of given ways lie; tells of ways that leave the ground: beyond it there is
/// nothing, and in the plane perhaps another one.
/// @param begins the chart on which a way of a group begins that tells no height there, if there is one
GivenCharts chartsOfWays(
    const Layout& layout, const Charts& charts,
    const std::function<std::optional<std::uint32_t>(const GivenPeople&, glm::dvec2)>& begins,
    Diagnostics& diagnostics);

}  // namespace throng::authoring
