// SPDX-License-Identifier: Apache-2.0
#include "recording/gazes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>

namespace throng::recording {
namespace {

constexpr double kFps = 24.0;

Onlooker onlooker(std::uint32_t row, glm::dvec2 place, double faces, double speed) {
    return {row, row, place, 0.0, {std::cos(faces), std::sin(faces)}, speed};
}

/// What becomes of the first of some people over time.
std::vector<Gaze> gazes(const std::function<std::vector<Onlooker>(double)>& people, double seconds,
                        std::uint32_t row = 0) {
    Gazes gazes(64, kFps, {-50.0, -50.0}, {50.0, 50.0});
    std::vector<Gaze> found;
    for (int frame = 0; frame < seconds * kFps; ++frame) {
        gazes.look(people(frame / kFps));
        found.push_back(gazes[row]);
    }
    return found;
}

double share(const std::vector<Gaze>& gazes, const std::function<bool(const Gaze&)>& is) {
    return static_cast<double>(std::ranges::count_if(gazes, is)) / static_cast<double>(gazes.size());
}

double meanYaw(const std::vector<Gaze>& gazes) {
    return std::accumulate(gazes.begin(), gazes.end(), 0.0,
                           [](double sum, const Gaze& each) { return sum + each.yaw; }) /
           static_cast<double>(gazes.size());
}

TEST(Gazes, OfThoseWhoWalkAloneAreMostlyAheadAndSometimesAside) {
    const auto found = gazes(
        [](double t) {
            return std::vector{onlooker(0, {1.3 * t - 40.0, 0.0}, 0.0, 1.3)};
        },
        60.0);
    EXPECT_GT(share(found, [](const Gaze& each) { return std::abs(each.yaw) < 0.15; }), 0.5);
    EXPECT_GT(share(found, [](const Gaze& each) { return std::abs(each.yaw) > 0.3; }), 0.03);
    EXPECT_LT(std::abs(meanYaw(found)), 0.15);
    EXPECT_EQ(share(found, [](const Gaze& each) { return each.at == 0.0f; }), 1.0);
}

TEST(Gazes, GoIntoATurnBeforeTheBody) {
    for (const double side : {1.0, -1.0}) {
        const auto turn = [&](double t) { return std::vector{onlooker(0, {0.0, 0.0}, side * 0.8 * t, 1.3)}; };
        EXPECT_NEAR(meanYaw(gazes(turn, 120.0)), side * 0.8 * 0.3, 0.1);
    }
}

TEST(Gazes, OfThoseWhoStandTogetherMeet) {
    const auto pair = [](double) {
        std::vector<Onlooker> both{onlooker(0, {0.0, 0.0}, 0.0, 0.0), onlooker(1, {1.0, 0.5}, 3.14, 0.0)};
        both[1].party = 0;
        return both;
    };
    const auto found = gazes(pair, 120.0);
    EXPECT_GT(share(found, [](const Gaze& each) { return each.at == 2.0f; }), 0.4);
    EXPECT_LT(share(found, [](const Gaze& each) { return each.at == 2.0f; }), 0.95) << "nobody stares";
    const double there = std::atan2(0.5, 1.0);
    for (std::size_t frame = 24; frame < found.size(); ++frame)
        if (std::all_of(found.begin() + static_cast<std::ptrdiff_t>(frame) - 20,
                        found.begin() + static_cast<std::ptrdiff_t>(frame),
                        [](const Gaze& each) { return each.at == 2.0f; })) {
            EXPECT_NEAR(found[frame - 1].yaw, there, 0.02);
        }
}

TEST(Gazes, FallOnWhoComesAndLeaveWhoHasPassed) {
    int looked = 0;
    for (std::uint32_t row = 0; row < 32; ++row) {
        const auto meet = [&](double t) {
            return std::vector{onlooker(row, {1.3 * t, 0.0}, 0.0, 1.3),
                               onlooker(63, {13.0 - 1.3 * t, 0.7}, 3.14159, 1.3)};
        };
        const auto found = gazes(meet, 10.0, row);
        looked += std::ranges::any_of(found, [](const Gaze& each) { return each.at == 64.0f; });
        for (std::size_t frame = 0; frame < found.size(); ++frame)
            if (found[frame].at == 64.0f) {
                EXPECT_LT(static_cast<double>(frame) / kFps, 5.0) << "they meet after 5 s";
            }
    }
    EXPECT_GT(looked, 8);
    EXPECT_LT(looked, 32);
}

TEST(Gazes, TurnAsFastAsNecksAndAsFar) {
    const auto crowd = [](double t) {
        std::vector<Onlooker> people;
        for (std::uint32_t row = 0; row < 64; ++row)
            people.push_back(
                onlooker(row, {2.0 * std::sin(row + t), 2.0 * std::cos(1.7 * row + t)}, row + 0.9 * t, 0.8));
        return people;
    };
    const auto found = gazes(crowd, 60.0);
    for (std::size_t frame = 1; frame < found.size(); ++frame) {
        ASSERT_LE(std::abs(found[frame].yaw), 1.2f);
        ASSERT_LT(std::abs(found[frame].yaw - found[frame - 1].yaw), 0.34f) << "8 rad/s";
    }
}

TEST(Gazes, GoOnFromWhatIsKeptOfThem) {
    const auto people = [](int frame) {
        return std::vector{onlooker(0, {0.05 * frame, 0.0}, 0.01 * frame, 1.2),
                           onlooker(1, {12.0 - 0.05 * frame, 0.5}, 3.1, 1.2)};
    };
    Gazes whole(2, kFps, {-20.0, -20.0}, {20.0, 20.0}), first = whole, second = whole;
    for (int frame = 0; frame < 200; ++frame)
        whole.look(people(frame));
    for (int frame = 0; frame < 77; ++frame)
        first.look(people(frame));
    std::ranges::copy(first.state(), second.state().begin());
    for (int frame = 77; frame < 200; ++frame)
        second.look(people(frame));
    for (const std::size_t row : {0u, 1u}) {
        EXPECT_EQ(second[row].yaw, whole[row].yaw);
        EXPECT_EQ(second[row].pitch, whole[row].pitch);
        EXPECT_EQ(second[row].at, whole[row].at);
    }
}

}  // namespace
}  // namespace throng::recording
