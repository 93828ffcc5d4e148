// SPDX-License-Identifier: Apache-2.0
// Who sits where, and what audiences do.
#include "authoring/scene/audience.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "authoring/layout/layout_reader.h"
#include "recording/audience.h"

namespace throng::authoring {
namespace {

Layout layoutOf(const std::string& rest) {
    Diagnostics diagnostics;
    const auto layout =
        readLayout(R"({"throng": 1, "simulation": {"duration": 60}, )" + rest + "}", {}, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        ADD_FAILURE() << entry.message;
    return layout.value_or(Layout{});
}

std::vector<std::string> mistakesOf(const std::string& rest) {
    Diagnostics diagnostics;
    readLayout(R"({"throng": 1, )" + rest + "}", {}, diagnostics);
    std::vector<std::string> found;
    for (const Diagnostic& entry : diagnostics.entries) {
        EXPECT_GT(entry.where.line, 0u);
        EXPECT_FALSE(entry.hint.empty()) << entry.message;
        found.push_back(entry.message);
    }
    return found;
}

const std::string kStraight =
    R"("seats": [{"id": "a", "front": [[0, 0], [10, 0]], "rows": 3, "rise": 0.4, "height": 1}])";
const std::string kRing =
    R"("seats": [{"id": "a", "arc": {"centre": [0, 0], "radius": 40, "from": 0, "to": 360}, "rows": 5}])";

recording::ActivityNow doing(const Spectator& who, double time) {
    return recording::activityAt(who.deeds, time);
}

TEST(Seats, OfAStraightBlockStandInRowsToTheRightAndLookToTheLeft) {
    const std::vector<Seat> seats = seatsOf(layoutOf(kStraight).seats.front());
    ASSERT_EQ(seats.size(), 60u);
    for (std::size_t i = 0; i < seats.size(); ++i) {
        EXPECT_NEAR(seats[i].place.x, 0.25 + 0.5 * static_cast<double>(i % 20), 1e-9);
        EXPECT_NEAR(seats[i].place.y, -0.8 * static_cast<double>(i / 20), 1e-9);
        EXPECT_NEAR(seats[i].height, 1.0 + 0.4 * static_cast<double>(i / 20), 1e-9);
        EXPECT_NEAR(seats[i].ahead.y, 1.0, 1e-9);
    }
}

TEST(Seats, LeaveAislesFree) {
    const Layout layout = layoutOf(
        R"("seats": [{"id": "a", "front": [[0, 0], [12, 0]], "rows": 2, "aisles": 2, "aisle_width": 1}])");
    for (const Seat& seat : seatsOf(layout.seats.front()))
        for (const double aisle : {4.0, 8.0})
            EXPECT_GE(std::abs(seat.place.x - aisle), 0.75 - 1e-9);
    EXPECT_EQ(standOutlines(layout.seats.front()).size(), 3u);
    EXPECT_EQ(layout.walls.size(), 3u);
    EXPECT_TRUE(layout.walls.front().closed);
}

TEST(Seats, OfAnArcLookAtItsMiddleAndGetMoreFurtherOut) {
    const Layout layout = layoutOf(kRing);
    std::vector<std::size_t> of_row(5, 0);
    for (const Seat& seat : seatsOf(layout.seats.front())) {
        const double radius = 40.0 + 0.8 * static_cast<double>(seat.row);
        EXPECT_NEAR(glm::length(seat.place), radius, 0.01);
        EXPECT_NEAR(glm::dot(seat.ahead, -glm::normalize(seat.place)), 1.0, 1e-9);
        ++of_row[seat.row];
    }
    for (std::size_t row = 0; row < of_row.size(); ++row)
        EXPECT_NEAR(static_cast<double>(of_row[row]),
                    2.0 * M_PI * (40.0 + 0.8 * static_cast<double>(row)) / 0.5, 1.0);
}

TEST(Seats, LookAtWhatThereIsToSee) {
    const Layout layout = layoutOf(R"("seats": [{"id": "a", "front": [[0, 0], [10, 0]], "facing": [5, 5]}])");
    for (const Seat& seat : seatsOf(layout.seats.front()))
        EXPECT_NEAR(glm::distance(seat.ahead, glm::normalize(glm::dvec2(5.0, 5.0) - seat.place)), 0.0, 1e-9);
}

TEST(Audiences, FillTheirShareOfTheSeatsAndAreTheSameForASeed) {
    const std::string half =
        R"("seats": [{"id": "a", "front": [[0, 0], [100, 0]], "rows": 20, "occupancy": 0.6,
        "people": {"groups": [0, 1, 0, 1]}}])";
    const std::vector<Spectator> one = audienceOf(layoutOf(half)), other = audienceOf(layoutOf(half));
    EXPECT_NEAR(static_cast<double>(one.size()) / 4000.0, 0.6, 0.01);
    ASSERT_EQ(one.size(), other.size());
    std::set<std::pair<std::size_t, long>> taken;
    std::size_t together = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].seat.place, other[i].seat.place);
        EXPECT_EQ(one[i].person.variation, other[i].person.variation);
        EXPECT_TRUE(taken.emplace(one[i].seat.row, std::lround(4.0 * one[i].seat.place.x)).second);
        if (one[i].party == i) continue;
        ++together;
        // Who belongs together sits side by side.
        EXPECT_EQ(one[i].party, one[i - 1].party);
        EXPECT_NEAR(glm::distance(one[i].seat.place, one[i - 1].seat.place), 0.5, 1e-9);
    }
    EXPECT_GT(together, one.size() / 2);
    Layout seeded = layoutOf(half);
    seeded.simulation.seed = 2;
    const std::vector<Spectator> others = audienceOf(seeded);
    EXPECT_FALSE(std::ranges::equal(
        one, others, {}, [](const Spectator& each) { return each.seat.place.x; },
        [](const Spectator& each) { return each.seat.place.x; }));
}

