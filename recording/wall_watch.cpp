// SPDX-License-Identifier: Apache-2.0
#include "recording/wall_watch.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace throng::recording {
namespace {

constexpr double kSpacing = 1.0;  // m, where there are not more
constexpr double kMostSamples = 1.0e6;
constexpr std::size_t kFewCells = 1000;  // and samples, to look through rather than at all walls
constexpr double kThickest = 2.0;        // m: half thicknesses above this are looked for further away

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

}  // namespace

WallWatch::WallWatch(std::vector<authoring::Wall> walls, glm::dvec2 minimum, glm::dvec2 maximum,
                     std::vector<glm::dvec2> ground)
    : walls_(std::move(walls)),
      ground_(std::move(ground)),
      open_(walls_.size()),
      grid_(minimum, maximum, 2.0) {
    for (std::size_t index = 0; index < walls_.size(); ++index) {
        const authoring::Wall& wall = walls_[index];
        const std::size_t count = wall.points.size() - (wall.closed ? 0 : 1);
        for (std::size_t i = 0; i < count; ++i)
            segments_.push_back({wall.points[i], wall.points[(i + 1) % wall.points.size()],
                                 wall.closed ? 0.0 : 0.5 * wall.thickness, index});
    }
    double length = 0.0;
    for (const Segment& each : segments_) {
        length += glm::distance(each.a, each.b);
        thickest_ = std::max(thickest_, std::min(each.half_thickness, kThickest));
    }
    spacing_ = std::max(kSpacing, length / kMostSamples);
    for (std::uint32_t i = 0; i < segments_.size(); ++i) {
        const int pieces = 1 + static_cast<int>(glm::distance(segments_[i].a, segments_[i].b) / spacing_);
        for (int k = 0; k <= pieces; ++k) {
            samples_.push_back(glm::mix(segments_[i].a, segments_[i].b, static_cast<double>(k) / pieces));
            sample_segment_.push_back(i);
        }
    }
    grid_.sort(samples_);
}

/// Gates that are open do not, nor walls of other storeys.
bool WallWatch::counts(const Segment& segment) const {
    constexpr double kHigher = 1.5;  // m: less than headroom, more than anybody is above its own walls
    if (open_[segment.wall]) return false;
    if (ground_.empty()) return true;
    const glm::dvec2 ground = ground_[segment.wall];
    return height_ > ground.x - kHigher && height_ < ground.y + kHigher;
}

bool WallWatch::isFar(glm::dvec2 place, double reach) const {
    return thickest_ < kThickest && grid_.isEmptyNear(place, reach + spacing_ + thickest_);
}

template <class Visit>
void WallWatch::near(glm::dvec2 place, double reach, Visit&& visit) const {
    const double around = reach + spacing_ + thickest_;
    // Of a wall that reaches far out of the bounds, all samples there are in the cells at the edge.
    const std::size_t all = segments_.size() + kFewCells;
    if (grid_.workNear(place, around, all) > all) {
        for (const Segment& each : segments_)
            if (counts(each)) visit(each);
        return;
    }
    std::uint32_t last = ~0u;
    grid_.near(place, around, [&](std::uint32_t sample) {
        const std::uint32_t segment = sample_segment_[sample];
        if (segment != last && counts(segments_[segment])) visit(segments_[segment]);
        last = segment;
    });
}

void WallWatch::look(double before, double now) {
    for (std::size_t i = 0; i < walls_.size(); ++i)
        open_[i] = walls_[i].isOpen(before) || walls_[i].isOpen(now);
}

bool WallWatch::crosses(glm::dvec2 before, glm::dvec2 after) const {
    const glm::dvec2 path = after - before;
    bool crossed = false;
    near(before, glm::length(path), [&](const Segment& wall) {
        const glm::dvec2 axis = wall.b - wall.a;
        const double turn = cross(path, axis);
        if (std::abs(turn) < 1.0e-12) return;
        const double on_path = cross(wall.a - before, axis) / turn;
        const double on_wall = cross(wall.a - before, path) / turn;
        crossed = crossed || (on_path >= 0.0 && on_path <= 1.0 && on_wall >= 0.0 && on_wall <= 1.0);
    });
    return crossed;
}

double WallWatch::penetration(glm::dvec2 place, double radius) const {
    double deepest = 0.0;
    near(place, radius, [&](const Segment& wall) {
        const glm::dvec2 axis = wall.b - wall.a;
        const double squared = glm::dot(axis, axis);
        const double along =
            squared > 0.0 ? glm::clamp(glm::dot(place - wall.a, axis) / squared, 0.0, 1.0) : 0.0;
        const double gap = glm::distance(place, wall.a + along * axis) - wall.half_thickness;
        deepest = std::max(deepest, radius - gap);
    });
    return deepest;
}

double WallWatch::penetration(const Capsule& body) const {
    if (body.axis == glm::dvec2(0.0)) return penetration(body.middle, body.thickness);
    double deepest = 0.0;
    near(body.middle, body.thickness + glm::length(body.axis), [&](const Segment& wall) {
        const double gap =
            segmentsDistance(body.middle - 0.5 * (wall.a + wall.b), body.axis, 0.5 * (wall.b - wall.a)) -
            wall.half_thickness;
        deepest = std::max(deepest, body.thickness - gap);
    });
    return deepest;
}

}  // namespace throng::recording
