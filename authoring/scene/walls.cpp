// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/walls.h"

#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <unordered_map>

#include "authoring/scene/raster.h"
#include "authoring/scene/wall_grid.h"

namespace throng::authoring {
namespace {

/// Walls up to this half thickness (m) have one row of tiles on their axis; thicker ones have a row on each
/// side.
constexpr float kThin = 0.15f;

void tilesAlong(glm::vec2 a, glm::vec2 b, float spacing, float tile_radius, std::uint32_t segment,
                std::vector<gpu::WallTile>& tiles) {
    const int count = std::max(1, static_cast<int>(std::ceil(glm::distance(a, b) / spacing)));
    for (int i = 0; i < count; ++i) {
        const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
        tiles.push_back({a + (b - a) * along, tile_radius, segment});
    }
}

/// Pieces of one wall meet in the same points: keep one tile of each.
void removeRepeated(std::vector<gpu::WallTile>& tiles) {
    constexpr float kSame = 0.005f;  // m
    std::unordered_map<std::int64_t, std::vector<glm::vec2>> kept;
    const auto key = [](int x, int y) {
        return (static_cast<std::int64_t>(x) << 32) ^ static_cast<std::uint32_t>(y);
    };
    std::erase_if(tiles, [&](const gpu::WallTile& tile) {
        const int x = static_cast<int>(std::floor(tile.position.x / kSame));
        const int y = static_cast<int>(std::floor(tile.position.y / kSame));
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const auto cell = kept.find(key(x + dx, y + dy)); cell != kept.end())
                    for (const glm::vec2 other : cell->second)
                        if (glm::distance(other, tile.position) < kSame) return true;
        kept[key(x, y)].push_back(tile.position);
        return false;
    });
}

float cross(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// Distance between two segments; zero when they cross.
float segmentsApart(glm::vec2 a, glm::vec2 b, glm::vec2 c, glm::vec2 d) {
    const float side_c = cross(b - a, c - a);
    const float side_d = cross(b - a, d - a);
    const float side_a = cross(d - c, a - c);
    const float side_b = cross(d - c, b - c);
    if (side_c * side_d < 0.0f && side_a * side_b < 0.0f) return 0.0f;
    return std::min({segmentDistance(a, c, d), segmentDistance(b, c, d), segmentDistance(c, a, b),
                     segmentDistance(d, a, b)});
}

}  // namespace

void buildWalls(const Layout& layout, const Rebase& rebase, WalkGeometry& geometry) {
    for (std::uint32_t index = 0; index < layout.walls.size(); ++index) {
        const Wall& wall = layout.walls[index];
        const std::vector<glm::vec2> points = rebase.local(wall.points);
        const float half_thickness = wall.closed ? 0.0f : static_cast<float>(0.5 * wall.thickness);
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
            geometry.walls.push_back({points[i], points[i + 1], half_thickness, index});
        if (!wall.closed) continue;
        geometry.walls.push_back({points.back(), points.front(), 0.0f, index});
        geometry.solids.push_back(points);
    }
}

double tilesNeeded(const gpu::WallSegment& segment, float spacing) {
    const double length = glm::distance(segment.a, segment.b);
    const double round = segment.half_thickness > kThin ? 6.3 * double{segment.half_thickness} : 0.0;
    return ((round > 0.0 ? 2.0 : 1.0) * length + round) / double{spacing} + 1.0;
}

namespace {

/// Those of one wall.
void tilesOf(const gpu::WallSegment& segment, std::uint32_t index, float spacing, float tile_radius,
             std::vector<gpu::WallTile>& tiles) {
    const float length = glm::distance(segment.a, segment.b);
    if (segment.half_thickness <= kThin || length <= 0.0f) {
        tilesAlong(segment.a, segment.b, spacing, tile_radius, index, tiles);
        return;
    }
    const glm::vec2 along = (segment.b - segment.a) / length;
    const glm::vec2 aside = glm::vec2(-along.y, along.x) * segment.half_thickness;
    tilesAlong(segment.a + aside, segment.b + aside, spacing, tile_radius, index, tiles);
    tilesAlong(segment.a - aside, segment.b - aside, spacing, tile_radius, index, tiles);
    // The rounded ends, half a circle each.
    const int steps =
        std::max(1, static_cast<int>(std::ceil(3.14159265f * segment.half_thickness / spacing)));
    for (int i = 1; i < steps; ++i) {
        const float angle = 3.14159265f * static_cast<float>(i) / static_cast<float>(steps);
        const glm::vec2 outward = along * (std::sin(angle) * segment.half_thickness);
        const glm::vec2 round = aside * std::cos(angle);
        tiles.push_back({segment.b + outward + round, tile_radius, index});
        tiles.push_back({segment.a - outward + round, tile_radius, index});
    }
}

}  // namespace

std::vector<gpu::WallTile> wallTiles(const std::vector<gpu::WallSegment>& segments, float spacing,
                                     float tile_radius, bool on_charts) {
    std::vector<gpu::WallTile> tiles;
    for (std::uint32_t index = 0; index < segments.size(); ++index) {
        gpu::WallSegment segment = segments[index];
        const glm::vec2 corner = on_charts ? segment.a : glm::vec2(0.0f);
        segment.a -= corner;
        segment.b -= corner;
        const std::size_t first = tiles.size();
        tilesOf(segment, index, spacing, tile_radius, tiles);
        for (std::size_t tile = first; on_charts && tile < tiles.size(); ++tile)
            tiles[tile].position = corner + snapped(tiles[tile].position);
    }
    removeRepeated(tiles);
    return tiles;
}

void sortWalls(WalkGeometry& geometry) {
    constexpr std::size_t kMany = 256;
    constexpr float kHair = 0.001f;  // m
    for (const LocalPolygon& solid : geometry.solids) {
        const Box box = boundsOf(solid, kHair);
        geometry.solid_boxes.push_back({box.lower, box.upper});
    }
    if (geometry.walls.size() > kMany)
        geometry.wall_grid =
            std::make_shared<const WallGrid>(geometry.walls, geometry.minimum, geometry.maximum);
}

float wallDepth(const WalkGeometry& geometry, glm::vec2 position, float radius) {
    float depth = -kUnreachable;
    const auto look = [&](const gpu::WallSegment& wall) {
        depth = std::max(depth, radius + wall.half_thickness - segmentDistance(position, wall.a, wall.b));
    };
    if (geometry.wall_grid && radius <= WallGrid::kReach) {
        for (const std::uint32_t index : geometry.wall_grid->near(position))
            look(geometry.walls[index]);
    } else {
        for (const gpu::WallSegment& wall : geometry.walls)
            look(wall);
    }
    for (std::size_t i = 0; i < geometry.solids.size(); ++i) {
        if (i < geometry.solid_boxes.size()) {
            const WalkGeometry::Box& box = geometry.solid_boxes[i];
            if (position.x < box.lower.x || position.y < box.lower.y || position.x > box.upper.x ||
                position.y > box.upper.y)
                continue;
        }
        if (insidePolygon(geometry.solids[i], position)) depth = std::max(depth, radius);
    }
    return depth;
}

bool straightIsClear(const WalkGeometry& geometry, glm::vec2 a, glm::vec2 b, float radius) {
    const glm::vec2 ends[] = {a, b};
    const Box path = boundsOf(ends, radius);
    const auto blocks = [&](const gpu::WallSegment& wall) {
        const float reach = wall.half_thickness;
        if (std::max(wall.a.x, wall.b.x) + reach < path.lower.x ||
            std::min(wall.a.x, wall.b.x) - reach > path.upper.x)
            return false;
        if (std::max(wall.a.y, wall.b.y) + reach < path.lower.y ||
            std::min(wall.a.y, wall.b.y) - reach > path.upper.y)
            return false;
        return segmentsApart(a, b, wall.a, wall.b) < radius + reach;
    };
    if (!geometry.wall_grid || radius > WallGrid::kReach)
        return std::none_of(geometry.walls.begin(), geometry.walls.end(), blocks);
    bool clear = true;
    geometry.wall_grid->along(a, b, [&](std::span<const std::uint32_t> walls) {
        clear = clear && std::none_of(walls.begin(), walls.end(),
                                      [&](std::uint32_t index) { return blocks(geometry.walls[index]); });
    });
    return clear;
}

}  // namespace throng::authoring
