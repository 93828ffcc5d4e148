// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/cost_model.h"

#include <cmath>

#include "sim/benchmarks/calibration.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

using sim::CostModel;
using sim::DiagramLoad;
using sim::DiagramMethod;
using sim::MethodCost;

std::vector<sim::CalibrationSample> samplesOf(const MethodCost& cost, double noise) {
    std::vector<sim::CalibrationSample> samples;
    int n = 0;
    for (const double sites : {64.0, 1024.0, 16384.0, 262144.0})
        for (const double radius : {2.0, 8.0})
            for (const double side : {512.0, 1024.0, 2048.0}) {
                const DiagramLoad load{sites, radius, side * side};
                samples.push_back({load, cost.milliseconds(load) * (1.0 + noise * std::sin(7.0 * ++n))});
            }
    return samples;
}

TEST(CostModel, FindsTheTermsThatMadeTheSamples) {
    const MethodCost truth{DiagramMethod::per_site, {}, 0.4, 1.5, 60.0, 30.0};
    const MethodCost exact = sim::fitCost(truth.method, {}, samplesOf(truth, 0.0));
    EXPECT_NEAR(exact.base_ms, 0.4, 1e-6);
    EXPECT_NEAR(exact.pixel_ns, 1.5, 1e-6);
    EXPECT_NEAR(exact.site_ns, 60.0, 1e-4);
    EXPECT_NEAR(exact.covered_ns, 30.0, 1e-4);
    const MethodCost noisy = sim::fitCost(truth.method, {}, samplesOf(truth, 0.05));
    for (const sim::CalibrationSample& sample : samplesOf(truth, 0.0))
        EXPECT_NEAR(noisy.milliseconds(sample.load) / sample.milliseconds, 1.0, 0.08);
}

TEST(CostModel, LeavesNoTermNegative) {
    // A method that gets cheaper with more pixels cannot be: the fit has to make do without that term.
    std::vector<sim::CalibrationSample> samples;
    for (const double side : {512.0, 1024.0, 2048.0})
        for (const double sites : {100.0, 10000.0})
            samples.push_back({{sites, 4.0, side * side}, 5.0 - 1e-6 * side * side + 1e-4 * sites});
    const MethodCost cost = sim::fitCost(DiagramMethod::binned, {}, samples);
    EXPECT_GE(std::min({cost.base_ms, cost.pixel_ns, cost.site_ns, cost.covered_ns}), 0.0);
    EXPECT_GT(cost.milliseconds({10000, 4, 512 * 512}), cost.milliseconds({100, 4, 512 * 512}));
}

TEST(CostModel, TakesTheCheapestAndStaysWhereLittleIsToBeGained) {
    CostModel model;
    model.costs = {{DiagramMethod::per_site, {}, 0.1, 0.0, 100.0, 0.0},
                   {DiagramMethod::binned, {}, 1.0, 0.0, 10.0, 0.0}};
    const MethodCost& few = model.choose({100, 4, 1e6});
    EXPECT_EQ(few.method, DiagramMethod::per_site);
    EXPECT_EQ(model.choose({100000, 4, 1e6}).method, DiagramMethod::binned);
    // They break even at 10,000 sites: just above, per-site stays; far above, it goes.
    EXPECT_EQ(model.choose({10500, 4, 1e6}, &few).method, DiagramMethod::per_site);
    EXPECT_EQ(model.choose({20000, 4, 1e6}, &few).method, DiagramMethod::binned);
}

TEST(CostModel, BuildsWhatPeopleLookAtWhereThatIsLittle) {
    const CostModel model = CostModel::builtIn();
    const double look = 12.0;
    const sim::DiagramLoad few{4, 3, 1.4e6};
    EXPECT_EQ(model.plan(few, look).extent, sim::Extent::near_people);
    EXPECT_EQ(model.plan(few, look).cost->method, DiagramMethod::binned);
    EXPECT_EQ(model.plan({100000, 3, 1.4e6}, look).extent, sim::Extent::everywhere);
    // Walls change nothing about that.
    sim::DiagramLoad walls = few;
    walls.fixed_sites = 20000;
    EXPECT_EQ(model.plan(walls, look), model.plan(few, look));
    // And the better one has to promise a tenth.
    const sim::DiagramPlan far{model.plan(few, look)};
    EXPECT_EQ(model.plan(few, look, far), far);
}

class AdaptTest : public GpuTest {};

TEST_F(AdaptTest, ChangingTheMethodOnTheWayChangesNothingElse) {
    CostModel model;
    model.costs = {{DiagramMethod::per_site, {}, 0.0, 0.0, 100.0, 0.0},
                   {DiagramMethod::binned, {}, 1.0, 0.0, 1.0, 0.0}};
    const authoring::Scene scene = uniformScene(1234, 1.2f, 5);
    sim::Simulation changing(scene, library, model);
    EXPECT_EQ(changing.diagramMethod(), DiagramMethod::per_site);
    authoring::Scene fixed_scene = scene;
    fixed_scene.settings.method = DiagramMethod::gradient1;
    sim::Simulation fixed(fixed_scene, library);
    for (int step = 0; step < 12; ++step) {
        changing.adaptTo(step % 4 < 2 ? 100 : 1000000);
        EXPECT_EQ(changing.diagramMethod(), step % 4 < 2 ? DiagramMethod::per_site : DiagramMethod::binned);
        changing.step();
        fixed.adaptTo(step % 4 < 2 ? 100 : 1000000);
        EXPECT_EQ(fixed.diagramMethod(), DiagramMethod::gradient1) << "a written method is kept";
        fixed.step();
    }
    const auto bytes = [&](sim::Simulation& simulation) {
        const gl::Buffer frame("frame", simulation.frameBytes());
        simulation.packFrame(frame);
        return frame.download<float>(simulation.frameBytes() / sizeof(float));
    };
    EXPECT_EQ(bytes(changing), bytes(fixed));
}

}  // namespace
}  // namespace throng::test
