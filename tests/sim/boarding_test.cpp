// SPDX-License-Identifier: Apache-2.0
// Boarding: what is counted of those who wait at doors of vehicles and go through them, against plain C++.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/layout_scene.h"

namespace throng::test {
namespace {

constexpr const char* kStop = R"({{"throng": 1,
    "areas": [{{"id": "platform", "polygon": [[-60, -25], [60, -25], [60, -1.3], [-60, -1.3]]}},
              {{"id": "corner", "polygon": [[-60, -30], [-50, -30], [-50, -25], [-60, -25]]}}],
    "lanes": [{{"id": "rails", "points": [[-40, 0], [200, 0]], "speed": 12,
               "stops": [{{"id": "market", "at": [14, 0], "platform": "platform"}}]}}],
    "vehicles": [{{"id": "4", "lane": "rails", "kind": "tram", "times": [0]}}],
    "flows": [{{"id": "on", "from": "platform", "board": "market", "count": {}, "end": 4}},
              {{"id": "off", "alight": "market", "to": "corner", "count": {}}}]}})";

authoring::Scene stopFor(std::uint32_t people) {
    const std::uint32_t off = std::min(people / 3, 60u);
    return sceneOfLayout(fmt::format(fmt::runtime(kStop), people - off, off));
}

std::uint32_t phaseOf(std::uint32_t passenger) {
    return passenger & gpu::PASSENGER_PHASE;
}
std::uint32_t doorOf(std::uint32_t passenger) {
    return passenger >> 12 & 0xfu;
}

/// What a step leaves behind that the census looks at.
struct World {
    std::vector<gpu::AgentState> states;
    std::vector<gpu::VehicleService> services;
    std::vector<gpu::VehicleBox> boxes;
    std::vector<std::uint32_t> passengers, there;
};

World worldOf(const sim::Buffers& buffers, std::size_t people) {
    return {buffers.states.download<gpu::AgentState>(people),
            buffers.vehicle_services.download<gpu::VehicleService>(1),
            buffers.vehicle_boxes.download<gpu::VehicleBox>(1),
            buffers.passengers.download<std::uint32_t>(people),
            buffers.platform_vehicles.download<std::uint32_t>(1)};
}

/// The tram drives along x, and its doors are on its right: how deep inside a place is, m.
float insideOf(const World& world, glm::vec2 place) {
    return place.y - (world.boxes[0].front.y - world.boxes[0].half_width);
}

/// Whether somebody who waits is to be counted, as plain C++ has it.
bool isCalled(const authoring::Scene& scene, const World& world, std::size_t row) {
    const gpu::AgentState& state = world.states[row];
    const gpu::VehicleService& service = world.services[0];
    const bool lets_in = service.phase == gpu::DOORS_OPEN_UP || service.phase == gpu::DOORS_ARE_OPEN;
    const glm::dvec2 place = scene.origin + glm::dvec2(state.position);
    const bool on_platform = std::abs(place.x) < 60.0 && place.y > -25.0 && place.y < -1.3;
    return state.status == gpu::STATUS_WALKING && scene.stages[state.stage].board != 0 &&
           world.there[0] == 0 && lets_in && service.aboard < service.capacity &&
           (on_platform || state.leave_step != 0);
}

class BoardingTest : public GpuTest {
  protected:
    /// Only the census, on what the last step has left.
    void count(const sim::Buffers& buffers, std::uint32_t people, std::uint32_t steps) {
        const std::string shader = "shaders/boarding/census.comp";
        gl::ComputeProgram census = buffers.connect(library, everythingIn(shader), buffers.definitions());
        census.set("steps_done", steps);
        census.dispatch(people);
    }
};

/// Who has been asked in and is pressed into the vehicle's side comes out of it where it is.
TEST_F(BoardingTest, NobodyIsPutIntoADoorFromBesideIt) {
    constexpr std::uint32_t kPeople = 8;
    const authoring::Scene scene = stopFor(kPeople);
    sim::Simulation simulation(scene, library);
    sim::Buffers& buffers = simulation.parts().buffers;
    World world = worldOf(buffers, kPeople);
    for (int step = 0; step < 20 * 48 && world.services[0].phase != gpu::DOORS_ARE_OPEN; ++step) {
        simulation.step();
        world = worldOf(buffers, kPeople);
    }
    ASSERT_EQ(world.services[0].phase, gpu::DOORS_ARE_OPEN);
    const float side = world.boxes[0].front.y - world.boxes[0].half_width, radius = scene.people[0].radius;
    const glm::vec2 beside(world.boxes[0].front.x - 7.5f, side - radius + 0.02f);  // between two doors
    world.states[0].position = beside;
    world.states[0].velocity = glm::vec2(0.0f);
    world.passengers[0] = gpu::PASSENGER_BOARDS;
    buffers.states.upload(world.states);
    buffers.passengers.upload(world.passengers);
    for (int step = 0; step < 4; ++step) {
        simulation.step();
        const glm::vec2 at = worldOf(buffers, kPeople).states[0].position;
        EXPECT_LT(glm::distance(at, beside), 0.25f) << step;
        EXPECT_LT(at.y, side - radius + 0.03f) << step;
    }
}

