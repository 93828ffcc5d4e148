// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "authoring/layout/bent_link.h"
#include "base/polygon.h"

namespace throng::authoring {
namespace {

Link wide(double width) {
    Link link;
    link.id = "s";
    link.width = width;
    return link;
}

BentLink bent(const std::vector<glm::dvec2>& path, double width = 1.2, double high = 3.4,
              double riser = 0.17) {
    std::optional<BentLinkFault> fault;
    BentLink made = bend(wide(width), path, 0.0, high, riser, fault);
    EXPECT_FALSE(fault) << fault->message;
    return made;
}

std::string faultOf(const std::vector<glm::dvec2>& path, double width = 1.2) {
    std::optional<BentLinkFault> fault;
    const BentLink made = bend(wide(width), path, 0.0, 3.4, 0.17, fault);
    EXPECT_TRUE(made.landings.empty() == fault.has_value());
    return fault ? fault->message : "";
}

double areaOf(const std::vector<glm::dvec2>& polygon) {
    double area = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return area;
}

TEST(BentLinks, AQuarterTurnHasASquareLanding) {
    const BentLink made = bent({{0, 0}, {4, 0}, {4, 4}});
    ASSERT_EQ(made.flights.size(), 2u);
    ASSERT_EQ(made.landings.size(), 1u);
    EXPECT_NEAR(areaOf(made.landings[0].floor), 1.3 * 1.3, 1e-9);  // with the railings, 0.65 m to either side
    EXPECT_NEAR(made.flights[0].end.x, 4.0 - 0.65, 1e-9);
    EXPECT_NEAR(made.flights[1].begin.y, 0.65, 1e-9);
    EXPECT_NEAR(made.landings[0].height, 1.7, 1e-9);
    EXPECT_EQ(made.flights[1].id, "s, flight 2");
}

TEST(BentLinks, AHalfTurnHasOneLandingOverBothFlights) {
    const BentLink made = bent({{0, 0}, {4, 0}, {4, 1.5}, {0, 1.5}});
    ASSERT_EQ(made.landings.size(), 1u);
    ASSERT_EQ(made.landings[0].floor.size(), 4u);
    EXPECT_NEAR(areaOf(made.landings[0].floor), 1.3 * 2.8, 1e-9);
    EXPECT_NEAR(made.flights[1].begin.x, 3.35, 1e-9);
}

TEST(BentLinks, StepsAreAsHighInAllFlights) {
    // 20 risers over flights of 2.4 and 5.4 m: 6.15 of them make 6.
    const BentLink made = bent({{0, 0}, {3, 0}, {9, 0}});
    EXPECT_NEAR(made.landings[0].height, 6 * 0.17, 1e-9);
    EXPECT_NEAR(bent({{0, 0}, {3, 0}, {9, 0}}, 1.2, 3.4, 0.0).landings[0].height, 3.4 * 2.4 / 7.8, 1e-9);
}

TEST(BentLinks, LandingsMeetTheirFlightsAlongTheWholeWidthWhateverTheAngle) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> angle(-125.0, 125.0), length(4.0, 9.0), width(0.6, 3.0);
    for (int i = 0; i < 1234; ++i) {
        const double turn = angle(random) * std::numbers::pi / 180.0, w = width(random),
                     half = 0.5 * (w + 0.1);
        const double long_enough = length(random) + 2.0 * half * std::abs(std::tan(0.5 * turn));
        const glm::dvec2 corner(long_enough, 0.0), way(std::cos(turn), std::sin(turn));
        const BentLink made = bent({{0, 0}, corner, corner + long_enough * way}, w);
        ASSERT_EQ(made.landings.size(), 1u);
        const std::vector<glm::dvec2>& floor = made.landings[0].floor;
        EXPECT_GT(areaOf(floor), 0.0);  // counter-clockwise
        for (const auto& [place, along] :
             {std::pair{made.flights[0].end, glm::dvec2(1.0, 0.0)}, std::pair{made.flights[1].begin, -way}})
            for (const double aside : {-0.95, 0.0, 0.95}) {
                const glm::dvec2 on = place + aside * half * glm::dvec2(-along.y, along.x);
                EXPECT_TRUE(isWithin(floor, on + 1e-3 * along)) << i;
                EXPECT_FALSE(isWithin(floor, on - 1e-3 * along)) << i;
            }
    }
}

TEST(BentLinks, WhatCannotBeBuiltIsTold) {
    EXPECT_NE(faultOf({{0, 0}, {4, 0}, {0, 0.5}}).find("173 degrees"), std::string::npos);
    EXPECT_NE(faultOf({{0, 0}, {4, 0}, {4, 1.2}, {0, 1.2}}).find("in one place"), std::string::npos);
    EXPECT_NE(faultOf({{0, 0}, {1, 0}, {1, 5}}).find("0.35 m left"), std::string::npos);
    EXPECT_EQ(faultOf({{0, 0}, {4, 0}, {4, 1.3}, {0, 1.3}}),
              "");  // flights beside each other, railing at railing
}

}  // namespace
}  // namespace throng::authoring
