// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "sim/simulation_parts.h"
#include "sim/wall_index.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

TEST(MarkedStarts, TellTheWallsOfEveryCellAsPlainStartsDo) {
    std::mt19937 engine(5);
    for (const std::uint32_t width : {1u, 63u, 1'234u})
        for (const int walls : {0, 1, 40}) {
            gpu::Parameters cells{};
            cells.cell_size = 1.0f;
            cells.cells_width = width;
            cells.cells_height = 3;
            std::uniform_real_distribution<float> x(0.0f, static_cast<float>(width)), y(0.0f, 3.0f);
            std::vector<gpu::WallSegment> segments(static_cast<std::size_t>(walls));
            for (gpu::WallSegment& wall : segments) {
                wall.a = {x(engine), y(engine)};
                wall.b = wall.a + glm::vec2(0.5f, 0.2f);
            }
            if (walls > 0) segments.front().a = segments.front().b = {static_cast<float>(width), 3.0f};
            const sim::WallIndex index = sim::indexWalls(segments, cells, 0.3f);
            const std::vector<std::uint32_t> starts = sim::startsOfMarked(index);
            for (std::size_t cell = 0; cell < std::size_t{width} * 3; ++cell) {
                const glm::uvec2 run = sim::wallsNear(starts, cell);
                const std::vector<std::uint32_t> found(index.items.begin() + run.x,
                                                       index.items.begin() + run.y);
                const std::vector<std::uint32_t> expected(index.items.begin() + index.starts[cell],
                                                          index.items.begin() + index.starts[cell + 1]);
                ASSERT_EQ(found, expected) << width << " cells across, " << walls << " walls, cell " << cell;
            }
            EXPECT_LE(starts.size(), 2 * ((std::size_t{width} * 3 + 31) / 32) + index.items.size() + 1);
        }
}

TEST(MarkCells, ListsEveryCellWithinReachOfAPlaceAndFewOthers) {
    std::mt19937 engine(3);
    for (const std::uint32_t width : {1u, 63u, 1'234u}) {
        gpu::Parameters cells{};
        cells.cells_minimum = {-7.0f, 2.0f};
        cells.cell_size = 0.9f;
        cells.cells_width = width;
        cells.cells_height = 17;
        const auto somewhere = [&](float extent) {
            return std::uniform_real_distribution<float>(0.0f, extent)(engine);
        };
        std::vector<glm::vec2> places;
        for (int i = 0; i < 5; ++i)
            places.push_back(cells.cells_minimum +
                             glm::vec2(somewhere(0.9f * static_cast<float>(width)), somewhere(0.9f * 17)));
        const float reach = 1.5f;
        const std::vector<std::uint32_t> words = sim::markCells(places, cells, reach);
        ASSERT_EQ(words.size(), (width * 17 + 31) / 32);
        for (std::uint32_t cell = 0; cell < width * 17; ++cell) {
            const glm::vec2 lower = cells.cells_minimum + 0.9f * glm::vec2(cell % width, cell / width);
            float nearest = 1e9f;  // to the middle
            bool reached = false;
            for (const glm::vec2 place : places) {
                const glm::vec2 inside = glm::clamp(place, lower, lower + 0.9f);
                reached = reached || glm::distance(place, inside) <= reach;
                nearest = std::min(nearest, glm::distance(place, lower + 0.45f));
            }
            const bool marked = (words[cell / 32] >> cell % 32 & 1u) != 0;
            if (reached) {
                EXPECT_TRUE(marked) << cell;
            }
            if (nearest > reach + 0.65f) {
                EXPECT_FALSE(marked) << cell;
            }
        }
    }
}

TEST(MarkCells, NobodyTakesTurnsWhereThereIsNoPlace) {
    gpu::Parameters cells{};
    cells.cell_size = 1.0f;
    cells.cells_width = cells.cells_height = 9;
    EXPECT_EQ(sim::markCells({}, cells, 1.5f), std::vector<std::uint32_t>(3, 0u));
}

/// Of two who overlap and want to go east, both long held up: how far each is pushed by the other, m.
struct Pushes {
    float ahead, behind;
};

class TurnsTest : public GpuTest {
  protected:
    static constexpr float overlap = 0.1f;  // m
    static constexpr float walked = 1.2f / 48.0f;

    authoring::Scene pair() {
        authoring::Scene scene = emptyScene({-10, -10}, {10, 10});
        addPerson(scene, {0.0f, 0.0f}, {8, 0});
        addPerson(scene, {overlap - 0.5f, 0.0f}, {8, 0});
        scene.narrow_places.push_back({0.5f, 0.0f});
        return scene;
    }
    std::vector<gpu::AgentState> step(sim::Simulation& simulation, std::size_t people) {
        sim::Buffers& buffers = simulation.parts().buffers;
        auto states = buffers.states.download<gpu::AgentState>(people);
        for (gpu::AgentState& state : states) {
            state.velocity = {1.2f, 0.0f};
            state.nervousness = 0.8f;
        }
        buffers.states.upload(states);
        simulation.step();
        return buffers.states.download<gpu::AgentState>(people);
    }
    Pushes pushesIn(const authoring::Scene& scene) {
        sim::Simulation simulation(scene, library);
        const auto states = step(simulation, scene.people.size());
        return {states[0].position.x - walked, overlap - 0.5f + walked - states[1].position.x};
    }
};

TEST_F(TurnsTest, WhoIsBehindAtANarrowPassageMakesAllTheRoom) {
    const Pushes pushes = pushesIn(pair());
    EXPECT_LT(pushes.ahead, 0.02f * overlap);
    EXPECT_NEAR(pushes.ahead + pushes.behind, overlap, 0.01f);
}

TEST_F(TurnsTest, ElsewhereBothMakeHalfOfIt) {
    authoring::Scene scene = pair();
    scene.narrow_places[0] = {0.5f, 5.0f};
    const Pushes pushes = pushesIn(scene);
    EXPECT_NEAR(pushes.ahead, pushes.behind, 0.001f);
    EXPECT_NEAR(pushes.ahead + pushes.behind, overlap, 0.01f);
}

TEST_F(TurnsTest, WhoWasGivenAHeadwayTakesTurnsByThat) {
    authoring::Scene scene = pair();
    for (gpu::Person& person : scene.people)
        person.headway = 0.3f;
    const Pushes pushes = pushesIn(scene);
    EXPECT_NEAR(pushes.ahead, pushes.behind, 0.005f);
}

TEST_F(TurnsTest, NobodyTakesTurnsWhereSomebodyComesTheOtherWay) {
    for (const bool comes : {false, true}) {
        authoring::Scene scene = pair();
        addPerson(scene, {1.5f, 1.0f}, {comes ? -8.0f : 8.0f, 1.0f});
        const Pushes pushes = pushesIn(scene);
        EXPECT_EQ(pushes.ahead > 0.3f * overlap, comes);
    }
}

TEST_F(TurnsTest, WhoCrossesDoesNotComeTheOtherWay) {
    authoring::Scene scene = pair();
    addPerson(scene, {1.5f, 1.0f}, {1.5f, -8.0f});
    EXPECT_LT(pushesIn(scene).ahead, 0.02f * overlap);
}

}  // namespace
}  // namespace throng::test
