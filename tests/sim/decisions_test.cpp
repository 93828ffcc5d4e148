// SPDX-License-Identifier: Apache-2.0
// People look round and decide once in several steps; bodies move and touch in each.
#include <algorithm>
#include <cstring>
#include <random>

#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

int stepsPerDecision(double fps, int substeps, double interval) {
    authoring::SimulationSettings settings;
    settings.fps = fps;
    settings.substeps = substeps;
    settings.decision_interval = interval;
    return settings.stepsPerDecision();
}

TEST(StepsPerDecision, AreThoseOfAsManyWholeFramesAsFitTheInterval) {
    const auto steps = [](double fps, int substeps, double interval = 0.084) {
        return stepsPerDecision(fps, substeps, interval);
    };
    EXPECT_EQ(authoring::SimulationSettings().stepsPerDecision(), 4) << "two frames of 24 a second";
    EXPECT_EQ(steps(24, 2), 4);
    EXPECT_EQ(steps(24, 1), 2);
    EXPECT_EQ(steps(25, 2), 4);
    EXPECT_EQ(steps(30, 1), 2);
    EXPECT_EQ(steps(60, 1), 5);
    EXPECT_EQ(steps(12, 2), 2) << "one frame";
    EXPECT_EQ(steps(24, 2, 0.125), 6) << "as long as the interval";
}

TEST(StepsPerDecision, AreAsManyOfAFramesStepsAsFitTheInterval) {
    const auto steps = [](double fps, int substeps, double interval = 0.05) {
        return stepsPerDecision(fps, substeps, interval);
    };
    EXPECT_EQ(steps(24, 2), 2);
    EXPECT_EQ(steps(24, 1), 1);
    EXPECT_EQ(steps(24, 4), 4);
    EXPECT_EQ(steps(10, 4), 2) << "a decision every 0.05 s, two a frame";
    EXPECT_EQ(steps(10, 5), 1) << "neither two nor three are a share of five";
    EXPECT_EQ(steps(20, 3), 3) << "as long as the interval";
    EXPECT_EQ(steps(24, 2, 0.0), 1);
    EXPECT_EQ(steps(1, 64, 0.25), 16);
}

class DecisionsTest : public GpuTest {
  protected:
    using States = std::vector<gpu::AgentState>;

    static authoring::Scene twoWhoMeet() {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        decideSeldom(scene);
        addPerson(scene, {-4, 0.1f}, {8, 0});
        addPerson(scene, {4, 0}, {-8, 0.1f});
        return scene;
    }
    /// In every second frame, which is seldom enough for all that may go wrong between.
    static void decideSeldom(authoring::Scene& scene) { scene.settings.decision_interval = 0.084; }
    static std::vector<gpu::Decision> decisions(sim::Simulation& simulation) {
        return simulation.parts().buffers.decisions.download<gpu::Decision>(2);
    }
    static States states(sim::Simulation& simulation) {
        return simulation.parts().buffers.states.download<gpu::AgentState>(2);
    }
    static bool same(const std::vector<gpu::Decision>& one, const std::vector<gpu::Decision>& other) {
        return std::memcmp(one.data(), other.data(), sizeof(gpu::Decision) * one.size()) == 0;
    }
};

TEST_F(DecisionsTest, AreMadeOnceInSoManyStepsAndKeptUntilTheNext) {
    const authoring::Scene scene = twoWhoMeet();
    const int steps = scene.settings.stepsPerDecision();
    sim::Simulation simulation(scene, library);
    for (int round = 0; round < 10; ++round) {
        simulation.step();
        const auto first = decisions(simulation);
        for (int step = 1; step < steps; ++step) {
            const States between = states(simulation);
            simulation.step();
            EXPECT_TRUE(same(decisions(simulation), first)) << round << ", " << step;
            for (std::size_t row = 0; row < 2; ++row)
                EXPECT_GT(glm::distance(states(simulation)[row].position, between[row].position), 1.0e-4f);
        }
    }
    const auto before = decisions(simulation);
    simulation.step();
    EXPECT_FALSE(same(decisions(simulation), before));
}

