// SPDX-License-Identifier: Apache-2.0
#include <random>

#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

/// Whether two pieces cross, in double precision.
bool cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
    const auto side = [](glm::dvec2 from, glm::dvec2 to, glm::dvec2 point) {
        const glm::dvec2 way = to - from, off = point - from;
        return way.x * off.y - way.y * off.x;
    };
    return (side(a, b, c) > 0.0) != (side(a, b, d) > 0.0) && (side(c, d, a) > 0.0) != (side(c, d, b) > 0.0);
}

using Keys = std::vector<std::uint32_t>;

Keys neighboursOf(const sim::Buffers& buffers, std::size_t slot, int most) {
    const std::uint32_t capacity = buffers.slotCapacity();
    const auto all = buffers.neighbours.download<std::uint32_t>(std::size_t{capacity} * most);
    const auto counts = buffers.neighbour_counts.download<std::uint32_t>(slot + 1);
    Keys keys;
    for (std::uint32_t i = 0; i < counts[slot]; ++i)
        keys.push_back(all[i * capacity + slot]);
    return keys;
}

class HidingTest : public GpuTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(HidingTest, LeavesOutThoseBehindHighWallsAsPlainCodeHasIt) {
    authoring::Scene scene = uniformScene(GetParam(), 0.8f, 3);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> at(-9.0f, 9.0f);
    // In this order, whatever a compiler makes of arguments.
    const auto somewhere = [&] {
        const float y = at(random);
        return glm::vec2(at(random), y);
    };
    for (int wall = 0; wall < 24; ++wall) {
        const glm::vec2 from = somewhere();
        addWall(scene, from, from + 0.3f * somewhere(), 0.05f);
        if (wall % 3 != 0) scene.hiding_walls.push_back(static_cast<std::uint32_t>(wall));
    }
    sim::Simulation simulation(scene, library);
    sim::Simulation::Parts& parts = simulation.parts();
    parts.cells.run();
    parts.diagram.build(sim::Extent::everywhere);
    parts.sensing.run();
    const auto bodies = parts.buffers.bodies.download<gpu::Body>(GetParam());
    std::vector<Keys> wanted;
    std::size_t hidden = 0, kept = 0;
    for (std::size_t slot = 0; slot < bodies.size(); slot += 1 + bodies.size() / 200) {
        wanted.emplace_back();
        for (const std::uint32_t key : neighboursOf(parts.buffers, slot, scene.settings.neighbours)) {
            const bool is_wall = (key & gpu::NEIGHBOUR_IS_WALL) != 0;
            const bool is_hidden =
                !is_wall && std::ranges::any_of(scene.hiding_walls, [&](std::uint32_t wall) {
                    const gpu::WallSegment& segment = scene.wall_segments[wall];
                    return cross(segment.a, segment.b, bodies[slot].position, bodies[key].position);
                });
            hidden += is_hidden ? 1 : 0;
            kept += is_wall || is_hidden ? 0 : 1;
            if (!is_hidden) wanted.back().push_back(key);
        }
    }
    parts.hiding->run();
    std::size_t next = 0;
    for (std::size_t slot = 0; slot < bodies.size(); slot += 1 + bodies.size() / 200)
        ASSERT_EQ(neighboursOf(parts.buffers, slot, scene.settings.neighbours), wanted[next++]) << slot;
    if (GetParam() < 63) return;
    EXPECT_GT(hidden, 10u);
    EXPECT_GT(kept, 100u);
}

INSTANTIATE_TEST_SUITE_P(Sizes, HidingTest, ::testing::Values(1u, 63u, 1234u));

}  // namespace
}  // namespace throng::test
