// SPDX-License-Identifier: Apache-2.0
// Lifts: what is counted of those who wait and ride, against plain C++, and what a lift makes of it.
#include <fmt/format.h>

#include <bit>
#include <optional>

#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/layout_scene.h"

namespace throng::test {
namespace {

constexpr const char* kHouse = R"({{"throng": 1,
    "levels": [{{"id": "ground", "floor": [[-20, -20], [20, -20], [20, 20], [-20, 20]]}},
               {{"id": "upper", "height": 4, "floor": [[-20, -20], [20, -20], [20, 20], [-20, 20]]}}],
    "links": [{{"id": "lift", "type": "lift", "levels": ["ground", "upper"], "at": [0, 17], "size": [2, 2],
               "doors": -90, "capacity": 8}}],
    "areas": [{{"id": "above", "level": "upper", "polygon": [[-5, -5], [5, -5], [5, 5], [-5, 5]]}}],
    "formations": [{{"id": "crowd", "type": "grid", "origin": [-12.6, -10], "rows": 36, "columns": 36,
                    "spacing": 0.7, "count": {}, "goal": "above"}}]}})";

authoring::Scene house(std::uint32_t people) {
    return sceneOfLayout(fmt::format(fmt::runtime(kHouse), people));
}

std::uint32_t phaseOf(std::uint32_t rider) {
    return rider & gpu::RIDER_PHASE;
}
std::uint32_t goalOf(std::uint32_t rider) {
    return rider >> 12 & 0xfu;
}
std::uint32_t spotOf(std::uint32_t rider) {
    return rider >> 16 & 0x3fu;
}

/// What the census counts, of what riders are after it.
struct Counted {
    std::uint32_t aboard = 0, boarding = 0, waiting = 0, goals = 0, spots = 0;
};

/// @param before, after what riders were and are: who was asked in or given a spot since, was counted before
Counted countOf(const std::vector<std::uint32_t>& before, const std::vector<std::uint32_t>& after) {
    Counted counted;
    for (std::size_t row = 0; row < after.size(); ++row) {
        const bool was_asked = phaseOf(before[row]) == gpu::RIDER_BOARDS;
        if (phaseOf(after[row]) == gpu::RIDER_BOARDS) ++(was_asked ? counted.boarding : counted.waiting);
        if (phaseOf(after[row]) == gpu::RIDER_WAITS) ++counted.waiting;
        if (phaseOf(after[row]) != gpu::RIDER_RIDES) continue;
        ++counted.aboard;
        counted.goals |= 1u << goalOf(after[row]);
        const bool had_spot = phaseOf(before[row]) == gpu::RIDER_RIDES && spotOf(before[row]) != gpu::NO_SPOT;
        if (had_spot) counted.spots |= 1u << spotOf(after[row]);
    }
    return counted;
}

class LiftsTest : public GpuTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(LiftsTest, CountsAsPlainCppDoesAndGivesEverybodyASpotOfItsOwn) {
    const authoring::Scene scene = house(GetParam());
    sim::Simulation simulation(scene, library);
    const sim::Buffers& buffers = simulation.parts().buffers;
    std::uint32_t most_aboard = 0, most_waiting = 0;
    for (int step = 0; step < 2160; ++step) {
        const bool look = step % 40 == 0;
        const auto before =
            look ? buffers.riders.download<std::uint32_t>(GetParam()) : std::vector<std::uint32_t>();
        simulation.step();
        if (!look || !simulation.parts().decides) continue;
        const auto after = buffers.riders.download<std::uint32_t>(GetParam());
        const Counted counted = countOf(before, after);
        const auto wishes = buffers.lift_wishes.download<gpu::LiftWishes>(1).front();
        const auto queues = buffers.lift_queues.download<std::uint32_t>(2);
        ASSERT_EQ(wishes.aboard, counted.aboard) << step;
        ASSERT_EQ(wishes.boarding, counted.boarding) << step;
        ASSERT_EQ(wishes.goals, counted.goals) << step;
        ASSERT_EQ(wishes.spots, counted.spots) << step;
        ASSERT_EQ(queues[0] + queues[1], counted.waiting) << step;
        // Two on one spot would be one bit.
        const bool all_have_spots = wishes.entering == 0;
        if (all_have_spots) {
            ASSERT_EQ(std::popcount(wishes.spots), static_cast<int>(wishes.aboard)) << step;
        }
        ASSERT_LE(wishes.aboard + wishes.boarding, 8u);
        most_aboard = std::max(most_aboard, counted.aboard);
        most_waiting = std::max(most_waiting, counted.waiting);
    }
    EXPECT_EQ(most_aboard, std::min(GetParam(), 8u));
    EXPECT_GT(most_waiting, GetParam() > 8 ? 8u : 0u);
}

