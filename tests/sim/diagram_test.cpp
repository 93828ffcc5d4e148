// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "tests/sim/gpu_test.h"

namespace throng::test {
namespace {

using sim::Diagram;

struct Window {
    std::uint32_t width, height;
};

/// The definition, pixel by pixel, in the order of arithmetic that the shaders are held to.
struct Reference {
    std::vector<std::uint32_t> owners;
    std::vector<float> squared;
};

Reference bruteForce(Window window, const std::vector<gpu::DiagramSite>& sites) {
    Reference result;
    result.owners.assign(std::size_t{window.width} * window.height, gpu::NO_INDEX);
    result.squared.assign(result.owners.size(), INFINITY);
    for (const gpu::DiagramSite& site : sites) {
        const float limit = site.radius * site.radius;
        for (std::uint32_t y = 0; y < window.height; ++y) {
            const float dy = site.position.y - (static_cast<float>(y) + 0.5f);
            if (dy * dy > limit) continue;
            for (std::uint32_t x = 0; x < window.width; ++x) {
                const float dx = site.position.x - (static_cast<float>(x) + 0.5f);
                const float squared = dx * dx + dy * dy;
                if (squared > limit) continue;
                const std::size_t pixel = std::size_t{y} * window.width + x;
                const bool nearer = squared < result.squared[pixel];
                if (nearer || (squared == result.squared[pixel] && site.id < result.owners[pixel])) {
                    result.squared[pixel] = squared;
                    result.owners[pixel] = site.id;
                }
            }
        }
    }
    return result;
}

/// `walls` of the sites, the last ones, are given as fixed sites.
class DiagramTest : public GpuTest, public ::testing::WithParamInterface<Diagram::Method> {
  protected:
    void expectExact(Window window, const std::vector<gpu::DiagramSite>& sites, std::size_t walls,
                     const std::string& what) {
        const std::size_t moving = sites.size() - walls;
        float largest = 1.0f;
        for (const gpu::DiagramSite& site : sites)
            largest = std::max(largest, site.radius);
        Diagram diagram(library, GetParam(), window.width, window.height, largest,
                        std::span(sites).subspan(moving));
        // Sites stand in memory in another order than that of their ids, as they do in a simulation.
        std::vector<gpu::DiagramSite> stored(sites);
        std::reverse(stored.begin(), stored.begin() + static_cast<std::ptrdiff_t>(moving));
        std::vector<std::uint32_t> order(sites.size());
        for (std::uint32_t i = 0; i < sites.size(); ++i)
            order[i] = i < moving ? static_cast<std::uint32_t>(moving) - 1 - i : i;
        const auto live = static_cast<std::uint32_t>(moving);
        const gl::Buffer site_buffer = gl::makeBuffer("sites", stored);
        const gl::Buffer dispatch =
            gl::makeBuffer("dispatch", std::vector<std::uint32_t>{(live + 63) / 64, 1, 1, live});
        const gl::Buffer draw_order = gl::makeBuffer("order", order);
        diagram.connect({&site_buffer, &dispatch, &draw_order, static_cast<std::uint32_t>(order.size())});
        // Twice: nothing of the first build may leak into the second.
        diagram.buildWithDistances();
        diagram.buildWithDistances();

        const Reference expected = bruteForce(window, sites);
        const auto owners = diagram.owners().download<std::uint32_t>(expected.owners.size());
        const auto distances = diagram.distances().download<float>(expected.owners.size());
        std::size_t wrong_owner = 0;
        std::size_t wrong_distance = 0;
        for (std::size_t pixel = 0; pixel < owners.size(); ++pixel) {
            wrong_owner += owners[pixel] != expected.owners[pixel];
            if (expected.owners[pixel] != gpu::NO_INDEX)
                wrong_distance += distances[pixel] * diagram.distanceScale() != expected.squared[pixel];
        }
        EXPECT_EQ(wrong_owner, 0u) << what;
        EXPECT_EQ(wrong_distance, 0u) << what;
    }
};

std::vector<gpu::DiagramSite> randomSites(std::mt19937& random, Window window, std::size_t count, float least,
                                          float most) {
    std::uniform_real_distribution<float> x(-most, static_cast<float>(window.width) + most);
    std::uniform_real_distribution<float> y(-most, static_cast<float>(window.height) + most);
    std::uniform_real_distribution<float> radius(least, most);
    std::vector<gpu::DiagramSite> sites;
    for (std::uint32_t id = 0; id < count; ++id) {
        gpu::DiagramSite site{};
        site.position = {x(random), y(random)};
        // Every third site stands exactly on a pixel's centre, every fifth on a corner: ties.
        if (id % 3 == 0)
            site.position = {std::floor(site.position.x) + 0.5f, std::floor(site.position.y) + 0.5f};
        if (id % 5 == 0) site.position = {std::floor(site.position.x), std::floor(site.position.y)};
        // And every seventh exactly where an earlier one stands.
        if (id % 7 == 6) site.position = sites[id / 2].position;
        site.radius = id % 4 == 0 ? std::round(radius(random)) : radius(random);
        site.id = id;
        sites.push_back(site);
    }
    return sites;
}

TEST_P(DiagramTest, EqualsBruteForceOnAwkwardNumbersOfSites) {
    std::mt19937 random(1);
    for (const std::size_t count : {std::size_t{1}, std::size_t{63}, std::size_t{64}, std::size_t{1234}})
        for (const Window window : {Window{1, 1}, Window{63, 65}, Window{257, 130}})
            expectExact(window, randomSites(random, window, count, 1.0f, 12.0f), 0,
                        fmt::format("{} sites, {} x {}", count, window.width, window.height));
}

TEST_P(DiagramTest, EqualsBruteForceForRadiiFromOneToSixtyPixels) {
    std::mt19937 random(2);
    const Window window{300, 200};
    for (const float radius : {1.0f, 1.5f, 2.4f, 7.0f, 16.0f, 33.3f, 60.0f})
        expectExact(window, randomSites(random, window, 400, radius, radius), 0,
                    fmt::format("radius {}", radius));
    expectExact(window, randomSites(random, window, 1234, 1.0f, 60.0f), 0, "radii 1 to 60 mixed");
}

TEST_P(DiagramTest, GivesTiesToTheSmallestId) {
    std::vector<gpu::DiagramSite> sites(63);
    for (std::uint32_t id = 0; id < sites.size(); ++id)
        sites[id] = {{20.5f, 20.5f}, 9.0f, id};
    expectExact({41, 41}, sites, 0, "63 coincident sites");
    // Two sites at equal distance from a whole column of pixel centres.
    expectExact({41, 41}, {{{10.5f, 20.5f}, 12.0f, 0}, {{20.5f, 20.5f}, 12.0f, 1}}, 0, "a column of ties");
}

TEST_P(DiagramTest, SeesTilesOfSitesOutsideTheWindow) {
    const std::vector<gpu::DiagramSite> sites = {
        {{-5.0f, 30.0f}, 8.0f, 0},   {{66.0f, 30.0f}, 8.0f, 1},     {{30.0f, -59.0f}, 60.0f, 2},
        {{30.0f, 123.0f}, 60.0f, 3}, {{-1.0e6f, 1.0e6f}, 20.0f, 4}, {{1.0e9f, -1.0e9f}, 60.0f, 5},
    };
    expectExact({64, 64}, sites, 0, "outside on every side");
}

TEST_P(DiagramTest, LetsFixedSitesTakePartLikeOthers) {
    std::mt19937 random(3);
    const Window window{200, 200};
    for (const std::size_t walls : {std::size_t{1}, std::size_t{63}, std::size_t{900}})
        expectExact(window, randomSites(random, window, 1234, 2.0f, 14.0f), walls,
                    fmt::format("{} fixed sites", walls));
    expectExact(window, randomSites(random, window, 63, 2.0f, 14.0f), 63, "nothing but fixed sites");
}

TEST_P(DiagramTest, LeavesPixelsWithoutAnyTileEmpty) {
    expectExact({64, 64}, {{{32.5f, 32.5f}, 1.0f, 0}}, 0, "one small tile");
    expectExact({64, 64}, {{{200.0f, 200.0f}, 10.0f, 0}}, 0, "a tile that does not reach the window");
}

INSTANTIATE_TEST_SUITE_P(Methods, DiagramTest,
                         ::testing::Values(Diagram::Method::per_site, Diagram::Method::gradient1),
                         [](const auto& test) {
                             return test.param == Diagram::Method::per_site ? "PerSite" : "Gradient1";
                         });

}  // namespace
}  // namespace throng::test
