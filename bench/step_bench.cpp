// SPDX-License-Identifier: Apache-2.0
// How long a whole simulation step takes, beside the yardstick that every machine has: one gradient1 diagram
// (point sprites, fragment depth, 32-bit float depth) of 1,024 x 1,024 pixels and 16,384 sites of radius 8
// pixels.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <random>

#include "sim/benchmarks/diagram_benchmark.h"
#include "sim/benchmarks/open_crowd.h"
#include "sim/diagram/methods.h"
#include "sim/gl/context.h"
#include "sim/simulation.h"

namespace {

using namespace throng;

/// One context for all benchmarks: they run on one thread, one after the other.
gl::Context& context() {
    static gl::Context instance({});
    return instance;
}

/// THRONG_SHADER_DIR lets variants of a shader be timed without building.
gl::ShaderLibrary shaders() {
    const char* folder = std::getenv("THRONG_SHADER_DIR");
    return folder ? gl::ShaderLibrary(folder) : gl::ShaderLibrary();
}

authoring::Scene benchScene(std::uint32_t count) {
    authoring::Scene scene = sim::openCrowd(count, 2.0f, 7);  // one person per 4 m^2
    scene.settings.tile_radius = 0.6;
    scene.settings.field_of_view = 200.0;
    scene.settings.samples_per_ray = 6;
    scene.settings.neighbours = 10;
    for (gpu::Person& person : scene.people)
        person.radius = 0.3f;
    scene.smallest_radius = scene.largest_radius = 0.3f;
    return scene;
}

using sim::median;

template <class Work>
double milliseconds(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// The yardstick: `count` sites of `radius` px drawn into 1,024 x 1,024 px.
class Gradient1 {
  public:
    Gradient1(std::uint32_t count, float radius)
        : options_{sim::DiagramMethod::gradient1, 1024, 1024, radius, count, 0, {}, false},
          owners_("owners", 4 * 1024 * 1024),
          diagram_({gl::ShaderLibrary(), options_, {}, owners_, long_work_}) {
        std::mt19937 random(11);
        std::uniform_real_distribution<float> anywhere(0.0f, 1024.0f);
        std::vector<gpu::DiagramSite> sites(count);
        std::vector<std::uint32_t> order(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            sites[i] = {{anywhere(random), anywhere(random)}, radius, i};
            order[i] = i;
        }
        sites_ = gl::makeBuffer("sites", sites);
        order_ = gl::makeBuffer("order", order);
        diagram_.connect({&sites_, nullptr, &order_});
    }
    void draw() { diagram_.draw(); }

  private:
    sim::DiagramOptions options_;
    gl::Buffer owners_;
    sim::LongWork long_work_;
    sim::GradientDiagram diagram_;
    gl::Buffer sites_, order_;
};

void gradient1Diagram(benchmark::State& state) {
    context();
    Gradient1 yardstick(static_cast<std::uint32_t>(state.range(0)), static_cast<float>(state.range(1)));
    milliseconds([&] { yardstick.draw(); });
    for (auto _ : state)
        milliseconds([&] { yardstick.draw(); });
}

void wholeStep(benchmark::State& state) {
    context();
    sim::Simulation simulation(benchScene(static_cast<std::uint32_t>(state.range(0))), shaders());
    for (int i = 0; i < 5; ++i)
        milliseconds([&] { simulation.step(); });
    for (auto _ : state)
        milliseconds([&] { simulation.step(); });
    for (const auto& [pass, time] : simulation.profile(20))
        state.counters[pass] = time;
}

/// Frames' steps and yardsticks in turn, so that both meet the same noise. `ratio` is the median of the
/// pairs' ratios, of a step's mean time.
void stepOverGradient1(benchmark::State& state) {
    context();
    Gradient1 yardstick(16384, 8.0f);
    const authoring::Scene scene = benchScene(16384);
    const int in_frame = scene.settings.stepsPerDecision();
    sim::Simulation simulation(scene, shaders());
    for (int i = 0; i < 6; ++i)
        milliseconds([&] { simulation.step(), yardstick.draw(); });
    std::vector<double> steps, yardsticks, ratios;
    for (auto _ : state) {
        steps.push_back(milliseconds([&] {
                            for (int step = 0; step < in_frame; ++step)
                                simulation.step();
                        }) /
                        in_frame);
        yardsticks.push_back(milliseconds([&] { yardstick.draw(); }));
        ratios.push_back(steps.back() / yardsticks.back());
    }
    state.counters["step_ms"] = median(steps);
    state.counters["gradient1_ms"] = median(yardsticks);
    state.counters["ratio"] = median(ratios);
    for (const auto& [pass, time] : simulation.profile(20))
        state.counters[pass] = time;
}

BENCHMARK(stepOverGradient1)->Iterations(100)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(gradient1Diagram)->Args({16384, 8})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(wholeStep)->RangeMultiplier(4)->Range(256, 262144)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
