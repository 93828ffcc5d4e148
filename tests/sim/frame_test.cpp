// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <stdexcept>

#include "sim/frame_pump.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

class FramePumpTest : public GpuTest {};

TEST_F(FramePumpTest, DeliversEveryFrameInOrderWithWhatTheSimulationHolds) {
    for (const std::uint32_t count : {1u, 63u, 1234u}) {
        const authoring::Scene scene = uniformScene(count, 2.0f, count);
        sim::Simulation simulation(scene, library);
        std::vector<std::vector<float>> received;
        std::vector<std::vector<float>> expected;
        {
            sim::FramePump pump(simulation, {}, [&](const Frame& frame) {
                EXPECT_EQ(frame.index, received.size());
                EXPECT_EQ(frame[Stream::state].size(), count * 3u);
                EXPECT_EQ(frame[Stream::state][0], 1.0f) << "under way";
                received.emplace_back(frame[Stream::pos].begin(), frame[Stream::pos].end());
            });
            for (std::uint32_t frame = 0; frame < 20; ++frame) {
                simulation.step();
                pump.submit(frame, false);
                std::vector<float> positions;
                for (const gpu::AgentState& state :
                     simulation.parts().buffers.states.download<gpu::AgentState>(count))
                    positions.insert(positions.end(), {state.position.x, state.position.y, 0.0f});
                expected.push_back(positions);
            }
            pump.finish();
        }
        EXPECT_EQ(received, expected);
    }
}

TEST_F(FramePumpTest, DiagramsAgreeWithTheFramesPositions) {
    for (const auto method : {authoring::DiagramMethod::per_site, authoring::DiagramMethod::gradient1}) {
        authoring::Scene scene = uniformScene(63, 2.0f, 4);
        scene.settings.method = method;
        addWall(scene, {1, 1}, {12, 9});
        sim::Simulation simulation(scene, library);
        int looked = 0;
        sim::FramePump pump(simulation, {true, false, {}}, [&](const Frame& frame) {
            ASSERT_EQ(frame.diagram != nullptr, frame.index % 2 == 0);
            if (!frame.diagram) return;
            const DiagramImage& image = *frame.diagram;
            for (std::uint32_t row = 0; row < 63; ++row) {
                const auto at_row = rowOf(frame[Stream::pos], row);
                const glm::vec2 position(at_row[0], at_row[1]);
                const glm::uvec2 pixel((position - image.minimum) * image.pixels_per_metre);
                const std::size_t at = std::size_t{pixel.y} * image.width + pixel.x;
                ASSERT_NE(image.site[at], kNone);
                // Whoever owns the pixel under somebody's feet is no further away than that person.
                const glm::vec2 centre = image.minimum + (glm::vec2(pixel) + 0.5f) / image.pixels_per_metre;
                EXPECT_LE(image.distance[at], glm::distance(centre, position) + 1.0e-4f);
                if (image.site[at] == row) ++looked;
            }
        });
        for (std::uint32_t frame = 0; frame < 4; ++frame) {
            simulation.step();
            pump.submit(frame, frame % 2 == 0);
        }
        pump.finish();
        EXPECT_GT(looked, 60);
    }
}

TEST_F(FramePumpTest, AFailingReceiverStopsTheBake) {
    sim::Simulation simulation(uniformScene(5, 2.0f, 1), library);
    sim::FramePump pump(simulation, {}, [](const Frame& frame) {
        if (frame.index == 3) throw std::runtime_error("disk full");
    });
    EXPECT_THROW(
        {
            for (std::uint32_t frame = 0; frame < 50; ++frame) {
                simulation.step();
                pump.submit(frame, false);
            }
            pump.finish();
        },
        std::runtime_error);
}

}  // namespace
}  // namespace throng::test
