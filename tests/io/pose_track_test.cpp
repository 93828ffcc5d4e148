// SPDX-License-Identifier: Apache-2.0
// What somebody is shown to do with its hands and in a seat: whole cycles, and no jumps.
#include "recording/pose_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace throng::recording {
namespace {

using Code = ActivityCode;
constexpr double kFrame = 1.0 / 24.0;

struct Shown {
    Code activity;
    double phase;
};

/// What is shown, frame by frame, of what is wished.
std::vector<Shown> shownOf(const std::vector<PoseWish>& wishes, double phase = 3.3) {
    PoseTrack track;
    std::vector<Shown> shown;
    for (const PoseWish& wish : wishes) {
        track.step(wish, phase);
        shown.push_back(track.isShown() ? Shown{track.activity(), track.phase()}
                                        : Shown{Code::stands, phase});
    }
    return shown;
}

std::vector<PoseWish> wishesFor(std::initializer_list<std::pair<Code, double>> parts) {
    std::vector<PoseWish> wishes;
    for (const auto& [activity, seconds] : parts)
        wishes.insert(wishes.end(), static_cast<std::size_t>(std::lround(seconds / kFrame)),
                      {activity, 0.0, 0.0, 0.5, kFrame});
    return wishes;
}

std::vector<Code> orderOf(const std::vector<Shown>& shown) {
    std::vector<Code> order;
    for (const Shown& each : shown)
        if (order.empty() || order.back() != each.activity) order.push_back(each.activity);
    return order;
}

double fractionAt(double phase) {
    return phase - std::floor(phase + 1.0e-9);
}

TEST(PoseTrack, RaisesHandsBeforeAndLetsThemDownAfterwards) {
    const auto shown = shownOf(wishesFor({{Code::stands, 1.0}, {Code::applauds, 4.0}, {Code::stands, 2.0}}));
    EXPECT_EQ(orderOf(shown),
              (std::vector{Code::stands, Code::raises, Code::applauds, Code::raises, Code::stands}));
    // Down again within what the simulation waits (shaders/behaviour/letting_go.glsl).
    const auto at = [](double seconds) { return static_cast<std::size_t>(std::lround(seconds / kFrame)); };
    EXPECT_EQ(shown[at(5.0 + 0.9)].activity, Code::stands);
    for (std::size_t i = 1; i < shown.size(); ++i)
        EXPECT_GE(shown[i].phase, shown[i].activity == Code::stands ? 0.0 : shown[i - 1].phase);
}

TEST(PoseTrack, BeginsAndEndsAtWholeCycles) {
    for (const Code code : {Code::applauds, Code::jubilates, Code::sways, Code::waves}) {
        const auto shown = shownOf(wishesFor({{code, 3.0}, {Code::stands, 2.0}}));
        for (std::size_t i = 1; i < shown.size(); ++i) {
            if (shown[i].activity == shown[i - 1].activity) continue;
            if (shown[i].activity == code || shown[i].activity == Code::stands) {
                EXPECT_NEAR(fractionAt(shown[i].activity == code ? shown[i].phase : 0.0), 0.0, 1e-6);
            }
            if (shown[i - 1].activity == code) {
                EXPECT_EQ(shown[i].activity, Code::raises);
                EXPECT_NEAR(fractionAt(shown[i].phase), 0.5, 1e-6) << "hands are up";
            }
        }
    }
}

TEST(PoseTrack, GoesFromOneToTheOtherWithHandsUp) {
    const auto shown = shownOf(wishesFor({{Code::applauds, 3.0}, {Code::waves, 3.0}}));
    EXPECT_EQ(orderOf(shown), (std::vector{Code::raises, Code::applauds, Code::raises, Code::waves}));
    int frames = 0;
    for (std::size_t i = 20; i < shown.size(); ++i)
        frames += shown[i].activity == Code::raises;
    EXPECT_LE(frames, 1);
}

TEST(PoseTrack, InSeatsAudiencesWaysLead) {
    const auto shown =
        shownOf(wishesFor({{Code::sits, 2.0}, {Code::claps, 2.0}, {Code::cheers, 3.0}, {Code::sits, 3.0}}));
    EXPECT_EQ(orderOf(shown), (std::vector{Code::sits, Code::readies, Code::claps, Code::readies, Code::sits,
                                           Code::rises, Code::cheers, Code::rises, Code::sits}));
}

TEST(PoseTrack, SettlesAsFarAsItIsTold) {
    std::vector<PoseWish> wishes;
    for (const double share : {1.0, 0.8, 0.4, 0.1, 0.5, 0.9, 1.0, 1.0, 0.5, 0.0})
        wishes.push_back({Code::settles, share, 0.0, 0.5, kFrame});
    const auto shown = shownOf(wishes, 7.9);
    double before = 7.9;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        EXPECT_EQ(shown[i].activity, Code::settles);
        const double fraction = shown[i].phase - std::floor(shown[i].phase);
        EXPECT_NEAR(1.0 - std::abs(2.0 * fraction - 1.0), wishes[i].share, 1e-6) << i;
        EXPECT_GE(shown[i].phase, before);
        EXPECT_LE(shown[i].phase, before + 1.0);
        before = shown[i].phase;
    }
}

TEST(PoseTrack, WhoWalksOffHasNoHandsUp) {
    auto wishes = wishesFor({{Code::applauds, 2.0}, {Code::under_way, 1.0}});
    for (std::size_t i = 50; i < wishes.size(); ++i)
        wishes[i].speed = 1.2;
    EXPECT_EQ(shownOf(wishes)[50].activity, Code::stands);
}

}  // namespace
}  // namespace throng::recording
