// SPDX-License-Identifier: Apache-2.0
//
// A passage is narrow where two walls face each other across little room with nothing between them. From
// points along every wall, the nearest point of each other wall is looked for; the two make a passage if the
// disc that has them as a diameter holds no part of any wall, which is how Gabriel graphs tell which of many
// points are next to each other. (K. R. Gabriel and R. R. Sokal 1969, A new statistical approach to
// geographic variation analysis.) The disc is taken a little smaller: points along walls are never quite
// opposite. A corner has none: the disc between its two sides holds a part of both.
#include "authoring/scene/narrow_places.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <unordered_set>
#include <utility>

#include "authoring/scene/raster.h"
#include "authoring/scene/wall_grid.h"
#include "authoring/scene/walls.h"

namespace throng::authoring {
namespace {

constexpr float kSpacing = 0.25f;   // m between the points along a wall, and between the places that are kept
constexpr float kDiscShare = 0.9f;  // of the gap: the diameter of the disc that has to be free

/// The places found, no two in the same square.
class Places {
  public:
    void add(glm::vec2 place) {
        const auto x = static_cast<std::int32_t>(std::floor(place.x / kSpacing));
        const auto y = static_cast<std::int32_t>(std::floor(place.y / kSpacing));
        const std::uint64_t square =
            std::uint64_t{static_cast<std::uint32_t>(x)} << 32 | static_cast<std::uint32_t>(y);
        if (squares_.insert(square).second) found_.push_back(place);
    }
    std::vector<glm::vec2> take() { return std::move(found_); }

  private:
    std::unordered_set<std::uint64_t> squares_;
    std::vector<glm::vec2> found_;
};

template <class Visit>
void visitPoints(const gpu::WallSegment& wall, Visit visit) {
    const auto parts =
        std::max(1u, static_cast<std::uint32_t>(std::ceil(glm::distance(wall.a, wall.b) / kSpacing)));
    for (std::uint32_t i = 0; i <= parts; ++i)
        visit(wall.a + (static_cast<float>(i) / static_cast<float>(parts)) * (wall.b - wall.a));
}

/// Walls across from a point of another wall, the nearest first.
struct Across {
    glm::vec2 offset;  // m, to the wall's nearest point
    float distance;    // m, of its surface; between the middles where both are thick
    std::uint32_t wall;
};

/// Finds the places of one scene.
class Finder {
  public:
    Finder(const WalkGeometry& geometry, float widest)
        : geometry_(geometry),
          grid_(geometry.wall_grid
                    ? geometry.wall_grid
                    : std::make_shared<const WallGrid>(geometry.walls, geometry.minimum, geometry.maximum)),
          narrowest_(2.0f * geometry.smallest_radius),
          widest_(widest) {}

    std::vector<glm::vec2> find() {
        for (std::uint32_t wall = 0; wall < geometry_.walls.size(); ++wall)
            visitPoints(geometry_.walls[wall], [&](glm::vec2 point) { lookAcross(wall, point); });
        return places_.take();
    }

  private:
    void lookAcross(std::uint32_t wall, glm::vec2 point) {
        const float own = geometry_.walls[wall].half_thickness;
        across_.clear();
        for (const std::uint32_t index : grid_->near(point)) {
            const gpu::WallSegment& other = geometry_.walls[index];
            const glm::vec2 offset = nearestOnSegment(point, other.a, other.b) - point;
            const float gap = glm::length(offset) - own - other.half_thickness;
            if (index != wall && gap <= widest_) across_.push_back({offset, gap, index});
        }
        const std::size_t first = std::min(kNearest, across_.size());
        std::partial_sort(across_.begin(), across_.begin() + static_cast<std::ptrdiff_t>(first),
                          across_.end(), [](const Across& a, const Across& b) {
                              return a.distance != b.distance ? a.distance < b.distance : a.wall < b.wall;
                          });
        for (const Across& each : across_) {
            if (each.distance < narrowest_) continue;
            const float to_middle = (own + 0.5f * each.distance) / glm::length(each.offset);
            const glm::vec2 middle = point + each.offset * to_middle;
            const float radius = 0.5f * kDiscShare * each.distance;
            if (isFreeOfTheNearest(middle, radius, first) && isFree(middle, radius)) places_.add(middle);
        }
    }
    /// Almost all discs between many walls hold one of those that are nearest: without asking the others.
    bool isFreeOfTheNearest(glm::vec2 middle, float radius, std::size_t count) const {
        return std::none_of(across_.begin(), across_.begin() + static_cast<std::ptrdiff_t>(count),
                            [&](const Across& each) { return touches(each.wall, middle, radius); });
    }
    bool isFree(glm::vec2 middle, float radius) const {
        return std::ranges::none_of(grid_->near(middle),
                                    [&](std::uint32_t wall) { return touches(wall, middle, radius); }) &&
               wallDepth(geometry_, middle, radius) <= 0.0f;
    }
    bool touches(std::uint32_t wall, glm::vec2 middle, float radius) const {
        const gpu::WallSegment& each = geometry_.walls[wall];
        return segmentDistance(middle, each.a, each.b) < radius + each.half_thickness;
    }

    static constexpr std::size_t kNearest = 8;
    const WalkGeometry& geometry_;
    std::shared_ptr<const WallGrid> grid_;
    float narrowest_, widest_;
    std::vector<Across> across_;
    Places places_;
};

}  // namespace

std::vector<glm::vec2> narrowPlaces(const WalkGeometry& geometry, float widest) {
    if (geometry.walls.empty()) return {};
    return Finder(geometry, widest).find();
}

}  // namespace throng::authoring
