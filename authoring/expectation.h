// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace throng::authoring {

/// A bar that a layout sets itself: what `throng measure` finds has to lie within.
struct Expectation {
    std::string figure;
    std::optional<double> minimum;
    std::optional<double> maximum;
};

/// What bars may be set on. `arrived`, `stuck` and `refused` are shares of all people.
inline constexpr std::array<std::string_view, 18> kExpectableFigures = {"arrived",
                                                                        "stuck",
                                                                        "refused",
                                                                        "seconds",
                                                                        "overlapping_percent",
                                                                        "deepest_overlap_percent",
                                                                        "wall_crossings",
                                                                        "deepest_wall_penetration",
                                                                        "time_ratio",
                                                                        "detour_ratio",
                                                                        "heading_rate_p99",
                                                                        "acceleration_p99",
                                                                        "backward_percent",
                                                                        "effort",
                                                                        "lane_order",
                                                                        "mean_speed",
                                                                        "high_density",
                                                                        "flow"};

}  // namespace throng::authoring
