// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>

#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/fields.h"

namespace throng::authoring {

/// From world coordinates (double) to the scene frame (float), see Scene::origin.
class Rebase {
  public:
    /// Finds the origin and the bounds of a layout: everything drawn, everybody, and every goal.
    explicit Rebase(const Layout& layout);

    glm::vec2 local(glm::dvec2 world) const;
    std::vector<glm::vec2> local(const std::vector<glm::dvec2>& world) const;

    glm::dvec2 origin() const { return origin_; }
    glm::dvec2 outputOrigin() const { return output_origin_; }
    glm::vec2 minimum() const { return minimum_; }
    glm::vec2 maximum() const { return maximum_; }
    /// Of the longer side, m.
    double extent() const { return extent_; }
    /// Where what reaches furthest along it stands in the file.
    const SourcePosition& outermost() const { return outermost_; }

  private:
    glm::dvec2 origin_{0.0};
    glm::dvec2 output_origin_{0.0};
    glm::vec2 minimum_{0.0f};
    glm::vec2 maximum_{0.0f};
    double extent_ = 0.0;
    SourcePosition outermost_;
};

/// A formation's people in world coordinates, and their goals where these are points.
struct FormationPlaces {
    std::vector<glm::dvec2> positions;
    std::vector<glm::dvec2> goals;  ///< empty when the goal is a place
};
FormationPlaces formationPlaces(const Formation& formation, std::uint64_t seed);

}  // namespace throng::authoring