/// A crowd that has to squeeze through itself, so that slots change and bodies touch.
authoring::Scene twoBlocksThatMeet() {
    authoring::Scene scene = emptyScene({-12, -12}, {12, 12});
    scene.settings.decision_interval = 0.084;
    for (int i = 0; i < 48; ++i) {
        const glm::vec2 place(static_cast<float>(i % 6), static_cast<float>(i / 6));
        addPerson(scene, glm::vec2(-8, -3) + 0.8f * place, {8, 0});
        addPerson(scene, glm::vec2(8, 3) - 0.8f * place, {-8, 0});
    }
    return scene;
}

/// Of all people, after the state's steps.
std::vector<std::byte> peopleIn(const sim::Simulation::State& state) {
    EXPECT_EQ(state.parts.front().first, "states");
    return state.parts.front().second;
}

TEST_F(DecisionsTest, PicturesBetweenThemChangeNothing) {
    const authoring::Scene scene = twoBlocksThatMeet();
    sim::Simulation plain(scene, library), pictured(scene, library);
    for (int step = 0; step < 200; ++step) {
        plain.step();
        pictured.step();
        pictured.buildDiagramNow();
        if (step % 5 == 0) pictured.buildDiagramNow();
    }
    EXPECT_EQ(peopleIn(plain.save()), peopleIn(pictured.save()));
}

TEST_F(DecisionsTest, StatesBetweenThemAreGoneOnFrom) {
    constexpr int kFirst = 160, kMore = 7;
    const authoring::Scene scene = twoBlocksThatMeet();
    const int last = kFirst + 2 * scene.settings.stepsPerDecision();
    std::vector<sim::Simulation::State> whole;
    sim::Simulation simulation(scene, library);
    for (int step = 1; step <= last + kMore; ++step) {
        simulation.step();
        if (step % 2 == 0) simulation.buildDiagramNow();
        whole.push_back(step >= kFirst ? simulation.save() : sim::Simulation::State{});
    }
    for (int stop = kFirst; stop <= last; ++stop) {
        sim::Simulation second(scene, library);
        for (int step = 0; step < 10; ++step)
            second.step();  // whatever it did before is forgotten
        second.buildDiagramNow();
        second.restore(whole[stop - 1]);
        for (int step = 0; step < kMore; ++step)
            second.step();
        EXPECT_EQ(peopleIn(second.save()), peopleIn(whole[stop - 1 + kMore])) << stop;
    }
}

TEST_F(DecisionsTest, LegsReachUntilTheNextWhatWasDecided) {
    authoring::Scene once = twoWhoMeet(), always = twoWhoMeet();
    always.settings.decision_interval = 0.0;
    sim::Simulation seldom(once, library), often(always, library);
    for (int step = 0; step < 48 * 5; ++step) {
        seldom.step();
        often.step();
    }
    for (std::size_t row = 0; row < 2; ++row)
        EXPECT_LT(glm::distance(states(seldom)[row].position, states(often)[row].position), 0.16f)
            << "m, after 5 s: a tenth of a second later";
}

TEST_F(DecisionsTest, BodiesThatMeetBetweenThemArePartedAtOnce) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {0, 0}, {8, 0});
    addPerson(scene, {0.6f, 0}, {8.6f, 0});
    sim::Simulation simulation(scene, library);
    simulation.step();
    States near = states(simulation);
    const float touch = scene.people[0].radius + scene.people[1].radius;
    near[1].position = near[0].position + glm::vec2(touch - 0.03f, 0.0f);
    simulation.parts().buffers.states.upload(near);
    simulation.step();
    const States after = states(simulation);
    EXPECT_GT(glm::distance(after[0].position, after[1].position), touch - 0.003f);
}

