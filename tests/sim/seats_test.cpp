// SPDX-License-Identifier: Apache-2.0
// People between rows of seats: a step of theirs against plain C++.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <utility>

#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

constexpr float kFar = 1.0e6f;

/// A block whose people are everywhere on their ways, in all modes of those who are led.
struct Block {
    explicit Block(std::uint32_t count) : scene(emptyScene({-40, -40}, {40, 40})) {
        std::mt19937 generator(count);
        const auto random = [&] { return static_cast<std::uint32_t>(generator()); };
        const auto draw = [&](float from, float to) {
            return from + (to - from) * static_cast<float>(random() % 4096) / 4096.0f;
        };
        const std::uint32_t aisles = count / 40 + 1;
        for (std::uint32_t i = 0; i < count; ++i) {
            addPerson(scene, {0, 0}, {1, 0});
            scene.people.back().flags |= gpu::PERSON_SITS_AT_START;
            scene.people.back().first_stage = scene.people.front().first_stage;
            addWay(i, aisles, count, random);
            gpu::Sitter sitter{};
            const gpu::SeatWay& way = scene.seats.ways.back();
            sitter.mode = gpu::SITTER_ENTERS + random() % 8;
            const bool walks = sitter.mode == gpu::SITTER_ENTERS || sitter.mode == gpu::SITTER_LEAVES;
            sitter.along = walks ? draw(0.0f, way.length) : way.length;
            sitter.speed = walks ? draw(0.0f, 0.8f) : 0.0f;
            sitter.share = draw(0.0f, 1.0f);
            sitter.since = 1u - random() % 60;
            sitter.activity = gpu::ACTIVITY_SIT;
            sitter.seated = gpu::NO_INDEX;
            const bool splits = way.fork != gpu::NO_FORK && random() % 2 == 1;
            sitter.side = sitter.mode != gpu::SITTER_LEAVES ? 0 : splits ? way.free_side : random() % 2;
            scene.seats.sitters.push_back(sitter);
            gpu::Mind mind{};
            mind.state = random() % 2;
            mind.entered = 1;
            mind.place = mind.followed = mind.next = gpu::NO_INDEX;
            scene.behaviours.minds.push_back(mind);
        }
        for (const std::uint32_t does : {gpu::DOES_SIT, gpu::DOES_STAY}) {
            gpu::BehaviourState state{};
            state.does = does;
            state.then = gpu::NO_INDEX;
            state.activity = gpu::ACTIVITY_SIT;
            state.lasts.mean = gpu::DWELL_WHILE;
            scene.behaviours.states.push_back(state);
        }
    }

    void addWay(std::uint32_t i, std::uint32_t aisles, std::uint32_t count,
                const std::function<std::uint32_t()>& random) {
        const std::uint32_t each = (count + aisles - 1) / aisles, aisle = i / each;
        gpu::SeatWay way{};
        const auto seat_row = static_cast<float>(random() % 3);
        const bool right = random() % 2 == 1;
        way.mouth = 0.75f + 0.9f * seat_row;
        const float in_row = 0.8f + 0.5f * static_cast<float>(random() % 6);
        way.length = way.mouth + in_row;
        way.lane = 2 * static_cast<std::uint32_t>(seat_row) + (right ? 1 : 0);
        way.aside = 0.3f;
        way.row = i;
        way.first_of_aisle = aisle * each;
        way.count_of_aisle = std::min(count, way.first_of_aisle + each) - way.first_of_aisle;
        way.first_point = static_cast<std::uint32_t>(scene.seats.points.size());
        way.point_count = 3;
        // Every other aisle goes out in its middle: some come to that from the front, others from behind.
        way.fork = aisle % 2 == 1 ? 0.4f : gpu::NO_FORK;
        way.branch = aisle % 2 == 1 ? random() % 3 : 0;
        way.free_side = aisle % 2 == 1 ? 1 + random() % 2 : right ? 0 : 1;
        const float x = 6.0f * static_cast<float>(aisle);
        const auto add = [&](glm::vec2 place, float along) {
            const glm::vec2 beside(along > way.mouth ? 0.0f : -0.3f, 0.0f);
            scene.seats.points.push_back({place, beside, -0.5f * beside, 0, along});
        };
        add({x, 0}, 0);
        add({x, -way.mouth}, way.mouth);
        add({x + (right ? in_row : -in_row), -way.mouth}, way.length);
        scene.seats.sitter_of_row.push_back(i);
        scene.seats.ways.push_back(way);
    }

    authoring::Scene scene;
};

struct Seen {
    float gap = kFar, halt = kFar;
    bool comes_out = false, goes_in = false, passes = false, line_taken = false, aisle_taken = false;
    bool comes_in = false;
};

bool isWalking(const gpu::Sitter& sitter) {
    return sitter.mode == gpu::SITTER_ENTERS || sitter.mode == gpu::SITTER_LEAVES;
}

