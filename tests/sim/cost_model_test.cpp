// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/cost_model.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "sim/benchmarks/calibration.h"
#include "sim/diagram/looked_at.h"
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

TEST(CostModel, KnowsCrowdsThatStandTogetherFromThoseWhoStandApart) {
    const CostModel model = CostModel::builtIn();
    const double look = 17.0;
    sim::DiagramLoad load{16384, 3, 28.0e6};
    EXPECT_FALSE(sim::isWorthListing(load, look));
    EXPECT_EQ(model.plan(load, look).extent, sim::Extent::everywhere);
    load.looked_at = 7.0e5;
    EXPECT_DOUBLE_EQ(load.nearPeople(look).pixels, 7.0e5);
    EXPECT_TRUE(sim::isWorthListing(load, look));
    EXPECT_EQ(model.plan(load, look).extent, sim::Extent::near_people);
    load.looked_at = 20.0e6;
    EXPECT_FALSE(sim::isWorthListing(load, look));
    // People have gone since they were counted.
    load.sites = 4;
    EXPECT_LT(load.nearPeople(look).pixels, 1.0e5);
}

TEST(LookedAtCount, IsThatOfPagesWithinReachOfSomebody) {
    gpu::Parameters parameters{};
    parameters.diagram_minimum = {-20.0f, 5.0f};
    parameters.pixels_per_metre = 3.0f;
    parameters.diagram_width = 257;
    parameters.diagram_height = 130;
    constexpr double kLook = 21.0;
    sim::LookedAtCount count(parameters, kLook);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> x(-30.0f, 80.0f), y(0.0f, 60.0f);
    for (const int people : {0, 1, 63, 1234}) {  // the same counter: nothing is left of the last time
        count.begin();
        std::set<std::pair<int, int>> pages;
        for (int i = 0; i < people; ++i) {
            const glm::vec2 place{x(random), y(random)};
            count.add(place);
            const glm::vec2 pixel = (place - parameters.diagram_minimum) * 3.0f;
            const auto seen = [](float at, double reach, int size) {
                return static_cast<int>(std::clamp(double{at} + reach, 0.0, size - 1.0)) / 16;
            };
            for (int up = seen(pixel.y, -kLook - 1, 130); up <= seen(pixel.y, kLook + 1, 130); ++up)
                for (int at = seen(pixel.x, -kLook - 1, 257); at <= seen(pixel.x, kLook + 1, 257); ++at)
                    pages.insert({at, up});
        }
        EXPECT_DOUBLE_EQ(count.pixels(), 256.0 * static_cast<double>(pages.size())) << people;
    }
}

class AdaptTest : public GpuTest {};

TEST_F(AdaptTest, ACrowdInACornerLooksAtThatCornerOnly) {
    authoring::Scene scene = uniformScene(1234, 1.2f, 5);
    scene.maximum = {150, 150};
    sim::Simulation corner(scene, library);
    EXPECT_EQ(corner.parts().extent, sim::Extent::near_people);
    for (std::size_t i = 0; i < scene.people.size(); ++i)
        scene.people[i].spawn_position = {4.2f * static_cast<float>(i % 35),
                                          4.2f * static_cast<float>(i / 35)};
    sim::Simulation everywhere(scene, library);
    EXPECT_EQ(everywhere.parts().extent, sim::Extent::everywhere);
    everywhere.adaptTo(1234, 1.0e4);
    EXPECT_EQ(everywhere.parts().extent, sim::Extent::near_people);
    scene.settings.proximity = authoring::Proximity::grid;
    EXPECT_FALSE(sim::Simulation(scene, library).lookedAtCount());
}

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
