// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "authoring/scene/raster.h"
#include "base/capsule.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/observe.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

void addSquare(authoring::Scene& scene, glm::vec2 middle, float half, float size, float from, float until) {
    const std::vector<glm::vec2> square = {middle + glm::vec2(-half, -half), middle + glm::vec2(half, -half),
                                           middle + glm::vec2(half, half), middle + glm::vec2(-half, half)};
    const authoring::Box box = authoring::boundsOf(square, 0.0f);
    scene.patches.sized.push_back({box.lower, box.upper, 1.0f, from, until,
                                   static_cast<gpu::uint>(scene.patches.points.size()), 4, size});
    scene.patches.points.insert(scene.patches.points.end(), square.begin(), square.end());
}

/// What scenes from layouts have: room for the largest, and pixels for the smallest.
void makeRoom(authoring::Scene& scene) {
    scene.smallest_radius *= gpu::LEAST_SIZE;
    scene.largest_radius *= gpu::MOST_SIZE;
}

struct Crowd {
    std::uint32_t count;
    float half_axis;
};

class SizesTest : public GpuTest, public ::testing::WithParamInterface<Crowd> {
  protected:
    static Capsule shapeOf(const gpu::Body& body, const gpu::Chest& chest) {
        return capsuleOf(body.position, {std::cos(chest.angle), std::sin(chest.angle)}, double{body.radius},
                         double{chest.half_axis});
    }
    static double freeOfWall(const Capsule& body, const gpu::WallSegment& wall) {
        const Capsule solid{0.5 * glm::dvec2(wall.a + wall.b), 0.5 * glm::dvec2(wall.b - wall.a),
                            double{wall.half_thickness}};
        return freeBetween(body, solid);
    }
    static float wantedBy(const authoring::Scene& scene, glm::vec2 place, float now) {
        float size = 1.0f;
        for (const gpu::Patch& patch : scene.patches.sized) {
            const std::span outline(&scene.patches.points[patch.first_point], patch.point_count);
            if (now >= patch.from && now < patch.until && authoring::insidePolygon(outline, place))
                size *= patch.size;
        }
        return std::clamp(size, gpu::LEAST_SIZE, gpu::MOST_SIZE);
    }
};

TEST_P(SizesTest, AreThoseOfTheGroundAsFarAsThereIsRoomAsPlainCodeHasIt) {
    const auto [count, half_axis] = GetParam();
    authoring::Scene scene = uniformScene(count, 0.75f, 7);
    for (std::size_t row = 0; row < scene.people.size(); ++row) {
        scene.people[row].half_axis = row % 3 == 2 ? 0.0f : half_axis;
        scene.people[row].heading = static_cast<float>(row);
    }
    makeRoom(scene);
    addWall(scene, {-4.0f, 0.3f}, {4.0f, 0.5f}, 0.05f);
    addSquare(scene, {1.0f, 1.0f}, 5.0f, 1.5f, -1.0e9f, 1.0e9f);
    addSquare(scene, {4.0f, 3.0f}, 3.0f, 1.7f, 2.0f, 4.0f);
    addSquare(scene, {15.0f, 16.0f}, 7.0f, 0.7f, 3.0f, 1.0e9f);
    sim::Simulation simulation(scene, library);
    sim::Simulation::Parts& parts = simulation.parts();
    sim::Buffers& buffers = parts.buffers;
    std::size_t grown = 0, held = 0, shrunk = 0;
    for (const float now : {0.0f, 1.0f, 2.5f, 3.5f, 3.6f, 3.7f, 3.8f, 5.0f}) {
        parts.cells.run();
        const auto before = buffers.bodies.download<gpu::Body>(count);
        // Where all are discs, nobody has a chest.
        const auto chests =
            buffers.hasBodies() ? buffers.chests.download<gpu::Chest>(count) : std::vector<gpu::Chest>(count);
        parts.sizes->run(now);
        const auto people = buffers.people.download<gpu::Person>(count);
        const auto after = buffers.bodies.download<gpu::Body>(count);
        const auto sites = buffers.sites.download<gpu::DiagramSite>(count);
        std::vector<Capsule> shapes;
        for (const gpu::Body& body : before)
            shapes.push_back(shapeOf(body, chests[body.row]));
        for (std::size_t slot = 0; slot < count; ++slot) {
            const gpu::Person& person = people[before[slot].row];
            const float own = scene.people[before[slot].row].radius;
            const float step = gpu::GROWTH * parts.parameters.decision_seconds;
            double room = double{step};
            for (std::size_t other = 0; other < count; ++other)
                if (other != slot) room = std::min(room, 0.5 * freeBetween(shapes[slot], shapes[other]));
            for (const gpu::WallSegment& wall : scene.wall_segments)
                room = std::min(room, freeOfWall(shapes[slot], wall));
            const float most = static_cast<float>(std::max(room, 0.0));
            const float wanted = own * wantedBy(scene, before[slot].position, now);
            const float expected = std::clamp(wanted, before[slot].radius - step, before[slot].radius + most);
            ASSERT_NEAR(person.radius, expected, 2.0e-6) << now << " s, slot " << slot;
            ASSERT_EQ(after[slot].radius, person.radius);
            ASSERT_EQ(sites[slot].radius, std::max(parts.parameters.tile_radius, person.radius) *
                                              parts.parameters.pixels_per_metre);
            ASSERT_NEAR(person.half_axis, scene.people[before[slot].row].half_axis * person.radius / own,
                        1.0e-6);
            grown += person.radius > before[slot].radius ? 1 : 0;
            held += wanted > before[slot].radius && most < step ? 1 : 0;
            shrunk += person.radius < before[slot].radius ? 1 : 0;
        }
    }
    if (count <= 63) return;
    EXPECT_GT(grown, 100u);
    EXPECT_GT(held, 20u);
    EXPECT_GT(shrunk, 50u);
}