class BoardingCensusTest : public BoardingTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(BoardingCensusTest, CountsAsPlainCppDoes) {
    const std::uint32_t people = GetParam();
    const authoring::Scene scene = stopFor(people);
    sim::Simulation simulation(scene, library);
    sim::Buffers& buffers = simulation.parts().buffers;
    std::uint32_t most_waiting = 0, most_through = 0;
    for (std::uint32_t step = 1; step <= 16 * 48; ++step) {
        simulation.step();
        if (step < 4 * 48 || step % 24 != 0) continue;
        const World before = worldOf(buffers, people);
        buffers.door_wishes.fill(0);
        buffers.new_aboard.fill(0);
        count(buffers, people, step);
        const auto after = buffers.passengers.download<std::uint32_t>(people);
        const auto wishes = buffers.door_wishes.download<gpu::DoorWishes>(scene.traffic.doors.size());
        std::vector<gpu::DoorWishes> expected(wishes.size(), gpu::DoorWishes{});
        std::uint32_t aboard = 0;
        for (std::uint32_t row = 0; row < people; ++row) {
            const std::uint32_t was = phaseOf(before.passengers[row]), is = phaseOf(after[row]);
            const float inside = insideOf(before, before.states[row].position);
            const float radius = scene.people[row].radius;
            const bool alive = before.states[row].status == gpu::STATUS_WALKING;
            if (was == gpu::PASSENGER_ALIGHTS) {
                ASSERT_EQ(is == was, alive && inside >= -radius - 0.35f) << row;
            } else if (was == gpu::PASSENGER_BOARDS) {
                const bool gets_in = alive && inside >= 0.75f;
                aboard += gets_in ? 1 : 0;
                const bool is_let = inside > -radius || before.services[0].phase == gpu::DOORS_ARE_OPEN;
                ASSERT_EQ(is == was, alive && !gets_in && is_let) << row;
            } else {
                ASSERT_EQ(is == gpu::PASSENGER_CALLED, isCalled(scene, before, row)) << row;
            }
            if (is == gpu::PASSENGER_NONE) continue;
            gpu::DoorWishes& door = expected[doorOf(after[row])];
            door.waiting += is == gpu::PASSENGER_CALLED ? 1 : 0;
            door.coming_out += is == gpu::PASSENGER_ALIGHTS ? 1 : 0;
            door.going_in += is == gpu::PASSENGER_BOARDS ? 1 : 0;
            door.in_door += is != gpu::PASSENGER_CALLED && inside > -radius ? 1 : 0;
        }
        for (std::size_t door = 0; door < wishes.size(); ++door) {
            ASSERT_EQ(wishes[door].waiting, expected[door].waiting) << step << " " << door;
            ASSERT_EQ(wishes[door].coming_out, expected[door].coming_out) << step << " " << door;
            ASSERT_EQ(wishes[door].going_in, expected[door].going_in) << step << " " << door;
            ASSERT_EQ(wishes[door].in_door, expected[door].in_door) << step << " " << door;
            ASSERT_EQ(wishes[door].first != 0, wishes[door].waiting > 0) << step << " " << door;
            most_waiting = std::max(most_waiting, wishes[door].waiting);
            most_through = std::max(most_through, wishes[door].in_door);
        }
        ASSERT_EQ(buffers.new_aboard.download<std::uint32_t>(1)[0], aboard) << step;
        // Who has been counted as aboard is not counted again.
        buffers.states.upload(before.states);
        buffers.passengers.upload(before.passengers);
    }
    EXPECT_GT(most_waiting, 0u);
    EXPECT_TRUE(people < 63 || most_through > 0);
}

/// Looked at after each step: who is asked in, and who still gets off by then.
TEST_F(BoardingTest, NobodyIsAskedInBeforeTheLastIsClearOfTheDoor) {
    constexpr std::uint32_t kPeople = 63;
    const authoring::Scene scene = stopFor(kPeople);
    sim::Simulation simulation(scene, library);
    const sim::Buffers& buffers = simulation.parts().buffers;
    std::vector<std::uint32_t> before(kPeople, 0);
    std::uint32_t asked_in = 0;
    for (std::uint32_t step = 1; step <= 22 * 48; ++step) {
        simulation.step();
        const auto after = buffers.passengers.download<std::uint32_t>(kPeople);
        for (std::uint32_t row = 0; row < kPeople; ++row) {
            if (phaseOf(after[row]) != gpu::PASSENGER_BOARDS || phaseOf(before[row]) == phaseOf(after[row]))
                continue;
            ++asked_in;
            ASSERT_EQ(buffers.call_heads.download<std::uint32_t>(1)[0], kPeople / 3) << step;
            for (const std::uint32_t other : after)
                ASSERT_FALSE(phaseOf(other) == gpu::PASSENGER_ALIGHTS && doorOf(other) == doorOf(after[row]))
                    << step;
        }
        before = after;
    }
    EXPECT_GT(asked_in, 10u);
}

INSTANTIATE_TEST_SUITE_P(Sizes, BoardingCensusTest, ::testing::Values(1u, 63u, 1234u),
                         [](const auto& each) { return std::to_string(each.param); });

}  // namespace
}  // namespace throng::test