TEST(Shows, ChangeNothingBesides) {
    const std::vector<Spectator> quiet = audienceOf(layoutOf(kStraight));
    const std::vector<Spectator> loud =
        audienceOf(layoutOf(kStraight + R"(, "shows": [{"at": 5, "do": "clap"}])"));
    ASSERT_EQ(quiet.size(), loud.size());
    for (std::size_t i = 0; i < quiet.size(); ++i) {
        EXPECT_EQ(quiet[i].person.variation, loud[i].person.variation);
        EXPECT_EQ(quiet[i].deeds.size(), 1u);
        EXPECT_EQ(doing(quiet[i], 8.0).activity, ActivityCode::sits);
        EXPECT_EQ(doing(loud[i], 4.9).activity, ActivityCode::sits);
        EXPECT_EQ(doing(loud[i], 8.0).activity, ActivityCode::claps);
        EXPECT_EQ(doing(loud[i], 30.0).activity, ActivityCode::sits);
    }
}

TEST(Shows, BeginWithinThePeoplesTimesOfReaction) {
    const Layout layout = layoutOf(kRing + R"(, "shows": [{"at": 5, "do": "cheer"}])");
    std::vector<double> begins;
    for (const Spectator& each : audienceOf(layout))
        begins.push_back(each.deeds.at(1).begin - 5.0);
    std::ranges::sort(begins);
    EXPECT_NEAR(begins[begins.size() / 2], std::exp(-1.2), 0.01);
    EXPECT_NEAR(begins[begins.size() * 84 / 100] / begins[begins.size() / 2], std::exp(0.4), 0.05);
}

/// A pose at the end of one deed is that at the beginning of the next: whole cycles, or half of one there and
/// back.
TEST(Shows, GoOverIntoEachOtherWithoutAJump) {
    const Layout layout =
        layoutOf(kStraight + R"(, "shows": [{"at": 5, "do": "clap"}, {"at": 14, "do": "cheer"},
        {"at": 25, "do": "sing"}, {"at": 40, "do": "wave"}])");
    const auto isWayBack = [](ActivityCode code) {
        return code == ActivityCode::readies || code == ActivityCode::rises;
    };
    for (const Spectator& each : audienceOf(layout)) {
        std::set<ActivityCode> done;
        for (std::size_t i = 1; i < each.deeds.size(); ++i) {
            const Deed &before = each.deeds[i - 1], &after = each.deeds[i];
            const double end = before.phase + before.rate * (after.begin - before.begin);
            done.insert(after.activity);
            EXPECT_GE(before.rate, 0.0);
            EXPECT_GE(after.phase, end - 1e-6);
            const double last = end - std::floor(end + 1e-6),
                         first = after.phase - std::floor(after.phase + 1e-6);
            const bool ends_up = isWayBack(before.activity) && std::abs(last - 0.5) < 1e-6;
            EXPECT_TRUE(ends_up || std::abs(last) < 1e-5) << last;
            const bool begins_up = isWayBack(after.activity) && std::abs(first - 0.5) < 1e-6;
            EXPECT_TRUE(begins_up || std::abs(first) < 1e-5) << first;
            // From a stand to a stand, from the seat to the seat.
            const bool was_up =
                ends_up || (!isWayBack(before.activity) && before.activity != ActivityCode::sits);
            const bool is_up =
                begins_up || (!isWayBack(after.activity) && after.activity != ActivityCode::sits);
            EXPECT_EQ(was_up, is_up);
        }
        EXPECT_EQ(done.size(), 6u);
    }
}

