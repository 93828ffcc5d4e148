// SPDX-License-Identifier: Apache-2.0
// Who gets which seat, and the ways there.
#include "authoring/scene/seat_plan.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/scene_builder.h"

namespace throng::authoring {
namespace {

Layout layoutOf(const std::string& rest) {
    Diagnostics diagnostics;
    const auto layout = readLayout(
        R"({"throng": 1, "areas": [{"id": "gate", "polygon": [[-12, 6], [-8, 6], [-8, 10], [-12, 10]]}], )" +
            rest + "}",
        {}, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        ADD_FAILURE() << entry.message;
    return layout.value_or(Layout{});
}

/// 60 seats.
const std::string kOpen =
    R"("seats": [{"id": "a", "front": [[0, 0], [10, 0]], "rows": 3, "rise": 0.4, "height": 1, "occupancy": 0.4,
       "leave": {"at": 5, "to": "gate"}}])";

std::vector<Party> partiesOf(std::initializer_list<std::uint32_t> sizes) {
    std::vector<Party> parties;
    std::uint64_t first = 0;
    for (const std::uint32_t size : sizes) {
        parties.push_back({first, size});
        first += size;
    }
    return parties;
}

TEST(SeatPlan, GivesEverybodyASeatOfItsOwnAndPartiesNeighbours) {
    const Layout layout = layoutOf(kOpen);
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        SeatPlan plan(layout);
        std::vector<Party> parties;
        std::uint64_t people = 0;
        for (std::uint32_t i = 0; people < 60; ++i) {
            const auto size = static_cast<std::uint32_t>(std::min<std::uint64_t>(1 + i % 4, 60 - people));
            parties.push_back({people, size});
            people += size;
        }
        EXPECT_EQ(plan.countFree({0}), 60u);
        const std::vector<SeatNumber> seats = plan.seat(parties, {0}, GroupRandom(seed, "guests"));
        EXPECT_EQ(plan.countFree({0}), 0u);
        EXPECT_EQ(std::set<SeatNumber>(seats.begin(), seats.end()).size(), 60u);
        for (const Party& party : parties)
            for (std::uint64_t i = party.first + 1; i < party.first + party.size; ++i)
                EXPECT_NEAR(glm::distance(plan.at(seats[i]).place, plan.at(seats[i - 1]).place), 0.5, 1e-9);
    }
}

TEST(SeatPlan, SeatsThoseApartForWhomThereIsNoRoomTogether) {
    const Layout layout = layoutOf(kOpen);
    SeatPlan plan(layout);
    for (std::size_t seat = 0; seat < 60; ++seat)
        if (seat % 2 == 1) plan.take({0, seat});
    const std::vector<SeatNumber> seats = plan.seat(partiesOf({4, 3, 2}), {0}, GroupRandom(1, "guests"));
    EXPECT_EQ(std::set<SeatNumber>(seats.begin(), seats.end()).size(), 9u);
    for (const SeatNumber& seat : seats)
        EXPECT_EQ(seat.seat % 2, 0u);
}

TEST(SeatWays, LeadUpAnAisleAndAlongARow) {
    const Layout layout = layoutOf(kOpen);
    Diagnostics diagnostics;
    const auto scene = buildScene(layout, diagnostics);
    ASSERT_TRUE(scene);
    const SeatWays& seats = scene->seats;
    EXPECT_EQ(seats.ways.size(), 24u);
    for (std::size_t i = 0; i < seats.ways.size(); ++i) {
        const gpu::SeatWay& way = seats.ways[i];
        EXPECT_EQ(seats.sitter_of_row[way.row], i);
        EXPECT_GE(i, way.first_of_aisle);
        EXPECT_LT(i, way.first_of_aisle + way.count_of_aisle);
        const std::span points(&seats.points[way.first_point], way.point_count);
        EXPECT_EQ(points.front().height, 0.0f);
        EXPECT_NEAR(points.back().height, way.height, 1e-6);
        EXPECT_NEAR(way.height, 1.0 + 0.4 * (way.lane / 2), 1e-5);
        EXPECT_NEAR(glm::distance(points.back().place, way.place), 0.3, 1e-4) << "before its knees";
        EXPECT_NEAR(points.back().along, way.length, 1e-5);
        // Everybody comes by the end that is nearer: half of a row of 10 m, and 0.45 m beside it.
        EXPECT_LT(way.length - way.mouth, 5.45f);
        EXPECT_EQ(seats.sitters[i].mode, gpu::SITTER_SITS);
        for (std::size_t p = 1; p < points.size(); ++p)
            EXPECT_NEAR(points[p].along - points[p - 1].along,
                        glm::distance(points[p].place, points[p - 1].place), 1e-4);
    }
}

TEST(SeatWays, AreNoneWhereNobodyWalksToSeats) {
    Diagnostics diagnostics;
    const auto scene =
        buildScene(layoutOf(R"("seats": [{"id": "a", "front": [[0, 0], [10, 0]]}])"), diagnostics);
    ASSERT_TRUE(scene);
    EXPECT_TRUE(scene->seats.empty());
    EXPECT_TRUE(scene->people.empty());
}

}  // namespace
}  // namespace throng::authoring
