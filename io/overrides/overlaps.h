// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/plane_grid.h"
#include "io/overrides/layered_crowd.h"

namespace throng::io {

/// Two people who are in each other where they were not before, or less.
struct Overlap {
    std::uint32_t row = 0, other = 0;
    std::uint32_t first = 0, last = 0;  ///< frames
    double depth = 0.0;                 ///< m, at its deepest
    std::uint32_t deepest = 0;          ///< frame of that
};

/// Somebody in a wall who was not in it before, or less.
struct InWall {
    std::uint32_t row = 0;
    std::string wall;
    std::uint32_t first = 0, last = 0;  ///< frames
};

/// Watches out for overlaps that changes make: nobody makes room for who has been moved.
class OverlapWatch {
  public:
    /// What nobody would see, m.
    static constexpr double kLeast = 0.01;

    explicit OverlapWatch(const LayeredCrowd& crowd);

    /// The next frame. @param frame of the bake that is made
    void see(std::uint32_t index, const PerStream<std::vector<float>>& frame);
    /// The deepest first.
    std::vector<Overlap> found() const;
    /// By row.
    std::vector<InWall> inWalls() const;

  private:
    Capsule bodyIn(const PerStream<std::vector<float>>& frame, std::uint32_t row) const;
    void seeWalls(std::uint32_t index, const Capsule& body, std::uint32_t row, const CrowdFrame& before);
    double depthBefore(const CrowdFrame& frame, std::uint32_t row, std::uint32_t other) const;

    const LayeredCrowd& crowd_;
    std::vector<double> scales_;
    double widest_ = 0.0;  ///< m, that two can be apart and touch
    std::optional<PlaneGrid> grid_;
    std::vector<std::uint32_t> moved_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Overlap> overlaps_;
    struct Box {
        glm::dvec2 minimum, maximum;
    };
    std::vector<Box> wall_boxes_;  ///< m, with half of the thickness
    std::map<std::pair<std::uint32_t, std::size_t>, InWall> in_walls_;
};

}  // namespace throng::io
