// SPDX-License-Identifier: Apache-2.0
// Lifts: what is counted of those who wait and ride, against plain C++, and what a lift makes of it.
#include <fmt/format.h>

#include <bit>

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

TEST_P(LiftsTest, WhoIsNotInByTheTimeThatItGivesUpStepsBackAndDoorsClose) {
    const authoring::Scene scene = house(GetParam());
    sim::Simulation simulation(scene, library);
    sim::Buffers& buffers = simulation.parts().buffers;
    const auto lift = [&] { return buffers.lift_states.download<gpu::LiftState>(1).front(); };
    const auto wishes = [&] { return buffers.lift_wishes.download<gpu::LiftWishes>(1).front(); };
    const auto asked = [&] {
        const auto riders = buffers.riders.download<std::uint32_t>(GetParam());
        return std::ranges::count(riders, gpu::RIDER_BOARDS, phaseOf);
    };
    int step = 0;
    while (step < 2160 && (lift().phase != gpu::LIFT_IS_OPEN || wishes().in_doors == 0)) {
        simulation.step();
        ++step;
    }
    ASSERT_LT(step, 2160) << "somebody comes to its doors";
    const std::uint32_t aboard = wishes().aboard;
    std::vector<gpu::LiftState> impatient = {lift()};
    impatient[0].idle = 13.0f;
    buffers.lift_states.upload(impatient);
    for (int more = 0; more < 240 && lift().phase == gpu::LIFT_IS_OPEN; ++more) {
        simulation.step();
        if (more > 8) {
            ASSERT_EQ(asked(), 0) << more;
        }
    }
    EXPECT_EQ(lift().phase, gpu::LIFT_CLOSES);
    EXPECT_LE(wishes().aboard, aboard) << "who stood between the doors has stepped back";
    EXPECT_EQ(wishes().in_doors, 0u);
}

}  // namespace
}  // namespace throng::test
