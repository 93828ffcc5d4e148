// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <vector>

#include "authoring/layout.h"

namespace throng::authoring {

/// The line that a row stands on, as a share of it goes from 0 to 1. A share means the same of all rows: it
/// lies on one straight line through them.
class RowLine {
  public:
    /// @param back m behind the first row
    RowLine(const SeatBlock& block, double back);

    double length() const { return lengthBetween(0.0, 1.0); }
    double lengthBetween(double from, double to) const;
    /// The share so many metres behind another; before it where they are less than 0.
    double advance(double from, double metres) const;
    glm::dvec2 at(double share) const;
    glm::dvec2 aheadAt(double share) const { return left_[pieceAt(share)]; }
    /// From one share to another, with the corners between them.
    std::vector<glm::dvec2> between(double from, double to) const;
    /// Whether it goes the way that the first row goes, everywhere.
    bool goesOn() const;
    const std::vector<double>& corners() const { return shares_; }
    glm::dvec2 leftOfPiece(std::size_t piece) const { return left_[piece]; }

  private:
    double lengthOfPiece(std::size_t i) const;
    std::size_t pieceAt(double share) const;
    std::vector<glm::dvec2> points_, left_;
    std::vector<double> shares_;
};

/// The lines of one block, each of which is made once: everybody's way crosses all rows before its own.
class RowLines {
  public:
    /// @param block outlives this
    explicit RowLines(const SeatBlock& block) : block_(&block) {}

    const SeatBlock& block() const { return *block_; }
    /// @param back m behind the first row
    const RowLine& at(double back) {
        const auto found = lines_.find(back);
        return found != lines_.end() ? found->second
                                     : lines_.emplace(back, RowLine(*block_, back)).first->second;
    }

  private:
    const SeatBlock* block_;
    std::map<double, RowLine> lines_;  // references to them stay good
};

}  // namespace throng::authoring
