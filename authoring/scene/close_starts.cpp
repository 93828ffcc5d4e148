// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/close_starts.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "authoring/scene/walls.h"

namespace throng::authoring {
namespace {

/// People by the squares in which they stand: whoever is in reach of somebody is in one of nine.
class Squares {
  public:
    explicit Squares(std::span<const gpu::Person> people) {
        glm::vec2 lower(people.front().spawn_position), upper = lower;
        float widest = 0.0f;
        for (const gpu::Person& person : people) {
            lower = glm::min(lower, person.spawn_position);
            upper = glm::max(upper, person.spawn_position);
            widest = std::max(widest, person.radius);
        }
        const glm::dvec2 extent(upper - lower);
        // As many squares as people, at most, however far apart these are.
        const double count = static_cast<double>(people.size());
        side_ = static_cast<float>(std::max({2.01 * double{widest}, std::sqrt(extent.x * extent.y / count),
                                             std::max(extent.x, extent.y) / count, 0.01}));
        lower_ = lower;
        across_ = static_cast<std::size_t>(extent.x / double{side_}) + 1;
        up_ = static_cast<std::size_t>(extent.y / double{side_}) + 1;
        firsts_.assign(across_ * up_ + 1, 0);
        for (const gpu::Person& person : people)
            ++firsts_[squareOf(person.spawn_position) + 1];
        for (std::size_t square = 1; square < firsts_.size(); ++square)
            firsts_[square] += firsts_[square - 1];
        std::vector<std::uint32_t> next(firsts_.begin(), firsts_.end() - 1);
        inside_.resize(people.size());
        for (std::uint32_t i = 0; i < people.size(); ++i)
            inside_[next[squareOf(people[i].spawn_position)]++] = {people[i].spawn_position, people[i].radius,
                                                                   i};
    }

    /// visit(i, j) for all pairs that are less than their radii apart.
    template <class Visit>
    void visitPairs(Visit visit) const {
        for (std::size_t y = 0; y < up_; ++y)
            for (std::size_t x = 0; x < across_; ++x) {
                const std::size_t square = y * across_ + x;
                const std::span<const Body> own = in(square);
                for (std::size_t i = 0; i < own.size(); ++i)
                    visitPairsOf(own[i], own.subspan(i + 1), visit);
                // Each pair of squares once.
                visitPairsOf(own, x + 1 < across_ ? in(square + 1) : std::span<const Body>(), visit);
                if (y + 1 == up_) continue;
                for (std::size_t beside = x - (x > 0); beside <= std::min(x + 1, across_ - 1); ++beside)
                    visitPairsOf(own, in(square - x + across_ + beside), visit);
            }
    }

  private:
    struct Body {
        glm::vec2 position;
        float radius;
        std::uint32_t person;
    };

    std::size_t squareOf(glm::vec2 position) const {
        const auto x = static_cast<std::size_t>((position.x - lower_.x) / side_);
        const auto y = static_cast<std::size_t>((position.y - lower_.y) / side_);
        return std::min(y, up_ - 1) * across_ + std::min(x, across_ - 1);
    }

    std::span<const Body> in(std::size_t square) const {
        return std::span(inside_).subspan(firsts_[square], firsts_[square + 1] - firsts_[square]);
    }

    template <class Visit>
    static void visitPairsOf(const Body& body, std::span<const Body> others, Visit visit) {
        for (const Body& other : others)
            if (glm::distance(other.position, body.position) < other.radius + body.radius)
                visit(body.person, other.person);
    }

    template <class Visit>
    static void visitPairsOf(std::span<const Body> bodies, std::span<const Body> others, Visit visit) {
        if (others.empty()) return;
        for (const Body& body : bodies)
            visitPairsOf(body, others, visit);
    }

    glm::vec2 lower_{0.0f};
    float side_ = 1.0f;  // m
    std::size_t across_ = 1, up_ = 1;
    std::vector<std::uint32_t> firsts_;  // in each square, of those inside
    std::vector<Body> inside_;
};

bool mayBeInWall(const gpu::Person& person, const WalkGeometry& geometry) {
    constexpr float kHair = 1.0e-3f;  // m
    // The ends of a body may be in a solid that its middle is not in.
    if (person.half_axis != 0.0f && !geometry.solids.empty()) return true;
    return wallDepth(geometry, person.spawn_position, person.radius + kHair) > 0.0f;
}

}  // namespace

CloseStarts closeStarts(const Scene& scene, const WalkGeometry& geometry, std::size_t first_group,
                        std::size_t groups) {
    CloseStarts close;
    close.of_row.assign(scene.people.size(), 0);
    if (groups == 0) return close;
    const std::size_t first = scene.queues[first_group].first_row;
    const gpu::SpawnQueue& last = scene.queues[first_group + groups - 1];
    const std::span people = std::span(scene.people).subspan(first, last.first_row + last.row_count - first);
    if (people.empty()) return close;
    const std::span flags = std::span(close.of_row).subspan(first, people.size());
    Squares(people).visitPairs([&](std::uint32_t i, std::uint32_t j) {
        flags[i] |= CloseStarts::kToBody;
        flags[j] |= CloseStarts::kToBody;
    });
    for (std::size_t i = 0; i < people.size(); ++i)
        if (mayBeInWall(people[i], geometry)) flags[i] |= CloseStarts::kToWall;
    return close;
}

}  // namespace throng::authoring
