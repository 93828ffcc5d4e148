// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/chart_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "authoring/storeys/cabin.h"

namespace throng::authoring {
namespace {

constexpr double kTread = 0.17;  // m: about as high
constexpr double kSlab = 0.25;   // m: as thick
constexpr double kAhead = 1.0;   // m: as far as feet step over a seam before they are on the other chart

class MeshMaker {
  public:
    explicit MeshMaker(glm::dvec3 shift = glm::dvec3(0.0)) : shift_(shift) {}

    /// Corners counter-clockwise as seen from the side that the normal points to.
    void add(const std::array<glm::dvec3, 4>& corners) {
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[3] - corners[0]) +
                                  glm::cross(corners[3] - corners[2], corners[1] - corners[2]);
        const double size = glm::length(normal);
        if (size < 1.0e-12) return;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::dvec3& corner : corners) {
            mesh.positions.push_back(corner + shift_);
            mesh.normals.emplace_back(normal / size);
        }
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
            mesh.indices.push_back(first + corner);
    }
    void moveTo(glm::dvec2 shift) { shift_ = {shift, 0.0}; }

    TerrainMesh mesh;

  private:
    glm::dvec3 shift_;
};

/// One strip of a floor between two edges, from a lower to an upper ordinate.
struct Trapezoid {
    double y0, y1;
    double left0, right0, left1, right1;
};

void addCrossings(const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b,
                  std::vector<double>& heights) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) {
            const glm::dvec2 p = a[i], r = a[(i + 1) % a.size()] - p;
            const glm::dvec2 q = b[j], s = b[(j + 1) % b.size()] - q;
            const double turn = r.x * s.y - r.y * s.x;
            if (std::abs(turn) < 1.0e-12) continue;
            const glm::dvec2 d = q - p;
            const double t = (d.x * s.y - d.y * s.x) / turn, u = (d.x * r.y - d.y * r.x) / turn;
            if (t >= 0.0 && t <= 1.0 && u >= 0.0 && u <= 1.0) heights.push_back(p.y + t * r.y);
        }
}

/// A floor without its openings as trapezoids: cut at the ordinates of all corners and crossings, nothing
/// changes between two of them but along straight edges.
std::vector<Trapezoid> trapezoidsOf(const Chart& chart) {
    std::vector<const std::vector<glm::dvec2>*> outlines = {&chart.floor};
    for (const auto& opening : chart.openings)
        outlines.push_back(&opening);
    std::vector<double> heights;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        for (const glm::dvec2 corner : *outlines[i])
            heights.push_back(corner.y);
        for (std::size_t j = 0; j < i; ++j)
            addCrossings(*outlines[i], *outlines[j], heights);
    }
    std::sort(heights.begin(), heights.end());
    std::vector<Trapezoid> found;
    struct Crossing {
        double middle, lower, upper;
    };
    for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
        const double y0 = heights[i], y1 = heights[i + 1], middle = 0.5 * (y0 + y1);
        if (y1 - y0 < 1.0e-9) continue;
        std::vector<Crossing> crossings;
        for (const auto* outline : outlines)
            for (std::size_t k = 0; k < outline->size(); ++k) {
                const glm::dvec2 a = (*outline)[k], b = (*outline)[(k + 1) % outline->size()];
                if ((a.y > middle) == (b.y > middle)) continue;
                const auto at = [&](double y) { return a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y); };
                crossings.push_back({at(middle), at(y0), at(y1)});
            }
        std::sort(crossings.begin(), crossings.end(),
                  [](const Crossing& a, const Crossing& b) { return a.middle < b.middle; });
        for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
            const Crossing &left = crossings[k], &right = crossings[k + 1];
            if (right.middle - left.middle < 1.0e-9) continue;
            if (!chart.contains({0.5 * (left.middle + right.middle), middle})) continue;
            found.push_back({y0, y1, left.lower, right.lower, left.upper, right.upper});
        }
    }
    return found;
}

using Box = std::pair<glm::dvec2, glm::dvec2>;

/// What of a trapezoid is within a box, near enough: slanted edges are bent at the box's sides.
Trapezoid clipped(const Trapezoid& t, const Box& box) {
    const double y0 = std::max(t.y0, box.first.y), y1 = std::min(t.y1, box.second.y);
    const auto at = [&](double lower, double upper, double y) {
        return std::clamp(lower + (upper - lower) * (y - t.y0) / (t.y1 - t.y0), box.first.x, box.second.x);
    };
    return {y0,
            y1,
            at(t.left0, t.left1, y0),
            at(t.right0, t.right1, y0),
            at(t.left0, t.left1, y1),
            at(t.right0, t.right1, y1)};
}

