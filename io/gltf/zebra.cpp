// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/zebra.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace throng::io {
namespace {

using Outline = std::vector<glm::dvec2>;

/// What of an outline is on this side of a line across a direction.
Outline cutAt(const Outline& outline, glm::dvec2 direction, double most) {
    Outline kept;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 here = outline[i], next = outline[(i + 1) % outline.size()];
        const double a = glm::dot(here, direction) - most, b = glm::dot(next, direction) - most;
        if (a <= 0.0) kept.push_back(here);
        if (a * b < 0.0) kept.push_back(glm::mix(here, next, a / (a - b)));
    }
    return kept;
}

}  // namespace

glm::dvec2 wayBeside(std::span<const authoring::Lane> lanes, glm::dvec2 place) {
    double nearest = std::numeric_limits<double>::max();
    glm::dvec2 way(1.0, 0.0);
    for (const authoring::Lane& lane : lanes)
        for (std::size_t i = 1; i < lane.points.size(); ++i) {
            const glm::dvec2 from = lane.points[i - 1], piece = lane.points[i] - from;
            const double length = glm::length(piece);
            if (length <= 0.0) continue;
            const double share = std::clamp(glm::dot(place - from, piece) / (length * length), 0.0, 1.0);
            const double away = glm::distance(place, from + share * piece);
            if (away >= nearest) continue;
            nearest = away;
            way = piece / length;
        }
    return way;
}

std::vector<Outline> zebraStripes(std::span<const glm::dvec2> crossing, glm::dvec2 way, double wide) {
    const glm::dvec2 across(-way.y, way.x);
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const glm::dvec2 point : crossing) {
        low = std::min(low, glm::dot(point, across));
        high = std::max(high, glm::dot(point, across));
    }
    std::vector<Outline> stripes;
    const auto count = static_cast<int>((high - low + 0.5 * wide + 1.0e-6) / (2.0 * wide));
    for (int i = 0; i < count; ++i) {
        const double at = low + (0.5 + 2.0 * i) * wide;
        Outline stripe = cutAt(Outline(crossing.begin(), crossing.end()), across, at + wide);
        stripe = cutAt(stripe, -across, -at);
        if (stripe.size() > 2) stripes.push_back(std::move(stripe));
    }
    return stripes;
}

}  // namespace throng::io