/// As shaders/seats/others.glsl has it.
Seen around(const authoring::SeatWays& seats, std::uint32_t index) {
    const gpu::Sitter& self = seats.sitters[index];
    const gpu::SeatWay& way = seats.ways[index];
    const bool out = self.mode == gpu::SITTER_LEAVES;
    Seen seen;
    if (out) seen.halt = -kFar;
    for (std::uint32_t i = way.first_of_aisle; i < way.first_of_aisle + way.count_of_aisle; ++i) {
        if (i == index) continue;
        const gpu::Sitter& other = seats.sitters[i];
        const gpu::SeatWay& theirs = seats.ways[i];
        const bool same = theirs.lane == way.lane, leaves = other.mode == gpu::SITTER_LEAVES;
        seen.comes_in = seen.comes_in || other.mode == gpu::SITTER_ENTERS;
        // They share a branch, or are both where the branches meet.
        const auto together = [&](float place, float their_place) {
            return way.branch == theirs.branch || std::max(place, their_place) < way.fork + 1.5f;
        };
        const bool in_file =
            other.side == self.side || (way.fork != gpu::NO_FORK && (other.side == 0 || self.side == 0));
        if (isWalking(other) && leaves == out) {
            const float parting =
                !out && way.branch != theirs.branch ? std::min(theirs.mouth, way.fork) : theirs.mouth;
            const float in_aisle = parting + (out ? 0.7f : 0.3f);
            const bool elsewhere = !same && (self.along > way.mouth || other.along > in_aisle);
            const float place = same ? other.along : std::min(other.along, parting);
            const bool apart = out && ((!same && !in_file) || !together(self.along, place));
            const float ahead = out ? self.along - place : place - self.along;
            if (!apart && !elsewhere && (ahead > 0.0f || (ahead == 0.0f && i < index)))
                seen.gap = std::min(seen.gap, ahead);
        }
        if (leaves && !same && in_file && way.branch == theirs.branch) {
            const bool in_aisle = other.along <= theirs.mouth, at_mouth = other.along < theirs.mouth + 0.85f;
            if (!in_aisle && at_mouth && other.share < 0.4f && self.along <= way.mouth &&
                self.along > theirs.mouth + 0.8f)
                seen.halt = std::max(seen.halt, theirs.mouth + 0.8f);
            const float beyond = other.along - way.mouth;
            const bool earlier = other.since < self.since || (other.since == self.since && i < index);
            if (in_aisle && beyond > -0.55f && beyond < 0.8f) seen.aisle_taken = true;
            if (!in_aisle && at_mouth && std::abs(theirs.mouth - way.mouth) < 0.55f && earlier)
                seen.aisle_taken = true;
        }
        if (!same) continue;
        if (other.mode == gpu::SITTER_RISES || (leaves && other.along > theirs.mouth - 0.05f))
            seen.comes_out = true;
        if (other.mode == gpu::SITTER_ENTERS && other.along > theirs.mouth - 0.75f) seen.goes_in = true;
        const float to_seat = leaves ? other.along - way.length : way.length - other.along;
        if (isWalking(other) && theirs.length > way.length + 0.1f && to_seat > -0.4f && to_seat < 1.3f)
            seen.passes = true;
        if (isWalking(other) && std::abs(other.along - way.length) < 0.6f) seen.line_taken = true;
        const bool up =
            (other.mode == gpu::SITTER_STANDS_FOR || other.mode == gpu::SITTER_RISES) && other.share >= 0.85f;
        if (isWalking(other) || up || theirs.length > way.length - 0.1f) continue;
        if (self.mode == gpu::SITTER_ENTERS && theirs.length > self.along - 0.1f)
            seen.halt = std::min(seen.halt, theirs.length - 0.45f);
        if (out && theirs.length < self.along + 0.1f) seen.halt = std::max(seen.halt, theirs.length + 0.45f);
    }
    return seen;
}

float roomFor(const gpu::Sitter& self, const gpu::SeatWay& way, const Seen& seen) {
    const bool in = self.mode == gpu::SITTER_ENTERS;
    float room = in ? std::min(way.length, seen.halt) - self.along : self.along - std::max(seen.halt, 0.0f);
    const bool merges =
        way.fork != gpu::NO_FORK && self.along > way.fork - 0.7f && self.along < way.fork + 1.5f;
    const float gap = merges || std::abs(self.along - way.mouth) < 0.7f ? 0.75f
                      : self.along > way.mouth                          ? 0.45f
                                                                        : 0.55f;
    room = std::min(room, seen.gap - gap);
    const float line = way.mouth - 0.75f, waits = way.mouth + 0.75f;
    if (in && seen.comes_out && self.along < line + 0.02f) room = std::min(room, line - self.along);
    if (!in && seen.aisle_taken && self.along > waits - 0.02f) room = std::min(room, self.along - waits);
    return std::max(room, 0.0f);
}

