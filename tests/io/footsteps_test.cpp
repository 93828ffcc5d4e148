// SPDX-License-Identifier: Apache-2.0
#include "recording/footsteps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "recording/carriages.h"

namespace throng::recording {
namespace {

constexpr double kTurnRound = 2.0 * std::numbers::pi;

/// Somebody at a time: where, and which way they face.
struct Place {
    glm::dvec2 at{0.0};
    double faces = 0.0;  ///< rad
};

/// What became of both feet in a frame.
struct Seen {
    std::array<FootMove, 2> moves;
    std::array<glm::dvec2, 2> feet;   ///< m: where they are in the world, of a clip that this test has itself
    std::array<bool, 2> clip_stands;  ///< whether the clip's foot is planted
};

/// Where a planted foot of a walk is ahead of the body, and whether it is planted; in the air, anywhere.
std::pair<double, bool> clipFoot(double phase, double stride) {
    const double own = phase - std::floor(phase);
    const bool stands = own < 0.62 - 0.09 * (stride / 1.446 - 1.0);
    return {(kUnderBody - own) * stride, stands};
}

std::vector<Seen> walk(const std::function<Place(double)>& way, double seconds, double fps = 24.0) {
    Footsteps footsteps(1, fps);
    Carriages carriages({0.2f}, fps, {-50.0, -50.0}, {50.0, 50.0});
    GaitTrack gait{0.0, 3};
    std::vector<Seen> seen;
    Place before = way(0.0);
    for (int frame = 0; frame < seconds * fps; ++frame) {
        const Place now = way(frame / fps);
        const double moved = glm::distance(now.at, before.at);
        const double begins = glm::distance(way(1.0 / fps).at, now.at) * fps;
        if (frame == 0) gait.gait = gaitFor(begins);
        if (frame > 0) gait.advance(moved, 1.0 / fps);
        const glm::vec2 heading(std::cos(now.faces), std::sin(now.faces));
        const auto speed = static_cast<float>(frame > 0 ? moved * fps : begins);
        const float walking = carriages.step(0, speed);
        Seen each{footsteps.step(0, {now.at, heading, now.at - before.at, speed, walking}, gait), {}, {}};
        for (const std::size_t side : {0u, 1u}) {
            const auto [ahead, stands] = clipFoot(gait.phase + (side == 0 ? 0.5 : 0.0), strideOf(gait.gait));
            const glm::dvec2 along(heading), left(-along.y, along.x);
            each.feet[side] = now.at + (walking * ahead + each.moves[side].forward) * along +
                              ((side == 0 ? 0.06 : -0.06) + each.moves[side].left) * left;
            each.clip_stands[side] = stands;
        }
        seen.push_back(each);
        before = now;
    }
    return seen;
}

/// The furthest that a foot goes in a frame while it and its clip's are on the ground, m.
double furthestSlide(const std::vector<Seen>& seen, std::size_t from = 1) {
    double most = 0.0;
    for (std::size_t frame = from; frame < seen.size(); ++frame)
        for (const std::size_t side : {0u, 1u})
            if (seen[frame].clip_stands[side] && seen[frame - 1].clip_stands[side] &&
                seen[frame].moves[side].lift == 0.0f)
                most = std::max(most, glm::distance(seen[frame].feet[side], seen[frame - 1].feet[side]));
    return most;
}

TEST(Footsteps, LeavesFeetOfThoseWhoWalkStraightOnWhereTheClipHasThem) {
    for (const Seen& each : walk([](double t) { return Place{{1.3 * t, 0.0}, 0.0}; }, 10.0))
        for (const FootMove& move : each.moves) {
            ASSERT_LT(std::hypot(move.forward, move.left), 0.002);
            ASSERT_EQ(move.turn, 0.0f);
            ASSERT_EQ(move.lift, 0.0f);
        }
}

TEST(Footsteps, HoldFeetOfThoseWhoWalkInACircle) {
    const auto round = [](double t) {
        const double angle = 0.5 * t;
        return Place{2.4 * glm::dvec2(std::cos(angle), std::sin(angle)), angle + kTurnRound / 4.0};
    };
    EXPECT_LT(furthestSlide(walk(round, 30.0), 24), 5e-4);
}

TEST(Footsteps, HoldFeetOfThoseWhoDriftAside) {
    const auto drift = [](double t) { return Place{{1.2 * t, 0.3 * std::sin(2.0 * t)}, 0.0}; };
    EXPECT_LT(furthestSlide(walk(drift, 30.0), 24), 5e-4);
}

TEST(Footsteps, ComeDownAheadOfADriftAndLeaveAsFarBehind) {
    double ahead = 0.0, behind = 0.0;
    for (const Seen& each : walk([](double t) { return Place{{1.2 * t, 0.2 * t}, 0.0}; }, 30.0)) {
        ahead = std::max(ahead, static_cast<double>(each.moves[0].left));
        behind = std::min(behind, static_cast<double>(each.moves[0].left));
    }
    EXPECT_NEAR(ahead, -behind, 0.25 * ahead);
    EXPECT_NEAR(ahead - behind, 0.2 * 0.66, 0.03) << "as far as somebody drifts while a foot is down";
}

TEST(Footsteps, StepRoundWithOneFootAtATimeWhereSomebodyTurnsOnTheSpot) {
    const auto turn = [](double t) { return Place{{0.0, 0.0}, std::clamp(t - 0.5, 0.0, 2.0) * 1.5}; };
    const std::vector<Seen> seen = walk(turn, 5.0);
    std::array<int, 2> steps{};
    for (std::size_t frame = 1; frame < seen.size(); ++frame) {
        for (const std::size_t side : {0u, 1u})
            steps[side] += seen[frame].moves[side].lift > 0.0f && seen[frame - 1].moves[side].lift == 0.0f;
        EXPECT_FALSE(seen[frame].moves[0].lift > 0.0f && seen[frame].moves[1].lift > 0.0f) << frame;
    }
    EXPECT_GE(steps[0], 2);
    EXPECT_GE(steps[1], 2);
    for (const FootMove& move : seen.back().moves) {
        EXPECT_LT(std::abs(move.turn), 0.25f) << "feet end as the body faces";
        EXPECT_LT(std::hypot(move.forward, move.left), 0.06);
    }
}

TEST(Footsteps, ComeTogetherWhereSomebodyStops) {
    const auto stop = [](double t) { return Place{{t < 2.2 ? 1.3 * t : 1.3 * 2.2, 0.0}, 0.0}; };
    const std::vector<Seen> seen = walk(stop, 6.0);
    for (const FootMove& move : seen.back().moves)
        EXPECT_LT(std::hypot(move.forward, move.left), 0.06);
}

TEST(Footsteps, StandStillUnderThoseWhoSway) {
    const auto sway = [](double t) {
        return Place{{0.015 * std::sin(t), 0.015 * std::cos(1.3 * t)}, 0.1 * std::sin(t)};
    };
    for (const Seen& each : walk(sway, 20.0))
        for (const FootMove& move : each.moves)
            ASSERT_EQ(move.lift, 0.0f);
    EXPECT_LT(furthestSlide(walk(sway, 20.0)), 1e-5);
}

TEST(Footsteps, NeverReachFurtherThanLegsDo) {
    // Runs backwards, is spun round, and thrown about.
    const auto wild = [](double t) {
        return Place{{-2.0 * t, std::floor(t) * 0.7}, 5.0 * t + std::floor(1.7 * t)};
    };
    for (const double fps : {1.0, 24.0, 240.0})
        for (const Seen& each : walk(wild, 10.0, fps))
            for (const FootMove& move : each.moves) {
                ASSERT_LT(std::hypot(move.forward, move.left), 1.2) << fps;
                ASSERT_LE(std::abs(move.turn), 4.0) << fps;
                ASSERT_TRUE(move.lift >= 0.0f && move.lift <= 0.06f) << fps;
            }
}

TEST(Footsteps, AreToldInThreeNumbers) {
    for (const float turn : {-1.0f, -0.1f, 0.0f, 0.001f, 0.9f})
        for (const float lift : {0.0f, 0.013f, 0.06f}) {
            const std::array values{0.1f, -0.2f, turnAndLift({0.1f, -0.2f, turn, lift})};
            const FootMove back = footMoveOf(values);
            EXPECT_EQ(back.forward, 0.1f);
            EXPECT_EQ(back.left, -0.2f);
            EXPECT_NEAR(back.turn, turn, 0.5f / kTurnSteps + 1e-6f);
            EXPECT_NEAR(back.lift, lift, 1e-4f);
        }
}

TEST(Footsteps, GoOnFromWhatIsKeptOfThem) {
    const auto at = [](int frame) { return glm::vec2(0.05f * static_cast<float>(frame), 0.0f); };
    const auto frames = [&](Footsteps& footsteps, int from, int until) {
        std::array<FootMove, 2> last;
        for (int frame = from; frame < until; ++frame) {
            GaitTrack gait{0.04 * frame, 3};
            const float faces = 0.03f * static_cast<float>(frame);
            last = footsteps.step(
                0, {at(frame), {std::cos(faces), std::sin(faces)}, at(frame) - at(frame - 1), 1.2f}, gait);
        }
        return last;
    };
    Footsteps whole(1, 24.0), first(1, 24.0), second(1, 24.0);
    const auto expected = frames(whole, 0, 50);
    frames(first, 0, 23);
    std::ranges::copy(first.state(), second.state().begin());
    const auto found = frames(second, 23, 50);
    for (const std::size_t side : {0u, 1u}) {
        EXPECT_EQ(found[side].forward, expected[side].forward);
        EXPECT_EQ(found[side].left, expected[side].left);
        EXPECT_EQ(found[side].turn, expected[side].turn);
    }
}

}  // namespace
}  // namespace throng::recording
