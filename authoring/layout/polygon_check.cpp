// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/polygon_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace throng::authoring {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// Where two segments meet, ends included; for overlapping ones, an end that lies on the other.
std::optional<glm::dvec2> meeting(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
    const glm::dvec2 first = b - a;
    const glm::dvec2 second = d - c;
    const double turn = cross(first, second);
    if (turn != 0.0) {
        const double on_first = cross(c - a, second) / turn;
        const double on_second = cross(c - a, first) / turn;
        if (on_first < 0.0 || on_first > 1.0 || on_second < 0.0 || on_second > 1.0) return std::nullopt;
        return a + on_first * first;
    }
    if (cross(c - a, first) != 0.0) return std::nullopt;  // parallel, apart
    const auto within = [](glm::dvec2 p, glm::dvec2 q, glm::dvec2 r) {
        return std::min(q.x, r.x) <= p.x && p.x <= std::max(q.x, r.x) && std::min(q.y, r.y) <= p.y &&
               p.y <= std::max(q.y, r.y);
    };
    for (const glm::dvec2 end : {c, d})
        if (within(end, a, b)) return end;
    if (within(a, c, d)) return a;
    return std::nullopt;
}

/// Two segments that cross within both of them.
bool isCrossing(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
    return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

/// Whether the outline runs back over itself at a point, or stays there.
bool isSpike(glm::dvec2 before, glm::dvec2 point, glm::dvec2 after) {
    const glm::dvec2 incoming = point - before, outgoing = after - point;
    return incoming == glm::dvec2(0.0) ||
           (cross(incoming, outgoing) == 0.0 && incoming.x * outgoing.x + incoming.y * outgoing.y <= 0.0);
}

}  // namespace

double signedArea(const std::vector<glm::dvec2>& polygon) {
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t next = (i + 1) % polygon.size();
        twice += cross(polygon[i] - polygon[0], polygon[next] - polygon[0]);
    }
    return 0.5 * twice;
}

std::size_t removeSpikes(std::vector<glm::dvec2>& polygon) {
    const std::size_t before = polygon.size();
    for (std::size_t i = 0; i < polygon.size() && polygon.size() >= 3;) {
        const std::size_t count = polygon.size();
        if (isSpike(polygon[(i + count - 1) % count], polygon[i], polygon[(i + 1) % count])) {
            polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
            i = i > 0 ? i - 1 : 0;  // the points before it may be one now
        } else {
            ++i;
        }
    }
    return before - polygon.size();
}

std::optional<Crossing> selfCrossing(const std::vector<glm::dvec2>& polygon, bool touching_counts) {
    const std::size_t count = polygon.size();
    const auto end = [&](std::size_t edge) { return polygon[(edge + 1) % count]; };
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::min(polygon[a].x, end(a).x) < std::min(polygon[b].x, end(b).x);
    });
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t edge = order[i];
        const double right = std::max(polygon[edge].x, end(edge).x);
        for (std::size_t j = i + 1; j < count; ++j) {
            const std::size_t other = order[j];
            if (std::min(polygon[other].x, end(other).x) > right) break;
            if (!touching_counts && !isCrossing(polygon[edge], end(edge), polygon[other], end(other)))
                continue;
            const bool adjacent = (edge + 1) % count == other || (other + 1) % count == edge;
            if (adjacent && count > 3) {
                // Neighbours share a point; they are wrong only when one runs back over the other.
                const std::size_t first = (edge + 1) % count == other ? edge : other;
                const glm::dvec2 incoming = end(first) - polygon[first];
                const glm::dvec2 outgoing = end((first + 1) % count) - end(first);
                if (cross(incoming, outgoing) != 0.0 ||
                    incoming.x * outgoing.x + incoming.y * outgoing.y > 0.0)
                    continue;
                return Crossing{end(first), std::min(edge, other), std::max(edge, other)};
            }
            if (adjacent) continue;
            if (const auto point = meeting(polygon[edge], end(edge), polygon[other], end(other)))
                return Crossing{*point, std::min(edge, other), std::max(edge, other)};
        }
    }
    return std::nullopt;
}

void checkPolygon(std::vector<glm::dvec2>& polygon, const JsonNode* node, Diagnostics& diagnostics) {
    if (!node || polygon.size() < 3) return;
    if (polygon.front() == polygon.back()) polygon.pop_back();
    if (const auto crossing = selfCrossing(polygon))
        diagnostics.error(
            node->where,
            fmt::format("the polygon crosses itself at [{:.6g}, {:.6g}] (edges {} and {})", crossing->point.x,
                        crossing->point.y, crossing->first_edge, crossing->second_edge),
            "reorder its points so that they run once round the outline");
    else if (std::abs(signedArea(polygon)) < 1.0e-6)
        diagnostics.error(node->where, "the polygon has no area");
}

}  // namespace throng::authoring
