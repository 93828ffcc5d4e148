// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "authoring/terrain/face_grid.h"

namespace throng::authoring {

/// To the right, up, left and down in plan; turning left is going on to the next.
inline constexpr std::array kSides = {glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(-1, 0),
                                      glm::ivec2(0, -1)};
inline constexpr std::uint32_t kNoSpot = 0xffffffffu;

/// Where people can stand on a mesh with faces above each other, and where they can walk on to.
///
/// In the middle of each cell of the charts' lattice (chart_raster.h) people can stand on every face that
/// looks up, slopes less than 45 degrees, and has headroom: such a place is a *spot*. From there they get to
/// the next cell where the ground goes on with steps of a quarter of a metre at most, and nothing upright
/// stands in between.
class Walkable {
  public:
    struct Spot {
        glm::ivec2 cell{0};
        float height = 0.0f;                                                       ///< m
        std::array<std::uint32_t, 4> next = {kNoSpot, kNoSpot, kNoSpot, kNoSpot};  ///< by side
    };

    /// @param lower, upper home: what lies beyond is left out
    /// @throws std::invalid_argument for very many spots
    Walkable(const TerrainMesh& mesh, glm::dvec2 lower, glm::dvec2 upper);

    const std::vector<Spot>& spots() const { return spots_; }
    /// The first of a cell's spots and one beyond its last, from the lowest up.
    std::pair<std::uint32_t, std::uint32_t> spotsOf(glm::ivec2 cell) const;
    /// The cell's spot that is nearest in height; kNoSpot where it has none.
    std::uint32_t nearestSpot(glm::ivec2 cell, double height) const;

    /// The ground at a place itself, where it is within a step of a height, m.
    std::optional<double> groundNear(glm::dvec2 place, double height) const;

    glm::ivec2 first() const { return first_; }
    glm::ivec2 size() const { return size_; }

    /// How far one gets from a spot towards the next cell's middle, m.
    double roomBeside(std::uint32_t spot, std::size_t side) const;

  private:
    struct Standing {
        glm::vec2 at{0.0f};  // from origin_
        float height = 0.0f;
    };
    struct Hit {
        float height;
        bool carries;
    };
    glm::vec2 middleOf(glm::ivec2 cell) const;
    const std::vector<float>& heightsAt(glm::vec2 at) const;
    std::optional<Standing> stepOn(const Standing& from, glm::vec2 to) const;
    bool isBlocked(const Standing& from, const Standing& to) const;
    void findSpots();
    void join();
    std::uint32_t reachedFrom(std::uint32_t spot, std::size_t side) const;

    glm::dvec2 origin_{0.0};
    glm::ivec2 first_{0}, size_{0};
    FaceGrid faces_;
    std::vector<Spot> spots_;
    std::vector<std::uint32_t> starts_;  // by cell
    mutable std::vector<Hit> hits_;
    mutable std::vector<float> heights_;
};

}  // namespace throng::authoring