void addFloor(const Chart& chart, const Box& box, MeshMaker& maker) {
    const double z = chart.height;
    for (const Trapezoid& whole : trapezoidsOf(chart)) {
        const Trapezoid t = clipped(whole, box);
        if (t.y1 <= t.y0) continue;
        maker.add({glm::dvec3(t.left0, t.y0, z), glm::dvec3(t.right0, t.y0, z), glm::dvec3(t.right1, t.y1, z),
                   glm::dvec3(t.left1, t.y1, z)});
    }
}

/// The underside, and the sides all round.
void addSlab(const Chart& chart, MeshMaker& maker) {
    const double z = chart.height - kSlab;
    for (const Trapezoid& t : trapezoidsOf(chart))
        maker.add({glm::dvec3(t.left0, t.y0, z), glm::dvec3(t.left1, t.y1, z), glm::dvec3(t.right1, t.y1, z),
                   glm::dvec3(t.right0, t.y0, z)});
    const auto side = [&](const std::vector<glm::dvec2>& outline) {
        for (std::size_t i = 0; i < outline.size(); ++i) {
            glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
            const glm::dvec2 along = glm::normalize(b - a), middle = 0.5 * (a + b);
            const glm::dvec2 left = 0.01 * glm::dvec2(-along.y, along.x);
            const bool has_left = chart.contains(middle + left), has_right = chart.contains(middle - left);
            if (has_left == has_right) continue;
            if (has_right) std::swap(a, b);  // the ground is on the left of a to b
            maker.add({glm::dvec3(a, z), glm::dvec3(b, z), glm::dvec3(b, chart.height),
                       glm::dvec3(a, chart.height)});
        }
    };
    side(chart.floor);
    for (const auto& opening : chart.openings)
        side(opening);
}

/// The treads of a link between two distances along it; ramps are one.
void addTreads(const Chart& chart, std::size_t treads, double from, double to, bool risers,
               MeshMaker& maker) {
    const Footprint& link = chart.link;
    const double half = link.half_width;
    const auto quad = [&](double t0, double z0, double t1, double z1) {
        maker.add({glm::dvec3(link.at(t0, -half), z0), glm::dvec3(link.at(t1, -half), z1),
                   glm::dvec3(link.at(t1, half), z1), glm::dvec3(link.at(t0, half), z0)});
    };
    if (treads == 0) return quad(from, link.heightAt(from), to, link.heightAt(to));
    const bool up = link.high > link.low;
    const double run = link.length / static_cast<double>(treads);
    for (std::size_t i = 0; i < treads; ++i) {
        const double t0 = run * static_cast<double>(i), t1 = t0 + run;
        if (t1 <= from || t0 >= to) continue;
        // A tread is as high as its end that is further up.
        const double z = link.heightAt(up ? t1 : t0);
        quad(std::max(t0, from), z, std::min(t1, to), z);
        if (!risers) continue;
        const double before = link.heightAt(up ? t0 : t0 - run);
        if (up || i > 0) quad(t0, before, t0, z);
        if (!up && i + 1 == treads) quad(t1, z, t1, link.heightAt(t1));
    }
}

void addLink(const Chart& chart, std::size_t treads, MeshMaker& maker) {
    const Footprint& link = chart.link;
    const double half = link.half_width;
    addTreads(chart, treads, 0.0, link.length, true, maker);
    const auto below = [&](double t, double aside) {
        return glm::dvec3(link.at(t, aside), link.heightAt(t) - kSlab);
    };
    maker.add({below(0.0, half), below(link.length, half), below(link.length, -half), below(0.0, -half)});
    for (const double side : {-half, half}) {
        const auto above = [&](double t) {
            return glm::dvec3(link.at(t, side), link.heightAt(t) + 0.5 * kTread);
        };
        std::array<glm::dvec3, 4> cheek = {below(0.0, side), below(link.length, side), above(link.length),
                                           above(0.0)};
        if (side > 0.0) std::swap(cheek[1], cheek[3]);
        maker.add(cheek);
    }
}

