// SPDX-License-Identifier: Apache-2.0
#include "recording/attention.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "recording/heads.h"
#include "recording/seated_heads.h"

namespace throng::recording {
namespace {

using std::numbers::pi;

constexpr double kFps = 24.0;
using People = std::function<std::vector<Onlooker>(double)>;

Onlooker onlooker(std::uint32_t row, glm::dvec2 place, double faces, double speed) {
    return {row, row, place, 0.0, {std::cos(faces), std::sin(faces)}, speed};
}

/// What becomes of some people's heads: frame by frame, row by row.
struct Told {
    std::vector<std::vector<Attention>> frames;
    std::vector<Attention> of(std::uint32_t row) const {
        std::vector<Attention> found;
        for (const auto& frame : frames)
            found.push_back(frame[row]);
        return found;
    }
};

Told tell(const People& people, double seconds, AttentionTrack::Site site = {}, std::uint64_t seed = 1) {
    site.minimum = glm::dvec2(-50.0);
    site.maximum = glm::dvec2(50.0);
    AttentionTrack track(64, kFps, seed, std::move(site));
    Told told;
    for (std::uint32_t frame = 0; frame < seconds * kFps; ++frame) {
        track.look(people(frame / kFps), frame);
        told.frames.emplace_back();
        for (std::uint32_t row = 0; row < 64; ++row)
            told.frames.back().push_back(track[row]);
    }
    return told;
}

double shown(const Attention& head) {
    return double{head.weight} * head.yaw;
}

double share(const std::vector<Attention>& heads, const std::function<bool(const Attention&)>& is) {
    return static_cast<double>(std::ranges::count_if(heads, is)) / static_cast<double>(heads.size());
}

/// rad/s, by frame.
std::vector<double> rates(const std::vector<Attention>& heads) {
    std::vector<double> found;
    for (std::size_t i = 1; i < heads.size(); ++i)
        found.push_back(kFps * std::hypot(shown(heads[i]) - shown(heads[i - 1]),
                                          double{heads[i].weight} * heads[i].pitch -
                                              double{heads[i - 1].weight} * heads[i - 1].pitch));
    return found;
}

double percentile(std::vector<double> values, double part) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

/// Two of one party who stand face to face, but for 35 degrees.
std::vector<Onlooker> twoWhoTalk(double) {
    std::vector<Onlooker> both{onlooker(0, {0.0, 0.0}, 0.6, 0.0), onlooker(1, {1.2, 0.0}, pi - 0.6, 0.0)};
    both[1].party = 0;
    return both;
}

TEST(Attention, OfThoseWhoTalkIsWithEachOther) {
    const Told told = tell(twoWhoTalk, 120.0);
    for (const std::uint32_t row : {0u, 1u}) {
        const auto heads = told.of(row);
        const auto faces = [&](const Attention& head) {
            return head.at == static_cast<float>(2 - row) &&
                   std::abs(shown(head) - (row == 0 ? -0.6 : 0.6)) < 10.0 * kDegrees;
        };
        EXPECT_GT(share(heads, faces), 0.55);
        EXPECT_LT(share(heads, faces), 0.97) << "nobody stares";
    }
}

TEST(Attention, OfListenersIsWithWhoSpeaks) {
    const auto three = [](double) {
        std::vector<Onlooker> ring;
        for (std::uint32_t row = 0; row < 3; ++row) {
            const double angle = 2.0 * pi * row / 3.0;
            ring.push_back(
                onlooker(row, 0.8 * glm::dvec2(std::cos(angle), std::sin(angle)), angle + pi, 0.0));
            ring.back().party = 0;
        }
        return ring;
    };
    const Told told = tell(three, 200.0);
    std::size_t listeners = 0, with_speaker = 0, turns = 0;
    Company company(1);
    PlaneGrid grid({-50.0, -50.0}, {50.0, 50.0}, 2.0);
    const auto people = three(0.0);
    grid.sort({people[0].place, people[1].place, people[2].place});
    company.gather(people, grid);
    std::uint32_t before = 0;
    double since = 0.0;
    for (std::size_t frame = 0; frame < told.frames.size(); ++frame) {
        const Company::Turn turn = company.turnAt(0, people, static_cast<double>(frame) / kFps);
        if (turn.speaker != before) {
            ++turns;
            since = static_cast<double>(frame) / kFps;
        }
        before = turn.speaker;
        if (static_cast<double>(frame) / kFps - since < 0.8) continue;
        for (std::uint32_t row = 0; row < 3; ++row) {
            if (row == turn.speaker) continue;
            ++listeners;
            with_speaker += told.frames[frame][row].at == static_cast<float>(turn.speaker + 1) ? 1 : 0;
        }
    }
    EXPECT_GT(turns, 40u);
    EXPECT_GT(static_cast<double>(with_speaker) / static_cast<double>(listeners), 0.7);
}

TEST(Attention, OfThoseWhoWalkAloneIsAheadAndTheirHeadsGoAsTheyWould) {
    const Told told = tell(
        [](double t) {
            return std::vector{onlooker(0, {1.3 * t - 40.0, 0.0}, 0.0, 1.3)};
        },
        60.0);
    const auto heads = told.of(0);
    EXPECT_GT(share(heads, [](const Attention& head) { return std::abs(shown(head)) < 0.1; }), 0.5);
    EXPECT_GT(share(heads, [](const Attention& head) { return std::abs(shown(head)) > 0.25; }), 0.02);
    EXPECT_GT(share(heads, [](const Attention& head) { return head.weight < 0.02f; }), 0.25);
    EXPECT_EQ(share(heads, [](const Attention& head) { return head.at > 0.0f; }), 0.0);
}

/// Goes straight on and round a corner of 90 degrees, within a second, at some time.
double corner(double t, double at) {
    const double share = std::clamp(t - at + 0.5, 0.0, 1.0);
    return 0.5 * pi * share * share * (3.0 - 2.0 * share);
}

TEST(Attention, GoesRoundACornerBeforeTheBody) {
    for (const double side : {1.0, -1.0}) {
        const auto walks = [&](double t) {
            const double faces = side * corner(t, 5.0);
            auto self = onlooker(0, {0.0, 0.0}, faces, 1.3);
            self.turns = side * corner(t + AttentionTrack::kForesees, 5.0) - faces;
            return std::vector{self};
        };
        const auto heads = tell(walks, 8.0).of(0);
        // How much later the body comes through the middle of the corner than the head does.
        double head_at = 0.0, body_at = 0.0, most = 0.0;
        for (std::size_t frame = heads.size(); frame-- > 0;) {
            const double t = static_cast<double>(frame) / kFps, body = side * corner(t, 5.0);
            if (std::abs(body) > 0.25 * pi) body_at = t;
            if (t > 4.0 && std::abs(body + shown(heads[frame])) > 0.25 * pi) head_at = t;
            if (t > 4.0 && t < 5.5) most = std::max(most, side * shown(heads[frame]));
        }
        EXPECT_GT(body_at - head_at, 0.15);
        EXPECT_LT(body_at - head_at, 0.5);
        EXPECT_LT(most, 30.0 * kDegrees);
        EXPECT_GT(most, 10.0 * kDegrees);
    }
}

TEST(Attention, TurnsToASoundWithinTheTimeOfAReaction) {
    AttentionTrack::Site site;
    site.things = {{{0.0, 8.0}, 1.6, 1.0, 20.0, 10.0, 10.0, true}};
    const auto passes = [](double t) {
        std::vector<Onlooker> people;
        for (std::uint32_t row = 0; row < 32; ++row)
            people.push_back(onlooker(row, {1.3 * (t - 10.0), -2.0 * row}, 0.0, 1.3));
        return people;
    };
    const Told told = tell(passes, 14.0, site);
    std::size_t turned = 0;
    for (std::uint32_t row = 0; row < 32; ++row) {
        const auto heads = told.of(row);
        for (std::size_t frame = 0; frame < 240 + 4; ++frame)
            ASSERT_NE(heads[frame].at, static_cast<float>(kFirstThing)) << "before it is heard";
        const bool in_reach = 8.0 + 2.0 * row < 19.0;
        const bool looks = heads[240 + 13].at == static_cast<float>(kFirstThing);
        EXPECT_EQ(looks, in_reach) << row;
        if (!in_reach) continue;
        ++turned;
        const Attention& later = heads[240 + 34];  // 1.4 s: a reaction and a turn by 70 degrees
        if (later.at == static_cast<float>(kFirstThing)) {
            EXPECT_GT(shown(later), 60.0 * kDegrees) << row;
        }
    }
    EXPECT_GE(turned, 5u);
}

TEST(Attention, FallsOnWhoWillCrossAndNotOnWhoKeepsAway) {
    int close = 0, far = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const auto crosses = [&](double aside) {
            return [aside](double t) {
                return std::vector{onlooker(0, {1.3 * (t - 6.0), 0.0}, 0.0, 1.3),
                                   onlooker(1, {aside, 1.3 * (6.0 - t)}, -0.5 * pi, 1.3)};
            };
        };
        const auto sees = [](const Attention& head) { return head.at == 2.0f; };
        close += std::ranges::any_of(tell(crosses(0.8), 6.0, {}, seed).of(0), sees);
        far += std::ranges::any_of(tell(crosses(30.0), 6.0, {}, seed).of(0), sees);
    }
    EXPECT_GT(close, 24);
    EXPECT_EQ(far, 0);
}

TEST(Attention, IsDrawnByThingsUnlessAWallIsBefore) {
    AttentionTrack::Site site;
    site.things = {{{3.0, 3.0}, 2.6, 3.0, 12.0, 5.0, 25.0, false}};
    const auto stands = [](double) { return std::vector{onlooker(0, {0.0, 0.0}, 0.0, 0.0)}; };
    const auto looks = [](const Attention& head) { return head.at == static_cast<float>(kFirstThing); };
    const auto heads = tell(stands, 40.0, site).of(0);
    for (std::size_t frame = 0; frame < heads.size(); ++frame) {
        const double t = static_cast<double>(frame) / kFps;
        if (t < 5.0 || t > 25.1) {
            EXPECT_FALSE(looks(heads[frame])) << t;
        }
    }
    EXPECT_GT(share(heads, looks), 0.2);
    EXPECT_GT(share(heads,
                    [](const Attention& head) {
                        return std::abs(shown(head) - 0.25 * pi) < 0.05 &&
                               std::abs(head.pitch - 0.232) < 0.03;
                    }),
              0.15);
    authoring::Wall wall;
    wall.points = {{1.0, 3.0}, {3.0, 1.0}};
    site.walls = {wall};
    EXPECT_EQ(share(tell(stands, 40.0, site).of(0), looks), 0.0);
    site.walls[0].height = 1.1;
    EXPECT_GT(share(tell(stands, 40.0, site).of(0), looks), 0.2) << "it is looked over";
    site.things[0].storey = 4.0;
    EXPECT_EQ(share(tell(stands, 40.0, site).of(0), looks), 0.0) << "it is upstairs";
}

TEST(Attention, IsNotWithCompanyBehindAWallUnlessItIsLookedOver) {
    AttentionTrack::Site site;
    authoring::Wall wall;
    wall.points = {{0.4, -2.0}, {0.4, 2.0}};
    site.walls = {wall};
    for (const std::uint32_t row : {0u, 1u}) {
        const auto looks = [row](const Attention& head) { return head.at == static_cast<float>(2 - row); };
        site.walls[0].height = 2.0;
        EXPECT_EQ(share(tell(twoWhoTalk, 60.0, site).of(row), looks), 0.0) << "row " << row;
        site.walls[0].height = 1.0;
        EXPECT_GT(share(tell(twoWhoTalk, 60.0, site).of(row), looks), 0.5) << "row " << row;
    }
}

std::vector<Onlooker> turbulent(double t) {
    std::vector<Onlooker> people;
    for (std::uint32_t row = 0; row < 64; ++row) {
        people.push_back(
            onlooker(row, {2.0 * std::sin(row + t), 2.0 * std::cos(1.7 * row + t)}, row + 0.9 * t, 0.8));
        people.back().party = row / 2 * 2;
        people.back().turns = 0.4;
        people.back().twist = 0.6 * std::sin(2.0 * t + row);
    }
    return people;
}

TEST(Attention, TurnsHeadsAsFarAndAsFastAsNecksDo) {
    AttentionTrack::Site site;
    site.things = {{{0.0, 0.0}, 6.0, 2.0, 20.0, 0.0, 1e9, false},
                   {{5.0, 0.0}, -3.0, 1.0, 50.0, 20.0, 20.0, true}};
    const Told told = tell(turbulent, 60.0, site);
    std::vector<double> all;
    for (std::uint32_t row = 0; row < 64; ++row) {
        const auto heads = told.of(row);
        for (const Attention& head : heads) {
            ASSERT_LE(std::abs(head.yaw), kMostYaw + 1e-5);
            ASSERT_LE(std::abs(head.pitch), kMostPitch + 1e-5);
            ASSERT_GE(head.weight, 0.0f);
            ASSERT_LE(head.weight, 1.0f);
        }
        const auto own = rates(heads);
        all.insert(all.end(), own.begin(), own.end());
    }
    EXPECT_LT(percentile(all, 0.99), 200.0 * kDegrees);
    EXPECT_GT(percentile(all, 0.5), 1.0 * kDegrees);
}

TEST(Attention, TakesTurnsSmoothly) {
    HeadTurn turn;
    double left = secondsToTurn(1.0), fastest = 0.0, hardest = 0.0, before = 0.0;
    for (int frame = 0; frame < 48; ++frame) {
        turnTowards(turn, 1.0, 0.0, std::max(left, 0.28), 1.0 / kFps);
        left -= 1.0 / kFps;
        fastest = std::max(fastest, double{turn.rate});
        hardest = std::max(hardest, std::abs(double{turn.acceleration} - before));
        before = turn.acceleration;
        EXPECT_LT(turn.angle, 1.02f);
    }
    EXPECT_NEAR(turn.angle, 1.0, 1e-3);
    EXPECT_NEAR(fastest, 1.875 / secondsToTurn(1.0), 0.25);
    EXPECT_LT(hardest, 8.0) << "rad/s^2 from one frame to the next";
}

TEST(Attention, GoesOnFromWhatIsKeptOfIt) {
    const auto people = [](std::uint32_t frame) { return turbulent(frame / kFps); };
    AttentionTrack::Site site;
    site.minimum = {-20.0, -20.0};
    site.maximum = {20.0, 20.0};
    site.things = {{{0.0, 0.0}, 6.0, 2.0, 20.0, 3.0, 3.0, true}};
    AttentionTrack whole(64, kFps, 7, site), first = whole, second = whole, other(64, kFps, 8, site);
    for (std::uint32_t frame = 0; frame < 200; ++frame) {
        whole.look(people(frame), frame);
        other.look(people(frame), frame);
    }
    for (std::uint32_t frame = 0; frame < 77; ++frame)
        first.look(people(frame), frame);
    std::ranges::copy(first.state(), second.state().begin());
    for (std::uint32_t frame = 77; frame < 200; ++frame)
        second.look(people(frame), frame);
    int different = 0;
    for (std::size_t row = 0; row < 64; ++row) {
        EXPECT_EQ(second[row].yaw, whole[row].yaw);
        EXPECT_EQ(second[row].pitch, whole[row].pitch);
        EXPECT_EQ(second[row].weight, whole[row].weight);
        EXPECT_EQ(second[row].at, whole[row].at);
        different += other[row].yaw != whole[row].yaw;
    }
    EXPECT_GT(different, 30) << "another seed";
}

TEST(Attention, OfThoseWhoHaveSeatsIsWithSoundsAndThings) {
    const EyeCatcher bang{{0.0, 5.0}, 1.25, 1.0, 30.0, 20.0, 20.0, true};
    const EyeCatcher play{{10.0, -4.0}, 1.25, 4.0, 30.0, 40.0, 200.0, false};
    const EyeCatcher cheer{{5.0, 5.0}, 1.25, 1.0, 30.0, 8.0, 8.0, true, true};
    const SeatedHeads heads({bang, play, cheer}, 3);
    const BakeSpectator person;  // looks along x
    std::size_t played = 0, all = 0;
    std::vector<double> rates;
    for (std::size_t number = 0; number < 40; ++number) {
        Attention before;
        for (int frame = 0; frame < 200 * kFps; ++frame) {
            const double t = frame / kFps;
            const Attention head = heads.at(person, number, t);
            ASSERT_LE(std::abs(head.yaw), kMostYaw + 1e-5);
            rates.push_back(kFps * std::abs(shown(head) - shown(before)));
            if (t < 20.2) {
                ASSERT_EQ(head.weight, 0.0f) << t;
            }
            if (t > 21.7 && t < 21.8) {
                ASSERT_NEAR(shown(head), kMostYaw, 0.3) << number;
            }
            if (t > 46.0) {
                ++all;
                played += head.at == static_cast<float>(kFirstThing - 1);
            }
            before = head;
        }
    }
    const double share = static_cast<double>(played) / static_cast<double>(all);
    EXPECT_GT(share, 0.25);
    EXPECT_LT(share, 0.7);
    EXPECT_LT(percentile(rates, 1.0), 200.0 * kDegrees);
}

}  // namespace
}  // namespace throng::recording