TEST_F(DecisionsTest, RunnersWhoseListsWereMadeFarApartDoNotEndUpInEachOther) {
    for (const float apart : {0.9f, 1.0f, 1.1f, 1.2f}) {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        decideSeldom(scene);
        addPerson(scene, {0, 0}, {8, 0});
        addPerson(scene, {apart, 0}, {-8, 0});
        for (gpu::Person& person : scene.people)
            person.preferred_speed = person.maximum_speed = 4.0f;
        sim::Simulation simulation(scene, library);
        States running = states(simulation);
        running[0].velocity = {4.0f, 0.0f};
        running[1].velocity = {-4.0f, 0.0f};
        simulation.parts().buffers.states.upload(running);
        const float touch = scene.people[0].radius + scene.people[1].radius;
        for (int step = 0; step < 24; ++step) {
            simulation.step();
            const States now = states(simulation);
            EXPECT_GT(glm::distance(now[0].position, now[1].position), 0.98f * touch)
                << apart << ", " << step;
        }
    }
}

/// As shaders/shared/touch_list.glsl has it.
std::uint32_t touchSlot(const std::vector<std::uint32_t>& lists, std::uint32_t slot, std::uint32_t nth) {
    const std::uint32_t two = lists.at(slot * gpu::TOUCH_WORDS + nth / 2);
    const auto after = static_cast<std::int16_t>(nth % 2 == 0 ? two & 0xffffu : two >> 16);
    return slot + static_cast<std::uint32_t>(std::int32_t{after});
}

/// m: as fast as it may get by the next decision, or as it may be at most, and then pushed.
float mayMove(const gpu::Body& body, const gpu::Parameters& parameters) {
    const float speed = std::min(body.maximum_speed, glm::length(body.velocity) + parameters.contact_gain);
    return speed * parameters.decision_seconds + parameters.contact_push;
}

/// People of all paces who go anywhere, dense enough to touch.
class TouchListTest : public DecisionsTest, public testing::WithParamInterface<std::uint32_t> {};

TEST_P(TouchListTest, HoldsWhomSomebodyMayMeetBeforeTheNext) {
    authoring::Scene scene = uniformScene(GetParam(), 0.9f, 5);
    sim::Simulation simulation(scene, library);
    const gpu::Parameters& parameters = simulation.parameters();
    sim::Buffers& buffers = simulation.parts().buffers;
    const std::uint32_t people = GetParam();
    std::mt19937 random(7);
    std::uniform_real_distribution<float> speed(-1.4f, 1.4f);
    States moving = buffers.states.download<gpu::AgentState>(people);
    for (gpu::AgentState& state : moving)
        state.velocity = {speed(random), speed(random)};
    buffers.states.upload(moving);
    simulation.step();
    // As they were when people looked round.
    const auto rows = buffers.bodies.download<gpu::Body>(people);
    const auto words = buffers.touch_words.download<std::uint32_t>(people);
    const auto lists = buffers.touch_lists.download<std::uint32_t>(people * gpu::TOUCH_WORDS);
    std::size_t listed = 0;
    for (std::uint32_t slot = 0; slot < people; ++slot) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t other = 0; other < people; ++other) {
            const float away = glm::distance(rows[slot].position, rows[other].position);
            const float reach = rows[slot].radius + rows[other].radius + mayMove(rows[slot], parameters) +
                                mayMove(rows[other], parameters);
            if (other != slot && away < std::min(reach, parameters.contact_range)) expected.push_back(other);
        }
        const std::uint32_t count = words[slot] & gpu::TOUCH_COUNT_MASK;
        ASSERT_EQ(count, expected.size()) << slot;
        if (count > gpu::TOUCH_CAPACITY) continue;
        std::vector<std::uint32_t> found;
        for (std::uint32_t nth = 0; nth < count; ++nth)
            found.push_back(touchSlot(lists, slot, nth));
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected) << slot;
        listed += count;
    }
    if (people > 100) {
        EXPECT_GT(listed, people / 2);
    }
}

