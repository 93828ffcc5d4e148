// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/overlaps.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/capsule.h"
#include "io/overrides/flat_shapes.h"

namespace throng::io {

OverlapWatch::OverlapWatch(const LayeredCrowd& crowd) : crowd_(crowd) {
    const double most_size = crowd.source().mostSize();
    for (std::uint32_t row = 0; row < crowd.rows(); ++row) {
        scales_.push_back(crowd.scaleOf(row));
        widest_ = std::max(widest_, 2.0 * crowd.person(row).reach() * scales_.back() * most_size);
        if (crowd.plan(row).stands_anew) moved_.push_back(row);
    }
    const Bake& bake = crowd.bake();
    for (const authoring::Wall& wall : bake.walls) {
        Box box{wall.points.front(), wall.points.front()};
        for (const glm::dvec2 point : wall.points) {
            box.minimum = glm::min(box.minimum, point - 0.5 * wall.thickness);
            box.maximum = glm::max(box.maximum, point + 0.5 * wall.thickness);
        }
        wall_boxes_.push_back(box);
    }
    if (!moved_.empty())
        grid_.emplace(bake.minimum, bake.maximum, std::max(widest_, 0.5), cellsFor(crowd.rows()));
}

Capsule OverlapWatch::bodyIn(const PerStream<std::vector<float>>& frame, std::uint32_t row) const {
    const AgentRow& person = crowd_.person(row);
    const auto pos = throng::rowOf(std::span(frame[Stream::pos]), row);
    const glm::dvec2 place(pos[0], pos[1]);
    const bool has_size = !frame[Stream::size].empty();
    const double size = has_size ? double{frame[Stream::size][row * kComponents]} : 1.0;
    const double scale = size * scales_[row];
    if (person.body.isDisc()) return {place, glm::dvec2(0.0), scale * double{person.radius}};
    const auto dir = throng::rowOf(std::span(frame[Stream::dir]), row);
    const bool is_told = !frame[Stream::chest].empty();
    const double twist = is_told ? double{frame[Stream::chest][row * kComponents]} : 0.0;
    const double angle = std::atan2(double{dir[1]}, double{dir[0]}) + twist;
    return capsuleOf(place, {std::cos(angle), std::sin(angle)}, scale * person.body.radius(),
                     scale * person.body.halfAxis());
}

/// How deep two of the bake were in each other there, m; 0 of copies.
double OverlapWatch::depthBefore(const CrowdFrame& frame, std::uint32_t row, std::uint32_t other) const {
    if (std::max(row, other) >= frame.rows() || !frame.isThere(row) || !frame.isThere(other)) return 0.0;
    return std::max(
        0.0, -freeBetween(frame.body(row, crowd_.person(row)), frame.body(other, crowd_.person(other))));
}

void OverlapWatch::see(std::uint32_t index, const PerStream<std::vector<float>>& frame) {
    if (moved_.empty()) return;
    const CrowdFrame before = crowd_.source().frame(index);
    std::vector<glm::dvec2> places;
    std::vector<std::uint32_t> rows;
    std::vector<bool> is_there(crowd_.rows());
    for (std::uint32_t row = 0; row < crowd_.rows(); ++row) {
        is_there[row] = frame[Stream::state][row * kComponents] > 0.5f;
        if (!is_there[row]) continue;
        const auto pos = throng::rowOf(std::span(frame[Stream::pos]), row);
        places.emplace_back(pos[0], pos[1]);
        rows.push_back(row);
    }
    grid_->sort(places);
    for (const std::uint32_t row : moved_) {
        if (!is_there[row]) continue;
        const Capsule body = bodyIn(frame, row);
        seeWalls(index, body, row, before);
        grid_->near(body.middle, widest_, [&](std::uint32_t i) {
            const std::uint32_t other = rows[i];
            if (other == row || (other < row && crowd_.plan(other).stands_anew)) return;
            const double depth = -freeBetween(body, bodyIn(frame, other));
            if (depth <= kLeast || depth <= depthBefore(before, row, other) + kLeast) return;
            const auto [known, is_new] = overlaps_.try_emplace(
                std::minmax(row, other),
                Overlap{std::min(row, other), std::max(row, other), index, index, depth, index});
            Overlap& overlap = known->second;
            overlap.last = index;
            if (depth > overlap.depth) overlap.depth = depth, overlap.deepest = index;
        });
    }
}

/// By the disc that fits into the body: shoulders may brush along a wall.
void OverlapWatch::seeWalls(std::uint32_t index, const Capsule& body, std::uint32_t row,
                            const CrowdFrame& before) {
    const std::vector<authoring::Wall>& walls = crowd_.bake().walls;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const glm::dvec2 nearest = glm::clamp(body.middle, wall_boxes_[i].minimum, wall_boxes_[i].maximum);
        if (glm::distance(nearest, body.middle) >= body.thickness) continue;
        if (walls[i].isOpen(index / crowd_.bake().fps)) continue;
        const double depth = body.thickness - distanceToWall(walls[i], body.middle);
        if (depth <= kLeast) continue;
        const bool was_there = row < before.rows() && before.isThere(row);
        if (was_there && depth <= body.thickness - distanceToWall(walls[i], before.place(row)) + kLeast)
            continue;
        const auto [known, is_new] = in_walls_.try_emplace({row, i}, InWall{row, walls[i].id, index, index});
        known->second.last = index;
    }
}

std::vector<InWall> OverlapWatch::inWalls() const {
    std::vector<InWall> result;
    for (const auto& [where, each] : in_walls_)
        result.push_back(each);
    return result;
}

std::vector<Overlap> OverlapWatch::found() const {
    std::vector<Overlap> result;
    for (const auto& [rows, overlap] : overlaps_)
        result.push_back(overlap);
    std::ranges::stable_sort(result, std::ranges::greater(), &Overlap::depth);
    return result;
}

}  // namespace throng::io