INSTANTIATE_TEST_SUITE_P(Sizes, LiftsTest, ::testing::Values(1u, 63u, 1234u),
                         [](const auto& each) { return std::to_string(each.param); });

/// A crowd before a lift, and what somebody does who stands between its doors for too long.
class LiftDoorsTest : public GpuTest {
  protected:
    static constexpr std::uint32_t kPeople = 63;

    void SetUp() override {
        GpuTest::SetUp();
        simulation_.emplace(scene, library);
    }

    /// Its doors stay open for half a minute.
    static authoring::Scene patientHouse() {
        authoring::Scene scene = house(kPeople);
        scene.chart_map.lifts.plans.front().dwell = 30.0f;
        return scene;
    }

    gpu::LiftState lift() { return buffers().lift_states.download<gpu::LiftState>(1).front(); }
    gpu::LiftWishes wishes() { return buffers().lift_wishes.download<gpu::LiftWishes>(1).front(); }
    std::vector<std::uint32_t> riders() { return buffers().riders.download<std::uint32_t>(kPeople); }
    sim::Buffers& buffers() { return simulation_->parts().buffers; }

    /// Steps until its doors are open and that is so.
    template <class Condition>
    void untilOpenAnd(Condition is_so) {
        int step = 0;
        while (step++ < 2160 && (lift().phase != gpu::LIFT_IS_OPEN || !is_so()))
            simulation_->step();
        ASSERT_LT(step, 2160);
    }
    /// As if nobody had come or gone for so long.
    void haveWaited(float seconds) {
        std::vector<gpu::LiftState> now = {lift()};
        now[0].idle = seconds;
        buffers().lift_states.upload(now);
    }
    bool isAnybodyAskedIn() { return std::ranges::count(riders(), gpu::RIDER_BOARDS, phaseOf) > 0; }
    /// @returns whether anybody was asked in meanwhile
    bool stepsUntilDoorsClose() {
        bool asked = false;
        for (int step = 0; step < 240 && lift().phase == gpu::LIFT_IS_OPEN; ++step) {
            simulation_->step();
            if (step > 8) asked = asked || isAnybodyAskedIn();
        }
        return asked;
    }

    authoring::Scene scene = patientHouse();
    std::optional<sim::Simulation> simulation_;
};

TEST_F(LiftDoorsTest, WhoIsBeforeThemIsNotAskedInAgainBeforeTheyHaveClosed) {
    untilOpenAnd([&] { return wishes().in_doors > 0; });
    haveWaited(13.0f);
    EXPECT_FALSE(stepsUntilDoorsClose());
    EXPECT_EQ(lift().phase, gpu::LIFT_CLOSES);
    EXPECT_EQ(wishes().in_doors, 0u);
}

TEST_F(LiftDoorsTest, WhoIsJustBehindThemGetsOutAgain) {
    untilOpenAnd([&] { return std::popcount(wishes().spots) >= 2; });
    const std::vector<std::uint32_t> before = riders();
    std::uint32_t row = 0;
    while (phaseOf(before[row]) != gpu::RIDER_RIDES || spotOf(before[row]) == gpu::NO_SPOT)
        ++row;
    const auto stop = buffers().lift_stops.download<gpu::LiftStop>(1).front();  // all begin on the ground
    const auto shifts = buffers().chart_shifts.download<glm::vec2>(stop.chart + 1);
    auto states = buffers().states.download<gpu::AgentState>(kPeople);
    states[row].position = stop.begin + 0.15f * stop.along + shifts[stop.chart];
    states[row].velocity = {0.0f, 0.0f};
    buffers().states.upload(states);
    haveWaited(13.0f);
    EXPECT_FALSE(stepsUntilDoorsClose());
    EXPECT_EQ(lift().phase, gpu::LIFT_CLOSES);
    EXPECT_EQ(phaseOf(riders()[row]), gpu::RIDER_WAITS);
}

TEST_F(LiftDoorsTest, ThatStayOpenForLongLetInWhoComesLate) {
    // Nobody is between them: they have given up on nobody.
    untilOpenAnd([&] { return wishes().aboard > 0 && wishes().in_doors == 0 && wishes().first != 0; });
    haveWaited(20.0f);
    bool asked = false;
    for (int step = 0; step < 12; ++step) {
        simulation_->step();
        asked = asked || isAnybodyAskedIn();
    }
    EXPECT_TRUE(asked);
}

}  // namespace
}  // namespace throng::test
