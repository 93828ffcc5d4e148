// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/surface_edges.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "authoring/storeys/chart_raster.h"

namespace throng::authoring {
namespace {

constexpr double kStraight = 0.03;  // m: points nearer to a straight line are left out
constexpr double kRise = 0.5;       // m: an edge that climbs more is cut into pieces
constexpr double kCorner = 0.4;     // m: corners are put back that are no further away

/// One side of a spot beyond which there is no way on.
struct Side {
    std::uint32_t spot;
    std::size_t side;
};

struct EdgePoint {
    glm::dvec2 at{0.0};
    Side of{};
};

double distanceToLine(glm::dvec2 point, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 way = b - a;
    const double length = glm::length(way);
    if (length < 1.0e-9) return glm::distance(point, a);
    const double along = std::clamp(glm::dot(point - a, way) / (length * length), 0.0, 1.0);
    return glm::distance(point, a + along * way);
}

class Tracer {
  public:
    /// @param whole whether a surface ends at its seams, too
    Tracer(const Walkable& ground, const std::vector<std::uint32_t>& surface_of, bool whole)
        : ground_(ground), surface_of_(surface_of), whole_(whole), traced_(ground.spots().size()) {}

    std::vector<SurfaceEdge> run() {
        for (std::uint32_t spot = 0; spot < ground_.spots().size(); ++spot)
            for (std::size_t side = 0; side < kSides.size(); ++side)
                if (surface_of_[spot] != kNoSpot && isEnd({spot, side}) && !traced_[spot][side])
                    trace({spot, side});
        return std::move(edges_);
    }

  private:
    bool isEnd(const Side& at) const {
        const std::uint32_t next = ground_.spots()[at.spot].next[at.side];
        return next == kNoSpot || (whole_ && surface_of_[next] != surface_of_[at.spot]);
    }

    /// Where the ground ends beside a spot.
    glm::dvec2 placeOf(const Side& at) const {
        const double room = whole_ ? 0.5 * kChartCell : ground_.roomBeside(at.spot, at.side);
        return chartCellMiddle(ground_.spots()[at.spot].cell) + room * glm::dvec2(kSides[at.side]);
    }

    /// The next one along the ground's edge, with the ground on the left: nothing round the axis of a spiral.
    std::optional<Side> after(Side at) const {
        std::size_t ahead = (at.side + 1) % kSides.size();
        std::uint32_t spot = at.spot;
        for (int turns = 0; turns < 5; ++turns) {
            if (isEnd({spot, ahead})) return Side{spot, ahead};
            spot = ground_.spots()[spot].next[ahead];
            ahead = (ahead + kSides.size() - 1) % kSides.size();
        }
        return std::nullopt;
    }

    void trace(const Side& first) {
        std::vector<EdgePoint> loop;
        std::optional<Side> at = first;
        while (at && !traced_[at->spot][at->side]) {
            traced_[at->spot][at->side] = true;
            loop.push_back({placeOf(*at), *at});
            at = after(*at);
        }
        if (at && at->spot == first.spot && at->side == first.side) beginOnStraight(loop);
        if (at)
            loop.push_back(at->spot == first.spot && at->side == first.side ? loop.front()
                                                                            : EdgePoint{placeOf(*at), *at});
        restoreCorners(loop);
        for (std::size_t begin = 0; begin + 1 < loop.size();)
            begin = addEdge(loop, begin);
    }

    /// A closed line may begin anywhere: not at a corner.
    static void beginOnStraight(std::vector<EdgePoint>& loop) {
        for (std::size_t i = 0; i + 3 < loop.size(); ++i) {
            const glm::dvec2 a = loop[i].at, b = loop[i + 1].at, c = loop[i + 2].at, d = loop[i + 3].at;
            if (distanceToLine(b, a, d) > kStraight || distanceToLine(c, a, d) > kStraight) continue;
            std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(i + 1), loop.end());
            return;
        }
    }

    /// Between two straight edges the corner itself is on neither cell's line.
    static void restoreCorners(std::vector<EdgePoint>& loop) {
        std::vector<EdgePoint> whole;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            whole.push_back(loop[i]);
            if (i == 0 || i + 2 >= loop.size()) continue;
            const glm::dvec2 a = loop[i].at, u = a - loop[i - 1].at;
            const glm::dvec2 b = loop[i + 1].at, v = b - loop[i + 2].at;
            const double turn = u.x * v.y - u.y * v.x;
            if (std::abs(turn) < 0.3 * glm::length(u) * glm::length(v)) continue;
            const glm::dvec2 d = b - a;
            const double along = (d.x * v.y - d.y * v.x) / turn, back = (d.x * u.y - d.y * u.x) / turn;
            const glm::dvec2 corner = a + along * u;
            if (along < 0.0 || back < 0.0 || glm::distance(corner, a) > kCorner ||
                glm::distance(corner, b) > kCorner)
                continue;
            whole.push_back({corner, loop[i].of});
        }
        loop = std::move(whole);
    }

    double heightOf(const EdgePoint& point) const { return ground_.spots()[point.of.spot].height; }
    std::uint32_t surfaceOf(const EdgePoint& point) const { return surface_of_[point.of.spot]; }