TEST(Shows, RunAWaveAlongTheSeatsAtItsSpeed) {
    const Layout layout =
        layoutOf(kRing + R"(, "shows": [{"at": 3, "do": "wave", "from": [40, 0], "reaction": 0}])");
    for (const Spectator& each : audienceOf(layout)) {
        double angle = std::atan2(each.seat.place.y, each.seat.place.x);
        if (angle < 0.0) angle += 2.0 * M_PI;
        // The middle row is the third.
        double way = 41.6 * angle;
        const double around = 2.0 * M_PI * 41.6;
        if (way > around - 1.5) continue;  // where it begins
        ASSERT_GE(each.deeds.size(), 2u);
        EXPECT_NEAR(each.deeds[1].begin, 3.0 + way / 12.0, 0.05);
        // 15 seats of 0.5 m at 12 m/s from half up to half down.
        EXPECT_NEAR(each.deeds[2].begin - each.deeds[1].begin, 2.0 * 7.5 / 12.0, 1e-6);
        EXPECT_EQ(each.deeds[1].activity, ActivityCode::rises);
    }
}

TEST(Shows, SwayInOneRhythm) {
    const Layout layout = layoutOf(kStraight + R"(, "shows": [{"at": 5, "do": "sing", "for": 20}])");
    for (const Spectator& each : audienceOf(layout)) {
        const recording::ActivityNow now = doing(each, 12.0);
        EXPECT_EQ(now.activity, ActivityCode::sings);
        const double expected = (12.0 - 5.0) / 2.4, off = now.phase - expected;
        EXPECT_NEAR(off - std::round(off), 0.0, 1e-6);
    }
}

TEST(Seats, TellEveryMistake) {
    const auto first = [](const std::string& rest) {
        const std::vector<std::string> found = mistakesOf(rest);
        return found.empty() ? std::string() : found.front();
    };
    EXPECT_EQ(first(R"("seats": [{"id": "a"}])"),
              "a block of seats needs exactly one of `front` (the first row's points) and `arc` (part of a "
              "circle), "
              "this one has neither");
    EXPECT_EQ(first(R"("seats": [{"id": "a", "front": [[0, 0], [0.3, 0]]}])"),
              "block `a` has room for no seat");
    EXPECT_EQ(first(R"("seats": [{"id": "a", "arc": {"centre": [0, 0], "radius": 9, "from": 90, "to": 0}}])"),
              "the arc goes from 90 to 0 degrees: counter-clockwise, at most a whole round");
    EXPECT_EQ(first(R"("seats": [{"id": "a", "front": [[0, 0], [2, 0], [2, -2]], "rows": 9}])"),
              "block `a`: rows so far behind a first row that bends so sharply cross themselves");
    EXPECT_EQ(first(R"("shows": [{"at": 1, "do": "clap"}])"),
              "there is no audience: this layout has no seats");
    EXPECT_EQ(first(kStraight + R"(, "shows": [{"at": 1, "do": "clap", "who": ["b"]}])"),
              "there is no block of seats `b`");
    EXPECT_EQ(first(kStraight + R"(, "shows": [{"at": 1, "do": "clap", "speed": 3}])"),
              "`speed` is only of a wave");
    EXPECT_EQ(first(kStraight + R"(, "shows": [{"at": 1, "do": "wave", "for": 3}])"),
              "`for` is not of a wave");
    EXPECT_EQ(first(kStraight + R"(, "areas": [{"id": "x", "polygon": [[20,0],[22,0],[22,2]]}],
        "events": [{"at": 1, "go_to": "x", "who": ["a"]}])"),
              "`a` is a block of seats: its people keep them");
}

}  // namespace
}  // namespace throng::authoring
