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

/// Positions frame by frame, with what comes along looked at.
std::vector<float> positionsWith(const sim::FramePump::Cargo& cargo, std::uint32_t count,
                                 const gl::ShaderLibrary& library) {
    const authoring::Scene scene = uniformScene(count, 2.0f, count);
    sim::Simulation simulation(scene, library);
    std::vector<float> positions;
    PerStream<bool> tells;
    sim::FramePump pump(simulation, cargo, [&](const Frame& frame) {
        positions.insert(positions.end(), frame[Stream::pos].begin(), frame[Stream::pos].end());
        for (const StreamInfo& info : kStreams) {
            if (info.source != StreamSource::device) continue;
            ASSERT_EQ(frame[info.id].size(), cargo.streams[info.id] ? count * kComponents : 0u) << info.name;
            for (std::size_t at = 0; at < frame[info.id].size(); ++at) {
                ASSERT_TRUE(std::isfinite(frame[info.id][at])) << info.name;
                const bool is_there = frame[Stream::state][at / kComponents * kComponents] > 0.5f;
                if (!is_there) {
                    ASSERT_EQ(frame[info.id][at], 0.0f) << info.name;
                }
                tells[info.id] = tells[info.id] || frame[info.id][at] != 0.0f;
            }
        }
    });
    for (std::uint32_t frame = 0; frame < 8; ++frame) {
        for (int step = 0; frame > 0 && step < scene.settings.substeps; ++step)
            simulation.step();
        pump.submit(frame, cargo.diagrams && frame % 3 == 0);
    }
    pump.finish();
    EXPECT_EQ(tells, cargo.streams) << "a stream of zeros only";
    return positions;
}

TEST_F(FramePumpTest, CarriesTheStreamsFromTheDeviceThatItIsAskedForAndChangesNothingElse) {
    StreamChoice all;
    for (const StreamInfo& info : kStreams)
        all[info.id] = info.source == StreamSource::device;
    for (const std::uint32_t count : {1u, 63u, 1234u}) {
        const std::vector<float> alone = positionsWith({}, count, library);
        EXPECT_EQ(positionsWith({false, false, all}, count, library), alone);
        EXPECT_EQ(positionsWith({true, true, all}, count, library), alone);
        for (const StreamInfo& info : kStreams) {
            StreamChoice one;
            one[info.id] = all[info.id];
            EXPECT_EQ(positionsWith({false, false, one}, count, library), alone);
        }
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