/// An upright or lying bar, along the axes.
void addBar(glm::dvec3 low, glm::dvec3 high, const Footprint& link, MeshMaker& maker) {
    const auto at = [&](double x, double y, double z) { return glm::dvec3(link.at(x, y), z); };
    const glm::dvec3 a = low, b = high;
    maker.add({at(a.x, a.y, a.z), at(a.x, b.y, a.z), at(b.x, b.y, a.z), at(b.x, a.y, a.z)});
    maker.add({at(a.x, a.y, b.z), at(b.x, a.y, b.z), at(b.x, b.y, b.z), at(a.x, b.y, b.z)});
    maker.add({at(a.x, a.y, a.z), at(b.x, a.y, a.z), at(b.x, a.y, b.z), at(a.x, a.y, b.z)});
    maker.add({at(b.x, b.y, a.z), at(a.x, b.y, a.z), at(a.x, b.y, b.z), at(b.x, b.y, b.z)});
    maker.add({at(a.x, b.y, a.z), at(a.x, a.y, a.z), at(a.x, a.y, b.z), at(a.x, b.y, b.z)});
    maker.add({at(b.x, a.y, a.z), at(b.x, b.y, a.z), at(b.x, b.y, b.z), at(b.x, a.y, b.z)});
}

/// The frame of a lift's shaft: posts at its corners from its lowest stop to over its highest, a ring over
/// the doors of each, and one at the top.
void addShaft(const Chart& lowest, const Lift& lift, const Layout& layout, MeshMaker& maker) {
    constexpr double kBar = 0.1, kRing = 2.3, kTop = 2.9;  // m
    const Footprint& link = lowest.link;
    const double half = link.half_width, low = heightOfStop(layout, lift, 0),
                 high = heightOfStop(layout, lift, lift.levels.size() - 1) + kTop;
    for (const double x : {-kBar, link.length})
        for (const double y : {-half - kBar, half})
            addBar({x, y, low - kSlab}, {x + kBar, y + kBar, high}, link, maker);
    const auto ring = [&](double z) {
        for (const double x : {-kBar, link.length})
            addBar({x, -half, z}, {x + kBar, half, z + kBar}, link, maker);
        for (const double y : {-half - kBar, half})
            addBar({0.0, y, z}, {link.length, y + kBar, z + kBar}, link, maker);
    };
    for (std::size_t stop = 0; stop < lift.levels.size(); ++stop)
        ring(heightOfStop(layout, lift, stop) + kRing);
    ring(high - kBar);
}

}  // namespace

std::size_t treadsOf(const Chart& chart, const Layout& layout) {
    if (!chart.is_link || layout.links[chart.index].kind != Link::Kind::stairs) return 0;
    return static_cast<std::size_t>(
        std::max(1.0, std::round(std::abs(chart.link.high - chart.link.low) / kTread)));
}

TerrainMesh homeMesh(const std::vector<Chart>& charts, const Layout& layout) {
    MeshMaker maker;
    for (const Chart& chart : charts) {
        if (chart.is_link) {
            addLink(chart, treadsOf(chart, layout), maker);
            if (chart.is_cabin && chart.stop == 0)
                addShaft(chart, layout.links[chart.index].lift, layout, maker);
            continue;
        }
        addFloor(chart, chart.bounds(), maker);
        addSlab(chart, maker);
    }
    return std::move(maker.mesh);
}

TerrainMesh planeMesh(const std::vector<Chart>& charts, const Layout& layout, double reach) {
    MeshMaker maker;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const Chart& chart = charts[i];
        maker.moveTo(chart.shift);
        if (chart.is_link) {
            const Footprint& link = chart.link;
            const double half = link.half_width + reach;
            addTreads(chart, treadsOf(chart, layout), 0.0, link.length, false, maker);
            const auto landing = [&](double t0, double t1, double z) {
                maker.add({glm::dvec3(link.at(t0, -half), z), glm::dvec3(link.at(t1, -half), z),
                           glm::dvec3(link.at(t1, half), z), glm::dvec3(link.at(t0, half), z)});
            };
            landing(-reach, 0.0, link.low);
            landing(link.length, link.length + reach, link.high);
            continue;
        }
        addFloor(chart, chart.bounds(), maker);
        const auto [lower, upper] = chart.bounds();
        const Box margin(lower - reach, upper + reach);
        for (std::size_t other = 0; other < charts.size(); ++other) {
            const Chart& next = charts[other];
            if (next.is_link) {
                const std::size_t treads = treadsOf(next, layout);
                if (next.link_from == i)
                    addTreads(next, treads, 0.0, std::min(kAhead, next.link.length), false, maker);
                if (next.link_to == i)
                    addTreads(next, treads, std::max(0.0, next.link.length - kAhead), next.link.length, false,
                              maker);
            } else if (other != i && std::abs(next.height - chart.height) <= kMostStep) {
                addFloor(next, margin, maker);
            }
        }
    }
    return std::move(maker.mesh);
}

}  // namespace throng::authoring
