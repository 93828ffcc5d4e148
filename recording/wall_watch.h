// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "authoring/layout.h"
#include "base/capsule.h"
#include "base/plane_grid.h"

namespace throng::recording {

/// Walls as segments, and what bodies do to them.
class WallWatch {
  public:
    /// @param ground m: the lowest and the highest ground along each wall, where floors lie above each other
    WallWatch(std::vector<authoring::Wall> walls, glm::dvec2 minimum, glm::dvec2 maximum,
              std::vector<glm::dvec2> ground = {});
    bool empty() const { return segments_.empty(); }

    /// Looks at a frame and the one before: gates that are open in either are not there.
    void look(double before, double now);
    /// Whose walls count from here on: those of who stands at this height, m. Matters with `ground` only.
    void standAt(double height) { height_ = height; }
    /// No wall, of whatever storey, comes as near to a place as that, m. It may say no where that is so, too.
    bool isFar(glm::dvec2 place, double reach) const;
    /// Whether the straight line between two frames goes through a wall's axis or outline.
    bool crosses(glm::dvec2 before, glm::dvec2 after) const;
    /// How far a body is inside a wall, m; 0 where it is clear.
    double penetration(glm::dvec2 place, double radius) const;
    double penetration(const Capsule& body) const;

  private:
    struct Segment {
        glm::dvec2 a, b;
        double half_thickness;
        std::size_t wall;
    };
    bool counts(const Segment& segment) const;
    template <class Visit>
    void near(glm::dvec2 place, double reach, Visit&& visit) const;

    std::vector<authoring::Wall> walls_;
    std::vector<glm::dvec2> ground_;  // by wall; empty: all is one storey
    double height_ = 0.0;
    std::vector<bool> open_;  // by wall
    std::vector<Segment> segments_;
    double spacing_ = 1.0;             // m
    double thickest_ = 0.0;            // m: the largest half thickness
    std::vector<glm::dvec2> samples_;  // along the segments, at most spacing_ apart
    std::vector<std::uint32_t> sample_segment_;
    PlaneGrid grid_;
};

}  // namespace throng::recording
