// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "authoring/layout.h"
#include "base/capsule.h"
#include "base/plane_grid.h"
#include "recording/wall_watch.h"

namespace throng::recording {

/// Somebody whose place has been averaged over time.
struct MovedBody {
    glm::dvec2 simulated{0.0};  ///< where the simulation had it: clear of walls
    glm::dvec2 place{0.0};      ///< where it is to be shown
    double radius = 0.0;        ///< m
    glm::dvec2 axis{0.0};  ///< m, of a body that is no disc: half of its segment; `radius` holds all of it
    double height = 0.0;   ///< m, of the ground; matters where floors lie above each other
    bool stays = false;    ///< nobody moves it

    Capsule shapeAt(glm::dvec2 middle) const { return {middle, axis, radius - glm::length(axis)}; }
};

/// Averages cut corners: of walls, and of other people who are walked round. This puts whoever got too near
/// back: people out of each other, half of the way each, and out of walls towards where the simulation had
/// them. Who finds no room that way goes back to where it was simulated.
class KeepApart {
  public:
    /// @param walls in the frame of reference of the places
    /// @param ground as WallWatch's
    KeepApart(std::vector<authoring::Wall> walls, glm::dvec2 minimum, glm::dvec2 maximum,
              std::vector<glm::dvec2> ground = {});

    /// @param before, now s, of the frame before and of this one: gates open in either are not there
    void settle(std::vector<MovedBody>& bodies, double before, double now);

  private:
    struct Pair {
        std::uint32_t first, second;
        double reach;
    };
    void findPairs(const std::vector<MovedBody>& bodies);
    void separate(std::vector<MovedBody>& bodies) const;
    void clearWalls(std::vector<MovedBody>& bodies);
    void clearWalls(MovedBody& body);
    bool takeBack(std::vector<MovedBody>& bodies) const;

    WallWatch walls_;
    PlaneGrid grid_;
    std::vector<glm::dvec2> places_;
    std::vector<Pair> pairs_;
};

}  // namespace throng::recording
