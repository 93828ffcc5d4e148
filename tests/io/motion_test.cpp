// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "recording/frame_window.h"
#include "recording/gaits.h"
#include "recording/keep_apart.h"
#include "recording/motion_recorder.h"

namespace throng::io {
namespace {

constexpr double kFps = 24.0;

// --- gaits
// ---------------------------------------------------------------------------------------------------

TEST(Gaits, StridesFollowTheSpeedAndThePhaseTheWay) {
    for (const double speed : {0.3, 0.6, 1.0, 1.34, 1.7, 2.2, 3.5}) {
        recording::GaitTrack track{0.25, 1};
        for (int frame = 0; frame < 240; ++frame)
            track.advance(speed / kFps, 1.0 / kFps);
        EXPECT_EQ(track.gait, recording::gaitFor(speed)) << speed;
        // Sekiya et al. 1996: within what lies between two gaits.
        EXPECT_NEAR(recording::strideOf(track.gait) / (1.249 * std::sqrt(speed)), 1.0, 0.14) << speed;
        const double before = track.phase;
        track.advance(speed, 1.0);
        EXPECT_NEAR((track.phase - before) * recording::strideOf(track.gait), speed, 1e-9) << speed;
    }
}

TEST(Gaits, ChangeOnlyWhereThePlantedFootIsUnderTheBody) {
    recording::GaitTrack track{0.1, 1};
    int changes = 0;
    for (int frame = 0; frame < 2000; ++frame) {
        const double speed = 1.5 + 1.3 * std::sin(0.01 * frame);
        const recording::GaitTrack before = track;
        track.advance(speed / kFps, 1.0 / kFps);
        if (track.gait == before.gait) continue;
        ++changes;
        // The way until then with the old stride, the rest with the new one: the foot is not moved at all.
        const double half =
            std::floor(2.0 * (track.phase - recording::kUnderBody)) / 2.0 + recording::kUnderBody;
        EXPECT_NEAR((half - before.phase) * recording::strideOf(before.gait) +
                        (track.phase - half) * recording::strideOf(track.gait),
                    speed / kFps, 1e-9);
        EXPECT_GE(half, before.phase);
    }
    EXPECT_GT(changes, 20);
}

TEST(Gaits, TellTheGaitBeforeUntilItsBlendIsOver) {
    recording::GaitTrack track{0.0, 1};
    int frames = 0, changes = 0;
    double left = 0.0;
    for (int frame = 0; frame < 2000; ++frame) {
        const double speed = 1.5 + 1.3 * std::sin(0.01 * frame);
        const recording::GaitTrack was = track;
        track.advance(speed / kFps, 1.0 / kFps);
        for (const float activity : {1.0f, 4.0f}) {
            const recording::GaitInState told = recording::gaitsOf(activity + track.inState());
            EXPECT_EQ(told.gait, track.gait);
            EXPECT_NEAR(told.left, track.left(), 1.0 / 16.0);
            if (told.left > 0.0) {
                EXPECT_EQ(told.before, track.before);
            }
            EXPECT_EQ(std::lround(16.0f * (track.inState())), track.gait) << "earlier readers round";
            left = told.left;
        }
        if (track.gait != was.gait) {
            EXPECT_EQ(track.before, was.gait);
            EXPECT_GT(left, 0.7);
            ++changes;
        }
        frames += left > 0.0;
    }
    EXPECT_GT(changes, 20);
    EXPECT_GT(frames, 3 * changes);
    EXPECT_LT(frames, 20 * changes);
}

TEST(Gaits, WhoStandsSetsOffWithAShortStride) {
    recording::GaitTrack track{0.0, 4};
    track.advance(0.0, 0.6);
    EXPECT_LT(recording::strideOf(track.gait), 1.0);
}

TEST(Gaits, WhoStopsForAMomentKeepsItsStride) {
    recording::GaitTrack track{0.1, 4};
    for (int frame = 0; frame < 10; ++frame)
        track.advance(0.0, 1.0 / kFps);
    EXPECT_EQ(track.gait, 4u);
    for (int frame = 0; frame < 10; ++frame)
        track.advance(0.0, 1.0 / kFps);
    EXPECT_LT(track.gait, 4u);
}

// --- averages over time
// ----------------------------------------------------------------------------------------

float timeOf(std::uint32_t frame) {
    return static_cast<float>(frame);
}

/// A crowd given by a function of row and frame.
struct Crowd {
    std::size_t rows = 1;
    std::vector<float> positions, directions, states;

