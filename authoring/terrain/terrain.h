// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "authoring/terrain/face_grid.h"
#include "shaders/shared/terrain_types.h"

namespace throng::authoring {

/// Which of a mesh's faces people stand on where the ground is cut into charts
/// (authoring/storeys/charts.h), in the cells of a raster over their plane.
struct PlaneGround {
    struct Cell {
        float height;     ///< m: of several faces the nearest to it counts; NaN where nobody stands
        glm::vec2 shift;  ///< m: from home to the plane
    };
    glm::vec2 minimum{0.0f};  ///< m, scene frame
    float cell = 0.25f;       ///< m
    std::uint32_t width = 0, height = 0;
    std::vector<Cell> cells;
    glm::vec2 lower{0.0f}, upper{0.0f};  ///< m, scene frame: the bounds of all that is ground, at home

    const Cell& at(glm::vec2 place) const;
};

/// The ground that people of one scene stand on: the faces of a terrain that look up, and the same without
/// its steps.
class Terrain {
  public:
    /// @param highest which of several faces above each other counts
    /// @param origin, minimum, maximum as Scene's: only what lies there is kept
    /// @throws std::invalid_argument for what would take minutes to sample
    Terrain(const TerrainMesh& mesh, bool highest, glm::dvec2 origin, glm::vec2 minimum, glm::vec2 maximum);
    /// Of charts in their plane. @param minimum, maximum the plane's, multiples of gpu::SHIFT_STEP
    Terrain(const TerrainMesh& mesh, PlaneGround ground, glm::dvec2 origin, glm::vec2 minimum,
            glm::vec2 maximum);

    /// The very ground (m); nothing where there is none.
    std::optional<float> groundAt(glm::vec2 point) const;
    /// The difference between the highest and the lowest face there, m.
    float storeysAt(glm::vec2 point) const;
    /// The ground without its steps (m): anywhere, going on beyond the terrain's edge.
    float smoothAt(glm::vec2 point) const;
    glm::vec2 slopeAt(glm::vec2 point) const;
    /// How much of the slope there is that of stairs, 0 to 1: at the nearest of the lattice's nodes.
    float stepsAt(glm::vec2 point) const;
    struct Face {
        float height = 0.0f;    ///< m
        glm::vec2 slope{0.0f};  ///< rise over run
    };
    /// The very ground; where there is none, the smooth one.
    Face faceAt(glm::vec2 point) const;
    float heightAt(glm::vec2 point) const { return faceAt(point).height; }

    bool highest() const { return highest_; }
    bool isEmpty() const { return faces_.isEmpty(); }
    /// Where the lattice begins, m, scene frame.
    glm::vec2 minimum() const { return minimum_; }
    const TerrainRaster& lattice() const { return lattice_; }
    const std::vector<gpu::TerrainNode>& nodes() const { return nodes_; }

  private:
    std::optional<Face> hitAt(glm::vec2 point) const;
    std::optional<Face> hitInPlane(glm::vec2 point) const;
    void leaveOutOthers(glm::vec2 point, std::array<float, 4>& heights) const;
    void sampleLattice();
    /// m in a cell of the lattice: what is higher is another ground. Nothing is where the ground is not cut.
    float ledge() const;
    glm::vec2 nodePlace(std::uint32_t x, std::uint32_t y) const {
        return minimum_ + glm::vec2(x, y) * lattice_.cell;
    }

    bool highest_;
    glm::vec2 minimum_, maximum_;
    FaceGrid faces_;
    std::optional<PlaneGround> plane_;  // none: the ground is not cut
    TerrainRaster lattice_;
    std::vector<gpu::TerrainNode> nodes_;
};

}  // namespace throng::authoring
