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

}  // namespace

std::vector<glm::vec2> narrowPlaces(const WalkGeometry& geometry, float widest) {
    Places places;
    if (geometry.walls.empty()) return places.take();
    const auto grid = geometry.wall_grid ? geometry.wall_grid
                                         : std::make_shared<const WallGrid>(geometry.walls, geometry.minimum,
                                                                            geometry.maximum);
    const float narrowest = 2.0f * geometry.smallest_radius;
    for (std::uint32_t i = 0; i < geometry.walls.size(); ++i) {
        const gpu::WallSegment& wall = geometry.walls[i];
        visitPoints(wall, [&](glm::vec2 point) {
            for (const std::uint32_t index : grid->near(point)) {
                const gpu::WallSegment& other = geometry.walls[index];
                const glm::vec2 across = nearestOnSegment(point, other.a, other.b) - point;
                const float distance = glm::length(across);
                const float gap = distance - wall.half_thickness - other.half_thickness;
                if (index == i || gap < narrowest || gap > widest) continue;
                const glm::vec2 middle = point + across * ((wall.half_thickness + 0.5f * gap) / distance);
                if (wallDepth(geometry, middle, 0.5f * kDiscShare * gap) <= 0.0f) places.add(middle);
            }
        });
    }
    return places.take();
}

}  // namespace throng::authoring
