// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "io/bake_reader.h"
#include "recording/wall_watch.h"

namespace throng::analysis {

/// Where people are led who walk to seats or leave them: blocks that have aisles, and these. The ground there
/// is nobody else's, and outlines of stands are no walls to them.
class BetweenRows {
  public:
    explicit BetweenRows(const io::Bake& bake);
    /// @param place as the bake's geometry has them; @param height m: others may walk under a stand
    bool has(glm::dvec2 place, double height) const;

  private:
    struct Heights {
        double low = -1.0e30, high = 1.0e30;  ///< m
    };
    struct Piece {
        std::vector<glm::dvec2> outline;
        glm::dvec2 lower, upper;
        Heights heights;
    };
    void add(std::vector<glm::dvec2> outline, Heights heights);
    void addWay(const std::vector<glm::dvec2>& line, const std::vector<double>& heights, double width);
    void addRowsWithPassages(const recording::BakeSeats& seats);

    std::vector<Piece> pieces_;
};

/// The walls of a bake but for outlines of stands under which others may walk, as there is a passage.
recording::WallWatch watchOf(const io::Bake& bake);

}  // namespace throng::analysis