    template <class Place, class Alive>
    Frame at(std::uint32_t index, Place place, Alive alive) {
        positions.assign(rows * 3, 0.0f);
        directions.assign(rows * 3, 0.0f);
        states.assign(rows * 3, 0.0f);
        for (std::size_t row = 0; row < rows; ++row) {
            const glm::vec2 p = place(row, index);
            positions[row * 3] = p.x;
            positions[row * 3 + 1] = p.y;
            directions[row * 3] = 1.0f;
            directions[row * 3 + 2] = 1.2f;
            states[row * 3] = alive(row, index) ? 1.0f : 0.0f;
            states[row * 3 + 1] = static_cast<float>(row % 8);
            states[row * 3 + 2] = 0.5f;
        }
        Frame frame{index};
        frame[Stream::pos] = positions;
        frame[Stream::dir] = directions;
        frame[Stream::state] = states;
        return frame;
    }
};

recording::BakeDescription describe(std::size_t rows, double smoothing) {
    recording::BakeDescription description;
    description.fps = kFps;
    description.frames = 60;
    description.smoothing = smoothing;
    description.minimum = {-50.0, -50.0};
    description.maximum = {50.0, 50.0};
    for (std::size_t row = 0; row < rows; ++row) {
        recording::BakeAgent agent;
        agent.radius = 0.25f;
        agent.preferred_speed = 1.3f;
        description.agents.push_back(agent);
    }
    return description;
}

struct Recorded {
    std::vector<std::vector<float>> positions, directions, states;
    recording::MotionRecorder::Sink sink() {
        return [this](const Frame& frame) {
            EXPECT_EQ(frame.index, positions.size()) << "in order";
            for (const auto& [stream, frames] :
                 {std::pair{Stream::pos, &positions}, {Stream::dir, &directions}, {Stream::state, &states}})
                frames->emplace_back(frame[stream].begin(), frame[stream].end());
        };
    }
};

const auto kAlways = [](std::size_t, std::uint32_t) { return true; };

template <class Place, class Alive>
Recorded record(std::size_t rows, double smoothing, std::uint32_t frames, Place place, Alive alive,
                std::vector<authoring::Wall> walls = {}) {
    recording::BakeDescription description = describe(rows, smoothing);
    description.walls = std::move(walls);
    Recorded recorded;
    recording::MotionRecorder recorder(description, recorded.sink());
    Crowd crowd{rows, {}, {}, {}};
    for (std::uint32_t frame = 0; frame < frames; ++frame)
        recorder.take(crowd.at(frame, place, alive));
    recorder.finish();
    EXPECT_EQ(recorded.positions.size(), frames);
    return recorded;
}

TEST(Motion, WhoWalksSteadilyIsRecordedWhereItIs) {
    for (const std::size_t rows : {1u, 63u, 1234u}) {
        const auto place = [](std::size_t row, std::uint32_t frame) {
            return glm::vec2(-40.0f + 0.05f * timeOf(frame), -40.0f + 0.06f * static_cast<float>(row));
        };
        // Bodies that overlap would be put apart: one in ten of them is there.
        const auto some = [](std::size_t row, std::uint32_t) { return row % 10 == 0; };
        const Recorded recorded = record(rows, 0.25, 40, place, some);
        for (std::uint32_t frame = 0; frame < 40; ++frame)
            for (std::size_t row = 0; row < rows; ++row) {
                EXPECT_NEAR(recorded.positions[frame][row * 3], place(row, frame).x, 1e-5);
                EXPECT_NEAR(recorded.positions[frame][row * 3 + 1], place(row, frame).y, 1e-5);
            }
    }
}

double jolt(const Recorded& recorded, std::uint32_t frame) {
    const auto x = [&](std::uint32_t f) { return double{recorded.positions[f][0]}; };
    return std::abs(x(frame + 1) - 2.0 * x(frame) + x(frame - 1)) * kFps * kFps;
}

TEST(Motion, TremorIsTakenOutAndNothingIsDelayed) {
    const auto place = [](std::size_t, std::uint32_t frame) {
        return glm::vec2(0.05f * timeOf(frame) + (frame % 2 ? 0.01f : -0.01f), 0.0f);
    };
    const Recorded raw = record(1, 0.0, 60, place, kAlways);
    const Recorded steady = record(1, 0.25, 60, place, kAlways);
    EXPECT_GT(jolt(raw, 30), 20.0);
    EXPECT_LT(jolt(steady, 30), 0.05);
    for (std::uint32_t frame = 10; frame < 50; ++frame)
        EXPECT_NEAR(steady.positions[frame][0], 0.05 * frame, 1e-3);
}

TEST(Motion, PeopleAppearAndLeaveExactlyWhereTheyDid) {
    const auto place = [](std::size_t, std::uint32_t frame) {
        const float t = std::clamp(timeOf(frame), 10.0f, 40.0f);
        return glm::vec2(std::cos(0.2f * t), std::sin(0.2f * t));
    };
    const auto alive = [](std::size_t, std::uint32_t frame) { return frame >= 10 && frame <= 40; };
    const Recorded recorded = record(1, 0.25, 60, place, alive);
    for (const std::uint32_t frame : {10u, 40u, 41u, 59u}) {
        EXPECT_EQ(recorded.positions[frame][0], place(0, frame).x) << frame;
        EXPECT_EQ(recorded.positions[frame][1], place(0, frame).y) << frame;
    }
    EXPECT_EQ(recorded.states[9][0], 0.0f);
    EXPECT_GT(recorded.states[10][0], 1.0f);
    EXPECT_EQ(recorded.states[59][2], recorded.states[40][2]) << "keeps its phase";
    EXPECT_GT(recorded.states[40][2], recorded.states[39][2]);
}

TEST(Motion, NobodyIsAveragedIntoAnybody) {
    // Two walk round each other, touching: averages cut the circle's corner.
    const auto place = [](std::size_t row, std::uint32_t frame) {
        const float angle = 0.35f * timeOf(frame) + (row ? 3.14159265f : 0.0f);
        return 0.25f * glm::vec2(std::cos(angle), std::sin(angle));
    };
    const Recorded recorded = record(2, 0.25, 48, place, kAlways);
    for (const std::vector<float>& p : recorded.positions)
        EXPECT_GE(std::hypot(p[0] - p[3], p[1] - p[4]), 0.5 * 0.994);
}

TEST(Motion, NobodyIsAveragedIntoAWall) {
    // Round the end of a wall along x > 0, at exactly the body's radius from it.
    const auto place = [](std::size_t, std::uint32_t frame) {
        const float t = 0.06f * (timeOf(frame) - 24.0f);
        const float reach = 0.36f;
        const float turn = std::clamp(t / reach, -1.5707963f, 1.5707963f);
        const float beyond = std::max(0.0f, std::abs(t) - reach * 1.5707963f);
        return glm::vec2(-reach * std::cos(turn) + beyond, reach * std::sin(turn));
    };
    authoring::Wall wall;
    wall.points = {{0.0, 0.0}, {20.0, 0.0}};
    wall.thickness = 0.2;
    const Recorded free = record(1, 0.5, 48, place, kAlways);
    const Recorded walled = record(1, 0.5, 48, place, kAlways, {wall});
    recording::WallWatch watch({wall}, {-50.0, -50.0}, {50.0, 50.0});
    watch.look(0.0, 0.0);
    double without = 0.0, with = 0.0;
    for (std::uint32_t frame = 0; frame < 48; ++frame) {
        const auto depth = [&](const Recorded& recorded) {
            return watch.penetration({recorded.positions[frame][0], recorded.positions[frame][1]}, 0.25);
        };
        without = std::max(without, depth(free));
        with = std::max(with, depth(walled));
    }
    EXPECT_GT(without, 0.02) << "m: or this test shows nothing";
    EXPECT_LT(with, 2.0e-4) << "m";
}

TEST(Motion, WallsThatReachFarOutOfTheBoundsAreLookedThroughFast) {
    authoring::Wall wall;
    wall.points = {{6.0, 6.0}, {6.0, 14.0}, {4.0e9, 10.0}, {14.0, 6.0}};
    wall.closed = true;
    const recording::WallWatch watch({wall}, {-16.0, -16.0}, {16.0, 16.0});
    const std::clock_t start = std::clock();
    for (int i = 0; i < 4000; ++i)
        EXPECT_DOUBLE_EQ(watch.penetration({15.9 - 1.0e-4 * i, 15.5}, 0.25), 0.0);
    EXPECT_NEAR(watch.penetration({5.9, 10.0}, 0.25), 0.15, 1.0e-9);
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 1.0) << "s";
}

TEST(Motion, NoSmoothingLeavesPlacesAndHeadingsToTheBit) {
    std::mt19937 random(3);
    std::vector<glm::vec2> places(63 * 20);
    for (glm::vec2& place : places)
        place = {std::uniform_real_distribution<float>(-9.0f, 9.0f)(random),
                 std::uniform_real_distribution<float>(-9.0f, 9.0f)(random)};
    const auto place = [&](std::size_t row, std::uint32_t frame) { return places[frame * 63 + row]; };
    const Recorded recorded = record(63, 0.0, 20, place, kAlways);
    for (std::uint32_t frame = 0; frame < 20; ++frame)
        for (std::size_t row = 0; row < 63; ++row) {
            EXPECT_EQ(recorded.positions[frame][row * 3], place(row, frame).x);
            EXPECT_EQ(recorded.directions[frame][row * 3 + 2], 1.2f);
        }
}

TEST(Motion, GoesOnFromACheckpointAsIfNothingHadHappened) {
    const auto place = [](std::size_t row, std::uint32_t frame) {
        return glm::vec2(0.05f * timeOf(frame) + 0.02f * std::sin(3.0f * timeOf(frame)),
                         1.1f * static_cast<float>(row) + 0.01f * timeOf(frame % 3));
    };
    const auto alive = [](std::size_t row, std::uint32_t frame) {
        return frame >= row % 7 && frame < 30 + row;
    };
    for (const double smoothing : {0.0, 0.25, 0.5}) {
        const Recorded whole = record(17, smoothing, 40, place, alive);
        for (const std::uint32_t stop : {1u, 3u, 12u, 39u}) {
            const recording::BakeDescription description = describe(17, smoothing);
            Recorded parts;
            Crowd crowd{17, {}, {}, {}};
            std::vector<std::byte> saved;
            {
                recording::MotionRecorder first(description, parts.sink());
                for (std::uint32_t frame = 0; frame < stop; ++frame)
                    first.take(crowd.at(frame, place, alive));
                saved = first.save();
            }
            recording::MotionRecorder second(description, parts.sink());
            second.restore(saved);
            EXPECT_EQ(second.framesTaken(), stop);
            for (std::uint32_t frame = stop; frame < 40; ++frame)
                second.take(crowd.at(frame, place, alive));
            second.finish();
            EXPECT_EQ(parts.positions, whole.positions);
            EXPECT_EQ(parts.directions, whole.directions);
            EXPECT_EQ(parts.states, whole.states);
            saved.pop_back();
            recording::MotionRecorder third(description, parts.sink());
            EXPECT_THROW(third.restore(saved), std::runtime_error);
        }
    }
}

}  // namespace
}  // namespace throng::io
