// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/overrides/layers.h"

namespace throng::authoring {

/// How far beside their way people are, by frame or by metres walked: from one point to the next, and at both
/// ends from nothing and to nothing.
///
/// Between two points it goes over as 6x^5 - 15x^4 + 10x^3, which begins and ends without speed and without
/// acceleration and never goes beyond either. So the acceleration that it adds is known beforehand: kPeak
/// times the distance over the square of the time, at most.
class BendCurve {
  public:
    static constexpr double kPeak = 5.773502691896258;  ///< 10 over the root of 3

    /// @param before, after over how much it comes and goes
    BendCurve(const std::vector<BendPoint>& points, double before, double after);

    /// m.
    glm::dvec2 at(double where) const;
    double begins() const { return knots_.front().at; }
    double ends() const { return knots_.back().at; }

    /// s, over which so many metres add so much acceleration (m/s^2) and no more.
    static double timeFor(double distance, double acceleration);

  private:
    std::vector<BendPoint> knots_;
};

}  // namespace throng::authoring
