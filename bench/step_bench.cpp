// SPDX-License-Identifier: Apache-2.0
// How long a whole simulation step takes, beside the yardstick that every machine has: one gradient1 diagram (point
// sprites, fragment depth, 32-bit float depth) of 1,024 x 1,024 pixels and 16,384 sites of radius 8 pixels.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <memory>
#include <random>

#include "sim/diagram_methods.h"
#include "sim/gl/context.h"
#include "sim/simulation.h"
#include "tests/sim/scenes.h"

namespace {

using namespace throng;

/// One context for all benchmarks: they run on one thread, one after the other.
gl::Context& context() {
    static gl::Context instance({});
    return instance;
}

authoring::Scene benchScene(std::uint32_t count) {
    authoring::Scene scene = test::uniformScene(count, 2.0f, 7);
    scene.settings.tile_radius = 0.6;
    scene.settings.field_of_view = 200.0;
    scene.settings.samples_per_ray = 6;
    scene.settings.neighbours = 10;
    return scene;
}

void gradient1Diagram(benchmark::State& state) {
    context();
    const auto count = static_cast<std::uint32_t>(state.range(0));
    const auto radius = static_cast<float>(state.range(1));
    sim::GradientDiagram diagram(gl::ShaderLibrary(), {1024, 1024, radius});
    std::mt19937 random(11);
    std::uniform_real_distribution<float> anywhere(0.0f, 1024.0f);
    std::vector<gpu::DiagramSite> sites(count);
    std::vector<std::uint32_t> order(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        sites[i] = {{anywhere(random), anywhere(random)}, radius, i};
        order[i] = i;
    }
    const gl::Buffer site_buffer = gl::makeBuffer("sites", sites);
    const gl::Buffer draw_order = gl::makeBuffer("order", order);
    diagram.connect({&site_buffer, nullptr, &draw_order, count});
    diagram.draw();
    glFinish();
    for (auto _ : state) {
        diagram.draw();
        glFinish();
    }
}

void wholeStep(benchmark::State& state) {
    context();
    sim::Simulation simulation(benchScene(static_cast<std::uint32_t>(state.range(0))), gl::ShaderLibrary());
    for (int i = 0; i < 5; ++i) simulation.step();
    glFinish();
    for (auto _ : state) {
        simulation.step();
        glFinish();
    }
    for (const auto& [pass, milliseconds] : simulation.profile(5)) state.counters[pass] = milliseconds;
}

BENCHMARK(gradient1Diagram)->Args({16384, 8})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(wholeStep)->RangeMultiplier(4)->Range(256, 262144)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
