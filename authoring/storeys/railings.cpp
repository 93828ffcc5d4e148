// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/railings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace throng::authoring {
namespace {

constexpr double kSample = 0.1;   // m
constexpr double kBeyond = 0.02;  // m: beyond an edge
constexpr double kPiece = 1.0;    // m: railings of links go up in pieces

using Test = std::function<bool(double)>;

/// Where along a segment (0 to 1) a test holds, exact to a millimetre.
std::vector<std::pair<double, double>> intervalsWhere(double length, const Test& holds) {
    const int count = std::max(1, static_cast<int>(std::ceil(length / kSample)));
    const auto edgeBetween = [&](double before, double after, bool first) {
        while ((after - before) * length > 1.0e-3) {
            const double middle = 0.5 * (before + after);
            (holds(middle) == first ? before : after) = middle;
        }
        return 0.5 * (before + after);
    };
    std::vector<std::pair<double, double>> found;
    // The middles of pieces: at corners it is rounding that decides.
    double last = 0.0;
    bool held = false;
    for (int i = 0; i < count; ++i) {
        const double here = (i + 0.5) / count;
        const bool holds_here = holds(here);
        if (holds_here && (i == 0 || !held))
            found.emplace_back(i == 0 ? 0.0 : edgeBetween(last, here, false), 1.0);
        if (!holds_here && i > 0 && held) found.back().second = edgeBetween(last, here, true);
        held = holds_here;
        last = here;
    }
    return found;
}

/// A railing stands on an edge where there is ground on its one side and no way on over the other.
/// @param outward unit vector
void addRailings(const std::vector<Chart>& charts, std::size_t index, glm::dvec2 a, glm::dvec2 b,
                 glm::dvec2 outward, std::vector<Railing>& railings) {
    const Chart& chart = charts[index];
    const auto is_needed = [&](double along) {
        const glm::dvec2 at = glm::mix(a, b, along);
        const glm::dvec2 within = at - kBeyond * outward, beyond = at + kBeyond * outward;
        if (!chart.contains(within) || chart.contains(beyond)) return false;
        for (std::size_t other = 0; other < charts.size(); ++other)
            if (other != index && charts[other].contains(beyond) &&
                areJoined(chart, index, within, charts[other], other, beyond))
                return false;
        return true;
    };
    for (const auto& [from, to] : intervalsWhere(glm::distance(a, b), is_needed)) {
        const glm::dvec2 first = glm::mix(a, b, from), last = glm::mix(a, b, to);
        const int pieces =
            chart.is_link ? std::max(1, static_cast<int>(std::ceil(glm::distance(first, last) / kPiece))) : 1;
        for (int i = 0; i < pieces; ++i) {
            Railing railing;
            railing.points = {glm::mix(first, last, double(i) / pieces),
                              glm::mix(first, last, double(i + 1) / pieces)};
            const double heights[] = {chart.heightAt(railing.points[0]), chart.heightAt(railing.points[1])};
            railing.low = std::min(heights[0], heights[1]);
            railing.high = std::max(heights[0], heights[1]);
            railings.push_back(std::move(railing));
        }
    }
}

/// Both sides of each edge are tried: outlines run either way.
void addAlong(const std::vector<Chart>& charts, std::size_t index, const std::vector<glm::dvec2>& outline,
              std::vector<Railing>& railings) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
        const glm::dvec2 along = glm::normalize(b - a);
        const glm::dvec2 left(-along.y, along.x);
        addRailings(charts, index, a, b, left, railings);
        addRailings(charts, index, a, b, -left, railings);
    }
}

}  // namespace

std::vector<Railing> railingsOf(const std::vector<Chart>& charts, std::size_t index) {
    const Chart& chart = charts[index];
    std::vector<Railing> railings;
    if (chart.is_link) {
        addAlong(charts, index, chart.link.outline(0.0, chart.link.length), railings);
        return railings;
    }
    addAlong(charts, index, chart.floor, railings);
    for (const std::vector<glm::dvec2>& opening : chart.openings)
        addAlong(charts, index, opening, railings);
    return railings;
}

std::vector<std::vector<glm::dvec2>> partsInMargin(const Chart& chart, const ChartRaster& raster,
                                                   std::size_t owner, const std::vector<glm::dvec2>& line,
                                                   double half_thickness) {
    const auto is_near = [&](glm::dvec2 point) {
        if (chart.contains(point)) return false;
        const int cells = 1 + static_cast<int>(std::ceil(half_thickness / kChartCell));
        const glm::ivec2 cell = chartCellOf(point);
        for (int dy = -cells; dy <= cells; ++dy)
            for (int dx = -cells; dx <= cells; ++dx)
                if (raster.ownerAt(cell + glm::ivec2(dx, dy)) == owner) return true;
        return false;
    };
    std::vector<std::vector<glm::dvec2>> parts;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 a = line[i], b = line[i + 1];
        for (const auto& [from, to] : intervalsWhere(
                 glm::distance(a, b), [&](double along) { return is_near(glm::mix(a, b, along)); })) {
            const glm::dvec2 first = glm::mix(a, b, from), last = glm::mix(a, b, to);
            if (!parts.empty() && parts.back().back() == first)
                parts.back().push_back(last);
            else
                parts.push_back({first, last});
        }
    }
    return parts;
}

}  // namespace throng::authoring
