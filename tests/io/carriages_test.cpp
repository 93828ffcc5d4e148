// SPDX-License-Identifier: Apache-2.0
#include "recording/carriages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace throng::recording {
namespace {

constexpr float kRadius = 0.22f;

Onlooker onlooker(std::uint32_t row, glm::dvec2 place, double faces, double speed) {
    return {row, row, place, 0.0, {std::cos(faces), std::sin(faces)}, speed};
}

using People = std::function<std::vector<Onlooker>(double)>;

/// What becomes of one of some people over time.
std::vector<Carriage> carried(const People& people, double seconds, std::uint32_t row = 0,
                              double fps = 24.0) {
    Carriages carriages(std::vector<float>(8, kRadius), fps, {-50.0, -50.0}, {50.0, 50.0});
    std::vector<Carriage> found;
    for (int frame = 0; frame < seconds * fps; ++frame) {
        const std::vector<Onlooker> there = people(frame / fps);
        for (const Onlooker& each : there)
            carriages.step(each.row, each.speed);
        carriages.squeeze(there);
        found.push_back(carriages[row]);
    }
    return found;
}

/// Of one person whose speed is told.
std::vector<Carriage> atSpeeds(const std::function<double(double)>& speed, double seconds,
                               double fps = 24.0) {
    return carried(
        [&](double t) {
            return std::vector{onlooker(0, {0.0, 0.0}, 0.0, speed(t))};
        },
        seconds, 0, fps);
}

double largestChange(const std::vector<Carriage>& found, float Carriage::*what) {
    double most = 0.0;
    for (std::size_t frame = 1; frame < found.size(); ++frame)
        most = std::max<double>(most, std::abs(found[frame].*what - found[frame - 1].*what));
    return most;
}

double most(const std::vector<Carriage>& found, float Carriage::*what, double sign = 1.0) {
    double value = 0.0;
    for (const Carriage& each : found)
        value = std::max(value, sign * each.*what);
    return value;
}

/// Two people who pass each other, in the middle of three seconds; the other one so far to the left of the
/// way.
People meeting(double aside) {
    return [aside](double t) {
        return std::vector{onlooker(0, {1.3 * (t - 1.5), 0.0}, 0.0, 1.3),
                           onlooker(1, {-1.3 * (t - 1.5), aside}, 3.14159265, 1.3)};
    };
}

TEST(Carriages, TellWhoStandsFromWhoWalksFromTheFirstFrameOn) {
    for (const Carriage& each : atSpeeds([](double) { return 0.0; }, 2.0)) {
        EXPECT_EQ(each.walking, 0.0f);
        EXPECT_EQ(each.lean, 0.0f);
    }
    for (const Carriage& each : atSpeeds([](double) { return 1.3; }, 2.0)) {
        EXPECT_EQ(each.walking, 1.0f);
        EXPECT_EQ(each.lean, 0.0f);
    }
}

TEST(Carriages, TakeAThirdOfASecondToStopHoweverSuddenlyTheBodyDoes) {
    for (const double fps : {24.0, 60.0}) {
        const auto found = atSpeeds([](double t) { return t < 1.0 ? 1.3 : 0.0; }, 3.0, fps);
        const auto at = [&](double t) { return found[static_cast<std::size_t>(t * fps)].walking; };
        EXPECT_GT(at(1.1), 0.5f);
        EXPECT_LT(at(1.5), 0.1f);
        EXPECT_LT(largestChange(found, &Carriage::walking), 4.3 / fps);
        for (std::size_t frame = 1; frame < found.size(); ++frame)
            ASSERT_LE(found[frame].walking, found[frame - 1].walking) << "nobody walks on meanwhile";
    }
}

TEST(Carriages, HardlyNoticeAStopOfTwoFrames) {
    const auto found = atSpeeds([](double t) { return t > 1.0 && t < 1.0 + 1.9 / 24.0 ? 0.0 : 1.3; }, 3.0);
    EXPECT_LT(largestChange(found, &Carriage::walking), 0.2);
    EXPECT_GT(1.0 - most(found, &Carriage::walking, -1.0), 0.6);
    for (const Carriage& each : found)
        EXPECT_GT(each.walking, 0.6f);
}

TEST(Carriages, LeanIntoSettingOffAndBackInStopping) {
    const auto sets_off = atSpeeds([](double t) { return std::clamp(2.0 * (t - 1.0), 0.0, 1.4); }, 4.0);
    EXPECT_NEAR(most(sets_off, &Carriage::lean), 0.1, 0.025);
    EXPECT_LT(most(sets_off, &Carriage::lean, -1.0), 0.01);
    EXPECT_NEAR(sets_off.back().lean, 0.0f, 1e-3f);
    EXPECT_LT(largestChange(sets_off, &Carriage::lean), 0.03);
    const auto stops = atSpeeds([](double t) { return std::clamp(1.4 - 2.0 * (t - 1.0), 0.0, 1.4); }, 4.0);
    EXPECT_NEAR(most(stops, &Carriage::lean, -1.0), 0.06, 0.02);
}

TEST(Carriages, TurnTheShoulderBackOnTheSideOfWhoPasses) {
    for (const double side : {1.0, -1.0}) {
        const auto found = carried(meeting(side * 0.5), 3.0);
        EXPECT_GT(most(found, &Carriage::twist, side), 0.25);
        EXPECT_LT(most(found, &Carriage::twist, -side), 0.01);
        EXPECT_EQ(found.front().twist, 0.0f) << "far away nobody turns";
        EXPECT_NEAR(found.back().twist, 0.0f, 0.02f) << "and turns back behind";
        EXPECT_LT(largestChange(found, &Carriage::twist), 0.15);
        const auto other = carried(meeting(side * 0.5), 3.0, 1);
        EXPECT_NEAR(most(other, &Carriage::twist, side), most(found, &Carriage::twist, side), 1e-3)
            << "both do, alike";
    }
}

TEST(Carriages, TurnTheLessTheMoreRoomThereIs) {
    const double close = most(carried(meeting(0.46), 3.0), &Carriage::twist);
    const double near = most(carried(meeting(0.58), 3.0), &Carriage::twist);
    EXPECT_GT(close, 1.5 * near);
    EXPECT_GT(near, 0.02);
    EXPECT_LT(most(carried(meeting(0.9), 3.0), &Carriage::twist), 1e-6);
}

TEST(Carriages, GoSidewaysBetweenTwoPeopleWithoutTurningTwice) {
    const auto between = [](double t) {
        return std::vector{onlooker(0, {1.2 * (t - 1.5), 0.0}, 0.0, 1.2), onlooker(1, {0.0, 0.48}, 0.0, 0.0),
                           onlooker(2, {0.1, -0.47}, 0.0, 0.0)};
    };
    const auto found = carried(between, 3.0);
    const double left = most(found, &Carriage::twist), right = most(found, &Carriage::twist, -1.0);
    EXPECT_GT(std::max(left, right), 0.3);
    EXPECT_LT(std::min(left, right), 0.02);
}

TEST(Carriages, StayStraightAmongThoseWhoGoTheSameWayAndInQueues) {
    for (const double speed : {0.0, 1.3}) {
        const auto crowd = [&](double t) {
            std::vector<Onlooker> people;
            for (std::uint32_t row = 0; row < 8; ++row)
                people.push_back(
                    onlooker(row, {0.45 * (row / 3u) + speed * t, 0.45 * (row % 3u)}, 0.0, speed));
            return people;
        };
        const auto found = carried(crowd, 2.0, 4);
        EXPECT_EQ(most(found, &Carriage::twist), 0.0);
        EXPECT_EQ(most(found, &Carriage::twist, -1.0), 0.0);
    }
}

}  // namespace
}  // namespace throng::recording
