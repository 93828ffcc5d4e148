// SPDX-License-Identifier: Apache-2.0
#include "authoring/terrain/face_grid.h"

#include <cmath>

namespace throng::authoring {
namespace {

constexpr double kMostCells = 1'000'000.0;
constexpr std::size_t kMostItems = 32'000'000;

}  // namespace

TerrainRaster rasterOf(glm::vec2 extent, float least, double most) {
    TerrainRaster raster;
    raster.cell = std::max(least, static_cast<float>(std::sqrt(double{extent.x} * double{extent.y} / most)));
    // What is long and thin has more of them along its edges than its area tells.
    const auto along = [&](float length) { return std::ceil(double{length} / double{raster.cell}) + 1.0; };
    while (along(extent.x) * along(extent.y) > 1.5 * most + 1024.0)
        raster.cell *= 1.25f;
    raster.width = static_cast<std::uint32_t>(std::ceil(extent.x / raster.cell)) + 1;
    raster.height = static_cast<std::uint32_t>(std::ceil(extent.y / raster.cell)) + 1;
    return raster;
}

FaceGrid::FaceGrid(const TerrainMesh& mesh, glm::dvec2 origin, glm::vec2 minimum, glm::vec2 maximum,
                   Keep keep)
    : minimum_(minimum), maximum_(maximum) {
    keepTriangles(mesh, origin, keep);
    sortIntoCells();
}

void FaceGrid::keepTriangles(const TerrainMesh& mesh, glm::dvec2 origin, Keep keep) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3& a = mesh.positions[mesh.indices[i]];
        const glm::dvec3& b = mesh.positions[mesh.indices[i + 1]];
        const glm::dvec3& c = mesh.positions[mesh.indices[i + 2]];
        TerrainTriangle t{};
        t.a = glm::vec2(glm::dvec2(a) - origin);
        t.b = glm::vec2(glm::dvec2(b - a));
        t.c = glm::vec2(glm::dvec2(c - a));
        const glm::vec2 lower = t.a + glm::min(glm::vec2(0.0f), glm::min(t.b, t.c));
        const glm::vec2 upper = t.a + glm::max(glm::vec2(0.0f), glm::max(t.b, t.c));
        if (lower.x > maximum_.x || lower.y > maximum_.y || upper.x < minimum_.x || upper.y < minimum_.y)
            continue;
        // Upright and overhanging faces, and slivers, carry nobody.
        if (keep == Keep::looking_up && !(t.area() > kSliver)) continue;
        t.za = static_cast<float>(a.z);
        t.zb = static_cast<float>(b.z - a.z);
        t.zc = static_cast<float>(c.z - a.z);
        triangles_.push_back(t);
    }
}

void FaceGrid::sortIntoCells() {
    const glm::vec2 extent = maximum_ - minimum_;
    const double about = std::clamp(static_cast<double>(triangles_.size()), 16.0, kMostCells);
    float least = 0.25f;
    const auto range = [&](const TerrainTriangle& t, auto&& visit) {
        // A hair wider, so that rounding loses no face at a cell's edge.
        const glm::vec2 hair(1.0e-4f * cells_.cell);
        const glm::uvec2 first = cellOf(t.a + glm::min(glm::vec2(0.0f), glm::min(t.b, t.c)) - hair);
        const glm::uvec2 last = cellOf(t.a + glm::max(glm::vec2(0.0f), glm::max(t.b, t.c)) + hair);
        visit(first, last);
    };
    for (;; least = 2.0f * cells_.cell) {
        cells_ = rasterOf(extent, least, about);
        std::size_t items = 0;
        for (const TerrainTriangle& t : triangles_)
            range(t, [&](glm::uvec2 first, glm::uvec2 last) {
                items += std::size_t{last.x - first.x + 1} * (last.y - first.y + 1);
            });
        if (items <= std::max(kMostItems, 2 * triangles_.size()) || cells_.count() <= 4) break;
    }
    starts_.assign(cells_.count() + 1, 0);
    const auto each = [&](auto&& visit) {
        for (std::uint32_t i = 0; i < triangles_.size(); ++i)
            range(triangles_[i], [&](glm::uvec2 first, glm::uvec2 last) {
                for (std::uint32_t y = first.y; y <= last.y; ++y)
                    for (std::uint32_t x = first.x; x <= last.x; ++x)
                        visit(std::size_t{y} * cells_.width + x, i);
            });
    };
    each([&](std::size_t cell, std::uint32_t) { ++starts_[cell + 1]; });
    for (std::size_t cell = 0; cell < cells_.count(); ++cell)
        starts_[cell + 1] += starts_[cell];
    items_.resize(starts_.back());
    std::vector<std::uint32_t> cursors(starts_.begin(), starts_.end() - 1);
    each([&](std::size_t cell, std::uint32_t i) { items_[cursors[cell]++] = i; });
}

}  // namespace throng::authoring
