// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "authoring/terrain/terrain_mesh.h"
#include "shaders/shared/terrain_types.h"

namespace throng::authoring {

/// A face, in plan.
struct TerrainTriangle {
    glm::vec2 a, b, c;  ///< m: a in the scene frame, b and c from a
    float za, zb, zc;   ///< m: b and c over a
};

/// A raster that begins at the terrain's minimum.
struct TerrainRaster {
    float cell = 1.0f;  ///< m
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::size_t count() const { return std::size_t{width} * height; }
};

/// The ground that people of one scene stand on: the faces of a terrain that look up, and the same without
/// its steps.
class Terrain {
  public:
    /// @param highest which of several faces above each other counts
    /// @param origin, minimum, maximum as Scene's: only what lies there is kept
    /// @throws std::invalid_argument for what would take minutes to sample
    Terrain(const TerrainMesh& mesh, bool highest, glm::dvec2 origin, glm::vec2 minimum, glm::vec2 maximum);

    /// The very ground (m); nothing where there is none.
    std::optional<float> groundAt(glm::vec2 point) const;
    /// The difference between the highest and the lowest face there, m.
    float storeysAt(glm::vec2 point) const;
    /// The ground without its steps (m): anywhere, going on beyond the terrain's edge.
    float smoothAt(glm::vec2 point) const;
    glm::vec2 slopeAt(glm::vec2 point) const;
    struct Face {
        float height = 0.0f;    ///< m
        glm::vec2 slope{0.0f};  ///< rise over run
    };
    /// The very ground; where there is none, the smooth one.
    Face faceAt(glm::vec2 point) const;
    float heightAt(glm::vec2 point) const { return faceAt(point).height; }

    bool highest() const { return highest_; }
    bool isEmpty() const { return triangles_.empty(); }
    /// Where the lattice begins, m, scene frame.
    glm::vec2 minimum() const { return minimum_; }
    const TerrainRaster& lattice() const { return lattice_; }
    const std::vector<gpu::TerrainNode>& nodes() const { return nodes_; }

  private:
    template <class Visit>
    void visitHits(glm::vec2 point, Visit visit) const;
    std::optional<Face> hitAt(glm::vec2 point) const;
    void keepTriangles(const TerrainMesh& mesh, glm::dvec2 origin);
    void sortIntoCells();
    void sampleLattice();
    glm::vec2 nodePlace(std::uint32_t x, std::uint32_t y) const {
        return minimum_ + glm::vec2(x, y) * lattice_.cell;
    }

    bool highest_;
    glm::vec2 minimum_, maximum_;
    std::vector<TerrainTriangle> triangles_;
    TerrainRaster cells_;
    std::vector<std::uint32_t> starts_, items_;
    TerrainRaster lattice_;
    std::vector<gpu::TerrainNode> nodes_;
};

}  // namespace throng::authoring
