// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "authoring/layout.h"
#include "authoring/link_kinds.h"
#include "authoring/storeys/surface.h"

namespace throng::authoring {

/// How far apart in height the ground of two charts may be where one walks from one to the other, m.
inline constexpr double kMostStep = 0.25;
/// What people need over their heads, m. Where a link is nearer to a floor than this, the floor is open.
inline constexpr double kHeadroom = 2.2;

/// The ground under a link: a rectangle from where it begins to where it ends, that rises evenly.
struct Footprint {
    glm::dvec2 begin{0.0}, along{1.0, 0.0};  ///< m; unit vector
    double length = 0.0, half_width = 0.0;   ///< m; the middle of the railings bounds it
    double low = 0.0, high = 0.0;            ///< m, heights where it begins and ends

    double alongOf(glm::dvec2 point) const;
    double asideOf(glm::dvec2 point) const;
    double heightAt(double forward) const { return low + (high - low) * forward / length; }
    glm::dvec2 at(double forward, double aside) const;
    /// The corners of its part between two distances along it, counter-clockwise.
    std::vector<glm::dvec2> outline(double from, double to) const;
};

/// A part of the walkable ground that is single-valued over the plane: a floor without the openings of links,
/// a link, or a part of a terrain. Home coordinates are those of the layout; see Charts for the plane.
struct Chart {
    std::string name;  ///< of the level or link
    bool is_link = false;
    std::size_t index = 0;                          ///< of the level or link in the layout
    double height = 0.0;                            ///< m, of a floor
    std::vector<glm::dvec2> floor;                  ///< outline of a floor
    std::vector<std::vector<glm::dvec2>> openings;  ///< where links leave no headroom over or under it
    Footprint link;
    std::size_t link_from = 0, link_to = 0;  ///< the levels of a link, which are charts of the same index
    bool is_cabin = false;   ///< of a lift, at one of the levels that it serves: it begins at the doors there
    std::size_t stop = 0;    ///< which of them, in the lift's order
    double half_door = 0.0;  ///< m
    std::shared_ptr<const Surface> surface = {};  ///< of a part of a terrain
    glm::dvec2 shift{0.0};                        ///< plane = home + shift, m
    /// Of the plane, lower left and upper right at home: nothing: as much as people can stand on.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> room = {};

    bool contains(glm::dvec2 home) const;
    double heightAt(glm::dvec2 home) const;
    /// Of all that people can stand on: lower left and upper right.
    std::pair<glm::dvec2, glm::dvec2> bounds() const;
};

/// The end of a cabin that leads nowhere.
inline constexpr std::size_t kNoLevel = static_cast<std::size_t>(-1);

/// Whether one walks from a point of one chart to a point beside it of another.
bool areJoined(const Chart& a, std::size_t a_index, glm::dvec2 in_a, const Chart& b, std::size_t b_index,
               glm::dvec2 in_b);

/// The link of which a landing is a part, index into the layout's: the flight that leads to it.
std::size_t linkOfLanding(const Chart& landing, const Layout& layout);

/// Charts of the levels, in order, and then of the links, not yet laid out. A lift has one for each level
/// that it serves: the cabin, as it stands there.
std::vector<Chart> chartsOf(const Layout& layout);

}  // namespace throng::authoring
