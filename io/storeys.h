// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>

#include "io/bake_reader.h"

namespace throng::io {

/// Which floor or link of a bake with levels somebody stands on, who is only known by its place and height.
class Storeys {
  public:
    /// @param bake outlives this
    explicit Storeys(const Bake& bake) : bake_(bake) {}

    /// The level whose floor a place is on, at about that height; of a terrain's, the one nearest in
    /// height where it is on no link.
    std::optional<std::size_t> levelAt(glm::dvec2 place, double height) const;
    /// The link that it is on, where it is on no level.
    std::optional<std::size_t> linkAt(glm::dvec2 place, double height) const;
    /// The number of the level, or the number of levels and that of the link; nothing in between.
    std::optional<std::size_t> storeyAt(glm::dvec2 place, double height) const;

    /// How far a place is along a link and how far to its left, m.
    glm::dvec2 onLink(std::size_t link, glm::dvec2 place) const;
    double lengthOf(std::size_t link) const;
    /// Of a link's middle at so many metres along it.
    double heightOf(std::size_t link, double along) const;

    /// Whether a wall is on or beside a level's floor, or on a link from or to it.
    bool isWallBeside(std::size_t level, std::size_t wall) const;

  private:
    /// Of those that are no landings.
    std::size_t nearestLevel(double height) const;
    std::optional<std::size_t> groundAt(glm::dvec2 place, double height) const;
    /// @param heights lowest and highest, of what stands there
    bool isBeside(std::size_t level, glm::dvec2 place, glm::dvec2 heights) const;

    const Bake& bake_;
};

}  // namespace throng::io
