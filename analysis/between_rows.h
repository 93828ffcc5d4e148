// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "io/bake_reader.h"

namespace throng::analysis {

/// Where people are led who walk to seats or leave them: blocks that have aisles, and these. The ground there
/// is nobody else's, and outlines of stands are no walls to them.
class BetweenRows {
  public:
    explicit BetweenRows(const io::Bake& bake);
    /// @param place as the bake's geometry has them
    bool has(glm::dvec2 place) const;

  private:
    struct Piece {
        std::vector<glm::dvec2> outline;
        glm::dvec2 lower, upper;
    };
    void add(std::vector<glm::dvec2> outline);

    std::vector<Piece> pieces_;
};

}  // namespace throng::analysis
