// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/compare/distribution.h"
#include "analysis/compare/trajectories.h"
#include "recording/wall_watch.h"

namespace throng::analysis {

/// Both crowds are looked at so many times a second, whatever their own frame rates are.
inline constexpr double kLooks = 10.0;

struct Box2d {
    glm::dvec2 minimum, maximum;  ///< m
    bool holds(glm::dvec2 p) const {
        return p.x >= minimum.x && p.x <= maximum.x && p.y >= minimum.y && p.y <= maximum.y;
    }
};
Box2d boundsOf(const Trajectories& trajectories);

/// Where to look.
struct ObserveOptions {
    Box2d area;  ///< who is outside is nobody's sample, but a neighbour
    std::optional<std::pair<glm::dvec2, glm::dvec2>> line;
};

/// What is to be seen of a crowd from places alone (docs/measure.md). Metres, seconds, degrees.
struct Observed {
    Distribution speed{4.0}, acceleration{6.0}, turning{360.0}, sway{0.5}, density{12.0}, neighbour{5.0},
        wall{5.0}, time_gap{10.0};
    std::vector<glm::dvec2> speed_by_density;  ///< (persons/m^2, mean m/s), of bins with 20 samples and more
    std::vector<glm::dvec2> passed;            ///< (s since the first, people across the line)
    std::optional<double> flow;                ///< persons/s over the line, from the first to the last
};

/// @param trajectories at kLooks
Observed observe(const Trajectories& trajectories, const ObserveOptions& options, recording::WallWatch& walls,
                 glm::dvec2 walls_origin);

}  // namespace throng::analysis