/// What becomes of somebody in a step. @param wants to be in its seat
gpu::Sitter after(const authoring::SeatWays& seats, std::uint32_t index, bool wants, float preferred,
                  float dt) {
    gpu::Sitter self = seats.sitters[index];
    const gpu::SeatWay& way = seats.ways[index];
    const Seen seen = around(seats, index);
    const float seconds = static_cast<float>(1u - self.since) * dt;
    const auto move = [&](float time) { self.share = std::clamp(self.share + dt / time, 0.0f, 1.0f); };
    switch (self.mode) {
        case gpu::SITTER_ENTERS:
        case gpu::SITTER_LEAVES: {
            const float room = roomFor(self, way, seen);
            const float most = std::min(preferred, self.along > way.mouth ? 0.6f : 0.8f);
            self.speed = std::min(std::min(most, self.speed + 1.5f * dt),
                                  std::max(room / 0.5f, std::min(room / dt, 0.1f)));
            const float step = std::min(self.speed * dt, room);
            if (self.mode == gpu::SITTER_ENTERS) {
                self.along += step;
                if (way.length - self.along < 0.02f) self.mode = gpu::SITTER_TURNS;
            } else {
                self.share = step > 0.0f ? 1.0f : std::max(0.0f, self.share - dt / 4.0f);
                const bool decides = way.fork == gpu::NO_FORK
                                         ? self.along > way.mouth
                                         : self.along > std::min(way.mouth + 1.2f, way.length - 0.01f);
                if (decides) self.side = seen.comes_in ? 0 : way.free_side;
                self.along -= step;
                if (self.along < 0.02f) self.mode = gpu::SITTER_WALKS;
            }
            break;
        }
        case gpu::SITTER_TURNS:
            if (seconds < 0.8f) break;
            self.share = 1.0f;
            self.mode = seen.passes ? gpu::SITTER_STANDS_FOR : gpu::SITTER_SETTLES;
            break;
        case gpu::SITTER_SETTLES:
            move(-0.9f);
            if (seen.passes)
                self.mode = gpu::SITTER_STANDS_FOR;
            else if (self.share == 0.0f)
                self.mode = gpu::SITTER_SITS;
            break;
        case gpu::SITTER_SITS:
            if (seen.passes || (!wants && !seen.goes_in)) self.mode = gpu::SITTER_LETS_GO;
            break;
        case gpu::SITTER_LETS_GO:
            if (seconds >= 0.9f)
                self.mode = seen.passes ? gpu::SITTER_STANDS_FOR
                            : wants     ? gpu::SITTER_SITS
                                        : gpu::SITTER_RISES;
            break;
        case gpu::SITTER_STANDS_FOR:
            move(seen.passes ? 0.7f : -0.9f);
            if (!wants && !seen.goes_in) self.mode = gpu::SITTER_RISES;
            if (self.share == 0.0f) self.mode = gpu::SITTER_SITS;
            break;
        case gpu::SITTER_RISES:
            move(0.7f);
            if (self.share == 1.0f && !seen.line_taken && !seen.goes_in) self.mode = gpu::SITTER_LEAVES;
            break;
        default:
            break;
    }
    return self;
}

class SeatsTest : public GpuTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(SeatsTest, AStepIsThatOfPlainCpp) {
    const Block block(GetParam());
    const authoring::SeatWays& seats = block.scene.seats;
    sim::Simulation simulation(block.scene, library);
    simulation.step();
    const auto found = simulation.parts().buffers.sitters.download<gpu::Sitter>(seats.sitters.size());
    std::set<std::pair<std::uint32_t, std::uint32_t>> changes;
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        const float preferred = block.scene.people[i].preferred_speed;
        const bool wants = block.scene.behaviours.minds[i].state == 0;
        const gpu::Sitter expected = after(seats, i, wants, preferred, simulation.parameters().step_seconds);
        ASSERT_EQ(found[i].mode, expected.mode)
            << "of " << i << ", who was in mode " << seats.sitters[i].mode;
        ASSERT_NEAR(found[i].along, expected.along, 1e-5f) << i;
        ASSERT_NEAR(found[i].share, expected.share, 1e-5f) << i;
        if (isWalking(expected)) {
            ASSERT_NEAR(found[i].speed, expected.speed, 1e-4f) << i;
            ASSERT_EQ(found[i].side, expected.side) << i;
        }
        changes.emplace(seats.sitters[i].mode, expected.mode);
    }
    if (GetParam() > 1000) {
        EXPECT_GE(changes.size(), 18u) << "from how many modes to how many";
    }
}

TEST_P(SeatsTest, GoOnFromASavedState) {
    const Block block(GetParam());
    sim::Simulation whole(block.scene, library), second(block.scene, library);
    const auto run = [](sim::Simulation& simulation, int steps) {
        for (int step = 0; step < steps; ++step)
            simulation.step();
    };
    run(whole, 12);
    const sim::Simulation::State saved = whole.save();
    run(whole, 12);
    second.restore(saved);
    run(second, 12);
    const auto parts = whole.save().parts, again = second.save().parts;
    ASSERT_EQ(parts.size(), again.size());
    for (std::size_t i = 0; i < parts.size(); ++i)
        EXPECT_TRUE(parts[i].second == again[i].second) << parts[i].first;
}

INSTANTIATE_TEST_SUITE_P(Sizes, SeatsTest, ::testing::Values(1u, 63u, 1'234u));

}  // namespace
}  // namespace throng::test
