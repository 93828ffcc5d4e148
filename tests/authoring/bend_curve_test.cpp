// SPDX-License-Identifier: Apache-2.0
#include "authoring/overrides/bend_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace throng::authoring {
namespace {

TEST(BendCurve, GoesThroughItsPointsAndIsNothingBeyondItsEnds) {
    const BendCurve curve({{10.0, {0.0, 2.0}}, {30.0, {1.0, -2.0}}}, 8.0, 20.0);
    EXPECT_EQ(curve.begins(), 2.0);
    EXPECT_EQ(curve.ends(), 50.0);
    EXPECT_EQ(curve.at(-5.0), glm::dvec2(0.0));
    EXPECT_EQ(curve.at(2.0), glm::dvec2(0.0));
    EXPECT_EQ(curve.at(10.0), glm::dvec2(0.0, 2.0));
    EXPECT_EQ(curve.at(30.0), glm::dvec2(1.0, -2.0));
    EXPECT_EQ(curve.at(50.0), glm::dvec2(0.0));
    EXPECT_EQ(curve.at(1.0e9), glm::dvec2(0.0));
    const glm::dvec2 middle = curve.at(20.0);
    EXPECT_NEAR(middle.x, 0.5, 1e-12);
    EXPECT_NEAR(middle.y, 0.0, 1e-12);
    // 6x^5 - 15x^4 + 10x^3 at a quarter is 106/1024.
    EXPECT_NEAR(curve.at(4.0).y, 2.0 * 106.0 / 1024.0, 1e-12);
}

TEST(BendCurve, IsSmoothAndAddsNoMoreAccelerationThanItSays) {
    constexpr double kDistance = 1.5, kMost = 0.8, kFine = 1.0e-3;
    const double time = BendCurve::timeFor(kDistance, kMost);
    const BendCurve curve({{10.0, {0.0, kDistance}}}, time, time);
    double most = 0.0, jump = 0.0, before = 0.0;
    for (double at = 10.0 - time - 0.1; at < 10.0 + time + 0.1; at += kFine) {
        const double acceleration =
            (curve.at(at + kFine).y - 2.0 * curve.at(at).y + curve.at(at - kFine).y) / (kFine * kFine);
        most = std::max(most, std::abs(acceleration));
        jump = std::max(jump, std::abs(acceleration - before));
        before = acceleration;
    }
    EXPECT_NEAR(most, kMost, 1e-3 * kMost);
    EXPECT_LT(jump, 0.01) << "not even the acceleration jumps";
}

}  // namespace
}  // namespace throng::authoring
