// SPDX-License-Identifier: Apache-2.0
#include "sim/memory.h"

#include "sim/frame_pump.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/layout_scene.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

class MemoryTest : public GpuTest {
  protected:
    /// What a bake of it really has, in MiB, of buffers.
    double taken(const authoring::Scene& scene) {
        const std::size_t before = gl::bytesOfBuffers();
        sim::Simulation simulation(scene, library);
        const sim::FramePump pump(simulation, {}, [](const Frame&) {});
        simulation.step();
        return static_cast<double>(gl::bytesOfBuffers() - before) / 1048576.0;
    }
    static double told(const authoring::Scene& scene) {
        return static_cast<double>(sim::memoryNeeded(scene).all()) / 1048576.0;
    }
};

TEST_F(MemoryTest, IsToldBeforeADeviceIsAskedForIt) {
    for (const std::uint32_t count : {1u, 63u, 1234u, 16384u, 65536u}) {
        const authoring::Scene scene = uniformScene(count, 2.0f, count);
        const double needed = taken(scene);
        EXPECT_NEAR(told(scene), needed, 0.05 * needed + 0.05) << count << " people";
    }
}

TEST_F(MemoryTest, OfExamplesIsTold) {
    for (const char* name : {"intersection", "station-levels", "zebra", "market", "stadium-wave"}) {
        const authoring::Scene scene = sceneOfExample(name);
        const double needed = taken(scene);
        EXPECT_NEAR(told(scene), needed, 0.1 * needed) << name;
        std::printf("    %s: told %.1f MiB, took %.1f\n", name, told(scene), needed);
    }
}

TEST_F(MemoryTest, GrowsByFourFifthsOfAKibibyteAPerson) {
    const auto people = [](std::uint32_t count) {
        const sim::MemoryNeeded needed = sim::memoryNeeded(uniformScene(count, 2.0f, 1));
        return static_cast<double>(needed.all());
    };
    const double a_person = (people(65536) - people(16384)) / (65536.0 - 16384.0);
    std::printf("    %.0f bytes a person\n", a_person);
    EXPECT_LT(a_person, 0.8 * 1024.0);
    EXPECT_GT(a_person, 100.0);
}

/// m, about half of an adult's breadth less its depth.
constexpr float kHalfAxis = 0.1f;

TEST_F(MemoryTest, OfLargeCrowdsIsFourFifthsOfAKibibyteForEverybody) {
    for (const std::uint32_t count : {16384u, 65536u, 1048576u})
        for (const bool bodies : {false, true}) {
            authoring::Scene scene = uniformScene(count, 2.0f, 1);
            for (gpu::Person& person : scene.people) {
                if (!bodies) break;
                person.radius = 0.13f;
                person.half_axis = kHalfAxis;
            }
            if (bodies) scene.smallest_radius = 0.19f;
            const double each = static_cast<double>(sim::memoryNeeded(scene).all()) / count;
            std::printf("    %u %s: %.0f bytes each\n", count, bodies ? "bodies" : "discs", each);
            EXPECT_LT(each, 0.8 * 1024.0);
            EXPECT_GT(each, 400.0);
        }
}

TEST_F(MemoryTest, CountingMakesNoBuffers) {
    const std::size_t before = gl::bytesOfBuffers();
    {
        const gl::BufferCount count;
        gl::Buffer buffer("one", gl::Room{10, 8, "person"});
        buffer.fill(1);
        buffer.upload(std::vector<std::uint32_t>(20));
        EXPECT_EQ(buffer.handle(), 0u);
        EXPECT_EQ(count.bytes(), 80u);
        EXPECT_EQ(count.buffers().at(0).per, "person");
        EXPECT_THROW(gl::BufferCount(), std::logic_error);
        EXPECT_EQ(gl::BufferCount::kept(), &count) << "it counts on";
    }
    EXPECT_EQ(gl::bytesOfBuffers(), before);
    EXPECT_EQ(gl::BufferCount::kept(), nullptr);
    const gl::Buffer real("two", 64);
    EXPECT_EQ(gl::bytesOfBuffers(), before + 64);
}

}  // namespace
}  // namespace throng::test
