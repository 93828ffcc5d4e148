// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/raster.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

/// Stars of seven corners: outlines that fold inwards, also over each other.
void addStar(authoring::Scene& scene, glm::vec2 middle, float pace, float from, float until) {
    std::vector<glm::vec2> star;
    for (int i = 0; i < 14; ++i) {
        const float angle = static_cast<float>(i) * 0.4488f;
        star.push_back(middle + (i % 2 ? 3.0f : 8.0f) * glm::vec2(std::cos(angle), std::sin(angle)));
    }
    const authoring::Box box = authoring::boundsOf(star, 0.0f);
    scene.patches.slow.push_back({box.lower, box.upper, pace, from, until,
                                  static_cast<gpu::uint>(scene.patches.points.size()), 14, 1.0f});
    scene.patches.points.insert(scene.patches.points.end(), star.begin(), star.end());
}

class PatchesTest : public GpuTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(PatchesTest, SlowDownThoseOnThemAsPlainCodeHasIt) {
    authoring::Scene scene = uniformScene(GetParam(), 1.0f, 7);
    addStar(scene, {2.0f, 3.0f}, 0.5f, -1.0e9f, 1.0e9f);
    addStar(scene, {5.0f, 3.0f}, 0.3f, 2.0f, 4.0f);
    addStar(scene, {-4.0f, -3.0f}, 1.25f, 3.0f, 1.0e9f);
    sim::Simulation simulation(scene, library);
    sim::Simulation::Parts& parts = simulation.parts();
    parts.cells.run();
    const auto bodies = parts.buffers.bodies.download<gpu::Body>(GetParam());
    std::size_t slowed = 0;
    for (const float now : {0.0f, 2.0f, 3.5f, 4.0f}) {
        parts.buffers.preferred_velocities.upload(std::vector(GetParam(), glm::vec2(1.0f, -2.0f)));
        parts.patches->run(now);
        const auto wishes = parts.buffers.preferred_velocities.download<glm::vec2>(GetParam());
        for (std::size_t slot = 0; slot < bodies.size(); ++slot) {
            float pace = 1.0f;
            for (const gpu::Patch& patch : scene.patches.slow) {
                const std::span outline(&scene.patches.points[patch.first_point], patch.point_count);
                if (now >= patch.from && now < patch.until &&
                    authoring::insidePolygon(outline, bodies[slot].position))
                    pace *= patch.pace;
            }
            slowed += pace != 1.0f ? 1 : 0;
            ASSERT_EQ(wishes[slot], pace * glm::vec2(1.0f, -2.0f)) << now << " s, slot " << slot;
        }
    }
    if (GetParam() <= 63) return;
    EXPECT_GT(slowed, 100u);
}

INSTANTIATE_TEST_SUITE_P(Sizes, PatchesTest, ::testing::Values(1u, 63u, 1234u));

}  // namespace
}  // namespace throng::test
