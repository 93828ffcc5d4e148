// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "authoring/terrain/terrain_mesh.h"

namespace throng::authoring {

/// A face, in plan.
struct TerrainTriangle {
    glm::vec2 a, b, c;  ///< m: a in the scene frame, b and c from a
    float za, zb, zc;   ///< m: b and c over a

    /// Twice its area in plan; positive of faces that look up.
    float area() const { return b.x * c.y - b.y * c.x; }
    /// Rise over run, both axes.
    glm::vec2 slope() const { return glm::vec2(zb * c.y - zc * b.y, zc * b.x - zb * c.x) / area(); }
};

/// A raster that begins at the terrain's minimum.
struct TerrainRaster {
    float cell = 1.0f;  ///< m
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::size_t count() const { return std::size_t{width} * height; }
};

/// At most about `most` cells of `least` m or more.
TerrainRaster rasterOf(glm::vec2 extent, float least, double most);

/// The faces of a mesh, to be found by where they are in plan.
class FaceGrid {
  public:
    enum class Keep { looking_up, all };

    /// @param origin of the scene frame; only what lies within the bounds, in that frame, is kept
    FaceGrid(const TerrainMesh& mesh, glm::dvec2 origin, glm::vec2 minimum, glm::vec2 maximum, Keep keep);

    bool isEmpty() const { return triangles_.empty(); }
    /// How many faces a cell has, in the mean.
    double layers() const { return static_cast<double>(items_.size()) / static_cast<double>(cells_.count()); }

    /// Calls visit(face, height) for the faces above, below and at a place, but for upright ones.
    template <class Visit>
    void visitHits(glm::vec2 point, Visit visit) const {
        const glm::vec2 at = (point - minimum_) / cells_.cell;
        if (!(at.x >= 0.0f && at.y >= 0.0f && at.x < static_cast<float>(cells_.width) &&
              at.y < static_cast<float>(cells_.height)))
            return;
        const std::size_t cell =
            static_cast<std::size_t>(at.y) * cells_.width + static_cast<std::size_t>(at.x);
        for (std::uint32_t i = starts_[cell]; i < starts_[cell + 1]; ++i) {
            const TerrainTriangle& t = triangles_[items_[i]];
            const glm::vec2 p = point - t.a;
            const float area = t.area();
            if (std::abs(area) <= kSliver) continue;
            const float v = (p.x * t.c.y - p.y * t.c.x) / area, w = (t.b.x * p.y - t.b.y * p.x) / area;
            constexpr float kHair = 1.0e-5f;  // neighbours overlap by it, so that no point falls between them
            if (v >= -kHair && w >= -kHair && v + w <= 1.0f + kHair) visit(t, t.za + v * t.zb + w * t.zc);
        }
    }

    /// Calls visit(face) for all that may lie in a box, upright ones as well, some of them several times.
    template <class Visit>
    void visitBox(glm::vec2 lower, glm::vec2 upper, Visit visit) const {
        if (upper.x < minimum_.x || upper.y < minimum_.y || lower.x > maximum_.x || lower.y > maximum_.y)
            return;
        const glm::uvec2 first = cellOf(lower), last = cellOf(upper);
        for (std::uint32_t y = first.y; y <= last.y; ++y)
            for (std::uint32_t x = first.x; x <= last.x; ++x) {
                const std::size_t cell = std::size_t{y} * cells_.width + x;
                for (std::uint32_t i = starts_[cell]; i < starts_[cell + 1]; ++i)
                    visit(triangles_[items_[i]]);
            }
    }

  private:
    static constexpr float kSliver = 1.0e-7f;  // m^2

    glm::uvec2 cellOf(glm::vec2 point) const {
        return glm::uvec2(glm::clamp((point - minimum_) / cells_.cell, glm::vec2(0.0f),
                                     glm::vec2(cells_.width - 1, cells_.height - 1)));
    }
    void keepTriangles(const TerrainMesh& mesh, glm::dvec2 origin, Keep keep);
    void sortIntoCells();

    glm::vec2 minimum_, maximum_;
    std::vector<TerrainTriangle> triangles_;
    TerrainRaster cells_;
    std::vector<std::uint32_t> starts_, items_;
};

}  // namespace throng::authoring
