// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace throng::authoring {

/// A lane's middle in world coordinates, and places along it, m from its first point. Before that and behind
/// its last one it goes straight on.
class LaneLine {
  public:
    /// @param points at least two, no neighbours at the same place
    explicit LaneLine(const std::vector<glm::dvec2>& points) : points_(points) {}

    /// How far along it a place lies.
    double alongAt(glm::dvec2 place) const;
    glm::dvec2 placeAt(double along) const;
    /// Unit vector.
    glm::dvec2 wayAt(double along) const;

  private:
    /// The end of the piece there, and how far along the line its beginning is.
    std::size_t pieceAt(double along, double& before) const;

    const std::vector<glm::dvec2>& points_;
};

}  // namespace throng::authoring