    /// As much of a loop as is on one surface, and climbs not too much.
    /// @returns the point at which the next edge begins
    std::size_t addEdge(const std::vector<EdgePoint>& loop, std::size_t begin) {
        SurfaceEdge edge;
        edge.surface = surfaceOf(loop[begin]);
        edge.low = edge.high = heightOf(loop[begin]);
        std::size_t end = begin + 1;
        for (;; ++end) {
            const double height = heightOf(loop[end]);
            const double low = std::min(edge.low, height), high = std::max(edge.high, height);
            const bool is_last = end + 1 == loop.size() || surfaceOf(loop[end]) != edge.surface;
            if (is_last || whole_ || high - low <= kRise) {
                edge.low = low;
                edge.high = high;
            }
            if (is_last || (!whole_ && high - low > kRise)) break;
        }
        std::vector<glm::dvec2> points;
        for (std::size_t i = begin; i <= end; ++i)
            points.push_back(loop[i].at);
        // At a seam either side has its own part.
        if (surfaceOf(loop[end]) != edge.surface) {
            const glm::dvec2 seam = seamBetween(loop[end - 1], loop[end]);
            points.back() = seam;
            addStraight(loop[end], seam);
        }
        edge.points = simplified(points);
        if (edge.points.size() > 1) edges_.push_back(std::move(edge));
        return end;
    }

    glm::dvec2 seamBetween(const EdgePoint& a, const EdgePoint& b) const {
        const glm::dvec2 seam = 0.5 * (chartCellMiddle(ground_.spots()[a.of.spot].cell) +
                                       chartCellMiddle(ground_.spots()[b.of.spot].cell));
        const glm::dvec2 way = b.at - a.at;
        const double length = glm::dot(way, way);
        if (length < 1.0e-12) return a.at;
        return a.at + std::clamp(glm::dot(seam - a.at, way) / length, 0.0, 1.0) * way;
    }

    /// From a seam to where the edge of the next surface begins.
    void addStraight(const EdgePoint& to, glm::dvec2 seam) {
        if (glm::distance(seam, to.at) < 1.0e-3) return;
        edges_.push_back({surfaceOf(to), {seam, to.at}, heightOf(to), heightOf(to)});
    }

    /// Douglas and Peucker (1973).
    static std::vector<glm::dvec2> simplified(const std::vector<glm::dvec2>& points) {
        std::vector<bool> kept(points.size(), false);
        kept.front() = kept.back() = true;
        std::vector<std::pair<std::size_t, std::size_t>> parts = {{0, points.size() - 1}};
        while (!parts.empty()) {
            const auto [from, to] = parts.back();
            parts.pop_back();
            std::size_t furthest = from;
            double most = kStraight;
            for (std::size_t i = from + 1; i < to; ++i)
                if (const double away = distanceToLine(points[i], points[from], points[to]); away > most) {
                    most = away;
                    furthest = i;
                }
            if (furthest == from) continue;
            kept[furthest] = true;
            parts.push_back({from, furthest});
            parts.push_back({furthest, to});
        }
        std::vector<glm::dvec2> line;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (kept[i] && (line.empty() || glm::distance(line.back(), points[i]) > 1.0e-3))
                line.push_back(points[i]);
        return line;
    }

    const Walkable& ground_;
    const std::vector<std::uint32_t>& surface_of_;
    bool whole_;
    std::vector<std::array<bool, 4>> traced_;
    std::vector<SurfaceEdge> edges_;
};

}  // namespace

std::vector<SurfaceEdge> edgesOf(const std::vector<Surface>& surfaces) {
    if (surfaces.empty()) return {};
    const Walkable& ground = *surfaces.front().ground;
    std::vector<std::uint32_t> surface_of(ground.spots().size(), kNoSpot);
    for (std::uint32_t surface = 0; surface < surfaces.size(); ++surface)
        for (const std::uint32_t spot : surfaces[surface].spots)
            if (spot != kNoSpot) surface_of[spot] = surface;
    return Tracer(ground, surface_of, false).run();
}

std::vector<glm::dvec2> outlineOf(const Surface& surface) {
    std::vector<std::uint32_t> surface_of(surface.ground->spots().size(), kNoSpot);
    for (const std::uint32_t spot : surface.spots)
        if (spot != kNoSpot) surface_of[spot] = 0;
    std::vector<glm::dvec2> outline;
    double largest = 0.0;
    for (SurfaceEdge& edge : Tracer(*surface.ground, surface_of, true).run()) {
        double twice = 0.0;
        for (std::size_t i = 0; i < edge.points.size(); ++i) {
            const glm::dvec2 a = edge.points[i], b = edge.points[(i + 1) % edge.points.size()];
            twice += a.x * b.y - a.y * b.x;
        }
        if (twice <= largest || edge.points.size() < 4) continue;
        largest = twice;
        outline = std::move(edge.points);
    }
    if (!outline.empty()) outline.pop_back();  // which is the first one
    return outline;
}

}  // namespace throng::authoring
