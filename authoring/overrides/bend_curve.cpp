// SPDX-License-Identifier: Apache-2.0
#include "authoring/overrides/bend_curve.h"

#include <algorithm>
#include <cmath>

namespace throng::authoring {

BendCurve::BendCurve(const std::vector<BendPoint>& points, double before, double after) {
    knots_.push_back({points.front().at - before, glm::dvec2(0.0)});
    knots_.insert(knots_.end(), points.begin(), points.end());
    knots_.push_back({points.back().at + after, glm::dvec2(0.0)});
}

glm::dvec2 BendCurve::at(double where) const {
    const auto next = std::ranges::upper_bound(knots_, where, {}, &BendPoint::at);
    if (next == knots_.begin() || next == knots_.end()) return glm::dvec2(0.0);
    const BendPoint &from = *(next - 1), &to = *next;
    const double x = (where - from.at) / (to.at - from.at);
    return from.by + (to.by - from.by) * (x * x * x * (10.0 + x * (6.0 * x - 15.0)));
}

double BendCurve::timeFor(double distance, double acceleration) {
    return std::sqrt(kPeak * distance / acceleration);
}

}  // namespace throng::authoring