TEST_F(DecisionsTest, WhoIsTooManyPlacesAwayForAListIsPushedAllTheSame) {
    // A crowd seven kilometres wide: in the order of the cells, the next row is 33,000 people away.
    constexpr int kAcross = 16600, kLines = 6;
    constexpr float kApart = 0.45f;
    authoring::Scene scene = emptyScene({-5.0f, -5.0f}, {kApart * kAcross + 5.0f, 8.0f});
    for (int line = 0; line < kLines; ++line)
        for (int i = 0; i < kAcross; ++i) {
            const glm::vec2 place = kApart * glm::vec2(i, line);
            addPerson(scene, place, place, 0.0f, 0.25f);
        }
    scene.settings.proximity = authoring::Proximity::grid;
    sim::Simulation simulation(scene, library);
    simulation.step();
    sim::Buffers& buffers = simulation.parts().buffers;
    const auto people = static_cast<std::uint32_t>(scene.people.size());
    const auto bodies = buffers.bodies.download<gpu::Body>(people);
    const auto words = buffers.touch_words.download<std::uint32_t>(people);
    std::vector<std::uint32_t> slot_of(people);
    for (std::uint32_t slot = 0; slot < people; ++slot)
        slot_of[bodies[slot].row] = slot;
    std::size_t unlisted = 0;
    for (int line = 1; line + 1 < kLines; ++line)
        for (int i = 100; i < kAcross; i += 1000) {
            const auto row = static_cast<std::uint32_t>(line * kAcross + i);
            const auto away = [&](std::uint32_t other) {
                return std::abs(std::int64_t{slot_of[row]} - std::int64_t{slot_of[other]});
            };
            const bool far = std::max(away(row - kAcross), away(row + kAcross)) > 32768;
            EXPECT_EQ((words[slot_of[row]] & gpu::TOUCH_UNLISTED) != 0, far) << line << ", " << i;
            unlisted += far;
        }
    EXPECT_GT(unlisted, 10u);
    for (int step = 0; step < 12; ++step)
        simulation.step();
    // Bodies began 5 cm deep in those beside, before and behind them: the outermost lines have given way.
    const States now = buffers.states.download<gpu::AgentState>(people);
    for (int line = 0; line + 1 < kLines; ++line)
        for (int i = 100; i < kAcross; i += 1000) {
            const auto row = static_cast<std::size_t>(line * kAcross + i);
            EXPECT_GT(now[row + kAcross].position.y - now[row].position.y, 0.47f) << line << ", " << i;
        }
}

INSTANTIATE_TEST_SUITE_P(Sizes, TouchListTest, testing::Values(1u, 63u, 1234u));

TEST_F(DecisionsTest, WhoLeavesBetweenThemIsLeftAlone) {
    int between = 0;
    for (int place = 0; place < 4; ++place) {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        addPerson(scene, {-2.0f - 0.013f * static_cast<float>(place), 0}, {0, 0});
        addPerson(scene, {-2.0f, 3}, {9, 3});
        for (gpu::Stage& stage : scene.stages)
            stage.dwell = 0.0f;
        const int steps = scene.settings.stepsPerDecision();
        sim::Simulation simulation(scene, library);
        States before = states(simulation);
        for (int step = 1; step < 48 * 6; ++step) {
            simulation.step();
            const States now = states(simulation);
            if (before[0].status == gpu::STATUS_GONE)
                ASSERT_EQ(std::memcmp(&now[0], &before[0], sizeof now[0]), 0) << step;
            else if (now[0].status == gpu::STATUS_GONE)
                between += step % steps != 0;
            before = now;
        }
        EXPECT_EQ(before[0].status, gpu::STATUS_GONE);
        EXPECT_EQ(before[1].status, gpu::STATUS_WALKING);
    }
    EXPECT_GT(between, 0) << "somebody left between two decisions";
}

}  // namespace
}  // namespace throng::test