INSTANTIATE_TEST_SUITE_P(Crowds, SizesTest,
                         ::testing::Values(Crowd{1, 0.0f}, Crowd{63, 0.0f}, Crowd{1234, 0.0f},
                                           Crowd{1, 0.08f}, Crowd{63, 0.08f}, Crowd{1234, -0.1f}),
                         [](const auto& each) {
                             return std::to_string(each.param.count) + (each.param.half_axis > 0.0f ? "Bodies"
                                                                        : each.param.half_axis < 0.0f
                                                                            ? "Prams"
                                                                            : "Discs");
                         });

class SizesInTimeTest : public GpuTest {};

TEST_F(SizesInTimeTest, AreTheirOwnAgainToTheLastBit) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    addPerson(scene, {0, 0}, {0, 0}, 1.2f, 0.235f).half_axis = 0.11f;
    makeRoom(scene);
    addSquare(scene, {0, 0}, 3.0f, 1.37f, 0.0f, 2.0f);
    sim::Simulation simulation(scene, library);
    sim::Buffers& buffers = simulation.parts().buffers;
    float largest = 0.0f;
    for (int step = 0; step < 48 * 4; ++step) {
        simulation.step();
        largest = std::max(largest, buffers.people.download<gpu::Person>(1)[0].radius);
    }
    EXPECT_EQ(largest, 0.235f * 1.37f);
    EXPECT_EQ(buffers.people.download<gpu::Person>(1)[0].radius, 0.235f);
    EXPECT_EQ(buffers.people.download<gpu::Person>(1)[0].half_axis, 0.11f);
    EXPECT_EQ(buffers.chests.download<gpu::Chest>(1)[0].half_axis, 0.11f);
}

TEST_F(SizesInTimeTest, GoOnFromACheckpointAsIfNothingHadBeen) {
    authoring::Scene scene = uniformScene(63, 0.6f, 3);
    makeRoom(scene);
    addSquare(scene, {0, 0}, 9.0f, 1.6f, 0.0f, 3.0f);
    sim::Simulation whole(scene, library), second(scene, library);
    const int steps = 8 * scene.settings.stepsPerDecision();
    for (int step = 0; step < steps; ++step)
        whole.step();
    second.restore(whole.save());
    for (int step = 0; step < steps; ++step) {
        whole.step();
        second.step();
    }
    const auto people = whole.parts().buffers.people.download<gpu::Person>(63);
    const auto again = second.parts().buffers.people.download<gpu::Person>(63);
    const auto states = whole.parts().buffers.states.download<gpu::AgentState>(63);
    const auto states_again = second.parts().buffers.states.download<gpu::AgentState>(63);
    for (std::size_t row = 0; row < 63; ++row) {
        EXPECT_EQ(people[row].radius, again[row].radius);
        EXPECT_EQ(states[row].position, states_again[row].position);
        EXPECT_GT(people[row].radius, people[row].own_radius);
    }
}

/// Sixty-three who rest, in a room that has space for them as they will be.
TEST_F(SizesInTimeTest, CrowdsSpreadAndNobodyIsInAnybody) {
    authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
    for (int i = 0; i < 63; ++i) {
        const glm::vec2 place(0.52f * static_cast<float>(i % 9 - 4), 0.52f * static_cast<float>(i / 9 - 3));
        addPerson(scene, place, place, 1.2f, 0.25f);
    }
    makeRoom(scene);
    addWall(scene, {-3.2f, -2.6f}, {3.2f, -2.6f});
    addWall(scene, {3.2f, -2.6f}, {3.2f, 2.6f});
    addWall(scene, {3.2f, 2.6f}, {-3.2f, 2.6f});
    addWall(scene, {-3.2f, 2.6f}, {-3.2f, -2.6f});
    addSquare(scene, {0, 0}, 9.0f, 1.3f, 0.5f, 1.0e9f);
    sim::Simulation simulation(scene, library);
    sim::Buffers& buffers = simulation.parts().buffers;
    float deepest = 0.0f, in_wall = 0.0f;
    for (int step = 0; step < 48 * 8; ++step) {
        simulation.step();
        const auto people = buffers.people.download<gpu::Person>(63);
        const auto states = buffers.states.download<gpu::AgentState>(63);
        for (std::size_t i = 0; i < 63; ++i) {
            for (std::size_t j = 0; j < i; ++j)
                deepest = std::max(deepest, 1.0f - glm::distance(states[i].position, states[j].position) /
                                                       (people[i].radius + people[j].radius));
            for (const gpu::WallSegment& wall : scene.wall_segments)
                in_wall = std::max(in_wall, people[i].radius - wallDistance(states[i].position, wall));
        }
    }
    EXPECT_LT(deepest, 0.02f);
    EXPECT_LT(in_wall, 0.001f);
    for (const gpu::Person& person : buffers.people.download<gpu::Person>(63))
        EXPECT_FLOAT_EQ(person.radius, 1.3f * 0.25f);
}

}  // namespace
}  // namespace throng::test
