// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/diagram.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <random>

#include "tests/sim/diagrams.h"
#include "tests/sim/gpu_test.h"

namespace throng::test {
namespace {

using sim::Diagram;
using sim::DiagramMethod;

/// Sites as a simulation keeps them: in another order than that of their ids, fixed ones last.
struct DiagramInputs {
    DiagramInputs(const std::vector<gpu::DiagramSite>& sites, std::size_t moving) {
        std::vector<gpu::DiagramSite> stored(sites);
        std::reverse(stored.begin(), stored.begin() + static_cast<std::ptrdiff_t>(moving));
        std::vector<std::uint32_t> slots(sites.size());
        for (std::uint32_t i = 0; i < sites.size(); ++i)
            slots[i] = i < moving ? static_cast<std::uint32_t>(moving) - 1 - i : i;
        site_buffer = gl::makeBuffer("sites", stored);
        dispatch = gl::makeBuffer("dispatch", sim::dispatchOf(moving));
        slot_buffer = gl::makeBuffer("slots", slots);
    }
    sim::DiagramInput input() const { return {&site_buffer, &dispatch, &slot_buffer}; }
    gl::Buffer site_buffer, dispatch, slot_buffer;
};

struct Outcome {
    std::size_t wrong_owners = 0;
    std::size_t beyond_reach = 0;  // owners whose tile does not reach the pixel
    std::size_t missed = 0;        // no owner where some tile reaches
    std::size_t wrong_distances = 0;
    std::size_t pixels = 0;
    double wrongShare() const { return static_cast<double>(wrong_owners) / static_cast<double>(pixels); }
};

/// Builds the diagram of `sites`, the last `walls` of which are given as fixed, and compares.
Outcome compare(const gl::ShaderLibrary& library, const sim::DiagramOptions& options,
                const std::vector<gpu::DiagramSite>& sites) {
    const std::size_t moving = options.live_capacity;
    Diagram diagram(library, options, std::span(sites).subspan(moving));
    const DiagramInputs inputs(sites, moving);
    diagram.connect(inputs.input());
    // Twice: nothing of the first build may leak into the second.
    diagram.build();
    diagram.build();

    const Window window{options.width, options.height};
    const Reference expected = bruteForce(window, sites);
    const auto owners = diagram.wholeOwners().download<std::uint32_t>(expected.owners.size());
    const auto distances = diagram.measureDistances().download<float>(expected.owners.size());
    Outcome outcome;
    outcome.pixels = owners.size();
    for (std::size_t pixel = 0; pixel < owners.size(); ++pixel) {
        outcome.wrong_owners += owners[pixel] != expected.owners[pixel];
        const bool owned = owners[pixel] != gpu::NO_INDEX;
        outcome.missed += !owned && expected.owners[pixel] != gpu::NO_INDEX;
        if (owned) {
            const gpu::DiagramSite& site = sites.at(owners[pixel]);
            const glm::vec2 centre(static_cast<float>(pixel % window.width) + 0.5f,
                                   static_cast<float>(pixel / window.width) + 0.5f);
            const glm::vec2 offset = site.position - centre;
            const float squared = offset.x * offset.x + offset.y * offset.y;
            outcome.beyond_reach += squared > site.radius * site.radius;
            outcome.wrong_distances += distances[pixel] != squared;
        }
    }
    return outcome;
}

class DiagramTest : public GpuTest, public ::testing::WithParamInterface<DiagramMethod> {
  protected:
    void expectExact(Window window, const std::vector<gpu::DiagramSite>& sites, std::size_t walls,
                     const std::string& what) {
        sim::DiagramOptions options = optionsFor(GetParam(), window, sites, walls);
        for (const bool paged : {false, true}) {
            if (paged && GetParam() != DiagramMethod::binned) continue;
            options.paged = paged;
            const Outcome outcome = compare(library, options, sites);
            EXPECT_EQ(outcome.wrong_owners, 0u) << what << (paged ? ", paged" : "");
            EXPECT_EQ(outcome.wrong_distances, 0u) << what << (paged ? ", paged" : "");
        }
    }
};

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

std::string testName(const ::testing::TestParamInfo<DiagramMethod>& test) {
    std::string name(authoring::wordFor(test.param));
    for (char& letter : name)
        letter = letter == '-' ? '_' : letter == '+' ? 'p' : letter;
    return name;
}

INSTANTIATE_TEST_SUITE_P(Exact, DiagramTest,
                         ::testing::Values(DiagramMethod::gradient1, DiagramMethod::gradient2,
                                           DiagramMethod::per_pixel, DiagramMethod::per_site,
                                           DiagramMethod::binned),
                         testName);

/// The second-nearest site of every pixel, by definition.
std::vector<std::uint32_t> secondByBruteForce(Window window, const std::vector<gpu::DiagramSite>& sites) {
    std::vector<std::uint32_t> seconds(std::size_t{window.width} * window.height, gpu::NO_INDEX);
    for (std::size_t pixel = 0; pixel < seconds.size(); ++pixel) {
        const float x = static_cast<float>(pixel % window.width) + 0.5f;
        const float y = static_cast<float>(pixel / window.width) + 0.5f;
        std::vector<std::pair<float, std::uint32_t>> reaching;
        for (const gpu::DiagramSite& site : sites) {
            const float dx = site.position.x - x;
            const float dy = site.position.y - y;
            const float squared = dx * dx + dy * dy;
            if (squared <= site.radius * site.radius) reaching.emplace_back(squared, site.id);
        }
        std::sort(reaching.begin(), reaching.end());
        if (reaching.size() > 1) seconds[pixel] = reaching[1].second;
    }
    return seconds;
}

class DiagramExtrasTest : public GpuTest {};

TEST_F(DiagramExtrasTest, SecondNearestOwnersEqualBruteForce) {
    std::mt19937 random(8);
    const Window window{131, 90};
    for (const bool paged : {false, true})
        for (const std::size_t count : {std::size_t{1}, std::size_t{63}, std::size_t{1234}}) {
            const auto sites = randomSites(random, window, count, 2.0f, 11.0f);
            sim::DiagramOptions options = optionsFor(DiagramMethod::binned, window, sites, count / 5);
            options.paged = paged;
            Diagram diagram(library, options, std::span(sites).subspan(options.live_capacity));
            const DiagramInputs inputs(sites, options.live_capacity);
            diagram.connect(inputs.input());
            diagram.build();
            const auto expected = secondByBruteForce(window, sites);
            EXPECT_EQ(diagram.findSeconds().download<std::uint32_t>(expected.size()), expected)
                << count << " sites";
        }
}

TEST_F(DiagramExtrasTest, CountsThePixelsOfEveryMovingSite) {
    std::mt19937 random(9);
    const Window window{200, 131};
    for (const bool paged : {false, true})
        for (const std::size_t count : {std::size_t{1}, std::size_t{63}, std::size_t{1234}}) {
            const auto sites = randomSites(random, window, count, 2.0f, 11.0f);
            sim::DiagramOptions options = optionsFor(DiagramMethod::binned, window, sites, count / 3);
            options.paged = paged;
            Diagram diagram(library, options, std::span(sites).subspan(options.live_capacity));
            const DiagramInputs inputs(sites, options.live_capacity);
            diagram.connect(inputs.input());
            diagram.build();
            std::vector<std::uint32_t> expected(options.live_capacity, 0);
            for (const std::uint32_t owner : bruteForce(window, sites).owners)
                if (owner < expected.size()) ++expected[owner];
            EXPECT_EQ(diagram.countPixels().download<std::uint32_t>(expected.size()), expected)
                << count << " sites";
        }
}

TEST_F(DiagramExtrasTest, GoesOnWithAnotherMethodInTheSamePlace) {
    std::mt19937 random(10);
    const Window window{97, 140};
    const auto sites = randomSites(random, window, 400, 2.0f, 11.0f);
    Diagram diagram(library, optionsFor(DiagramMethod::per_site, window, sites, 100),
                    std::span(sites).subspan(300));
    const DiagramInputs inputs(sites, 300);
    diagram.connect(inputs.input());
    const auto expected = bruteForce(window, sites).owners;
    for (const DiagramMethod method :
         {DiagramMethod::per_site, DiagramMethod::binned, DiagramMethod::gradient1, DiagramMethod::per_site,
          DiagramMethod::binned}) {
        diagram.use(method);
        diagram.build();
        EXPECT_EQ(diagram.owners().download<std::uint32_t>(expected.size()), expected)
            << authoring::wordFor(method);
    }
}

TEST_F(DiagramExtrasTest, PagesFollowTheSitesAndLeaveNothingBehind) {
    // The same diagram object, with sites that wander from page to page over a window far larger than they
    // cover.
    std::mt19937 random(12);
    const Window window{1000, 700};
    auto sites = randomSites(random, window, 63, 5.0f, 5.0f);
    sim::DiagramOptions options = optionsFor(DiagramMethod::binned, window, sites, 10);
    options.paged = true;
    Diagram diagram(library, options, std::span(sites).subspan(53));
    const DiagramInputs inputs(sites, 53);
    diagram.connect(inputs.input());
    for (int step = 0; step < 6; ++step) {
        for (std::size_t i = 0; i < 53; ++i)
            sites[i].position += glm::vec2(37.3f, -21.7f);
        std::vector<gpu::DiagramSite> stored(sites);
        std::reverse(stored.begin(), stored.begin() + 53);
        const_cast<gl::Buffer&>(inputs.site_buffer).upload(stored);
        diagram.build();
        const auto expected = bruteForce(window, sites).owners;
        EXPECT_EQ(diagram.wholeOwners().download<std::uint32_t>(expected.size()), expected) << step;
    }
}

/// Whether some moving site may look at a pixel: it is within the square around it.
bool isLookedAt(std::size_t pixel, const sim::DiagramOptions& options,
                const std::vector<gpu::DiagramSite>& sites) {
    const glm::vec2 centre(static_cast<float>(pixel % options.width) + 0.5f,
                           static_cast<float>(pixel / options.width) + 0.5f);
    for (std::size_t i = 0; i < options.live_capacity; ++i) {
        const glm::vec2 away = glm::abs(sites[i].position - centre);
        if (std::max(away.x, away.y) <= options.look) return true;
    }
    return false;
}

TEST_F(DiagramExtrasTest, WhatPeopleLookAtIsRightWhereverElseNothingIsBuilt) {
    for (const bool paged : {false, true}) {
        std::mt19937 random(14);
        const Window window{1003, 700};
        constexpr std::size_t kMoving = 9;
        auto sites = randomSites(random, window, 400, 5.0f, 9.0f);
        sim::DiagramOptions options = optionsFor(DiagramMethod::binned, window, sites, 400 - kMoving);
        options.look = 31.0f;
        options.paged = paged;
        Diagram diagram(library, options, std::span(sites).subspan(kMoving));
        const DiagramInputs inputs(sites, kMoving);
        diagram.connect(inputs.input());
        for (int step = 0; step < 9; ++step) {
            for (std::size_t i = 0; i < kMoving; ++i)
                sites[i].position += glm::vec2(27.3f, -11.7f);
            std::vector<gpu::DiagramSite> stored(sites);
            std::reverse(stored.begin(), stored.begin() + kMoving);
            const_cast<gl::Buffer&>(inputs.site_buffer).upload(stored);
            // Pictures in between leave nothing behind either.
            const bool picture = step % 4 == 3;
            EXPECT_TRUE(diagram.build(picture ? sim::Extent::everywhere : sim::Extent::near_people));
            const auto expected = bruteForce(window, sites).owners;
            const auto owners = diagram.wholeOwners().download<std::uint32_t>(expected.size());
            std::size_t looked_at = 0, wrong = 0, elsewhere = 0;
            for (std::size_t pixel = 0; pixel < owners.size(); ++pixel) {
                if (picture || isLookedAt(pixel, options, sites)) {
                    ++looked_at;
                    wrong += owners[pixel] != expected[pixel];
                } else {
                    elsewhere += owners[pixel] != expected[pixel];
                }
            }
            EXPECT_EQ(wrong, 0u) << (paged ? "paged, step " : "step ") << step << ", of " << looked_at;
            EXPECT_TRUE(picture || step > 0 || elsewhere > 0u) << "everything was built";
        }
    }
}

TEST_F(DiagramExtrasTest, ComparingEverythingCanBeStoppedOnTheWay) {
    std::mt19937 random(15);
    const Window window{512, 512};
    const auto sites = randomSites(random, window, 1800, 2.0f, 11.0f);
    Diagram diagram(library, optionsFor(DiagramMethod::per_pixel, window, sites, 0), {});
    const DiagramInputs inputs(sites, sites.size());
    diagram.connect(inputs.input());
    ASSERT_TRUE(diagram.buildsInPieces());
    diagram.stopWhen([] { return true; });
    EXPECT_FALSE(diagram.build());
    const auto expected = bruteForce(window, sites).owners;
    EXPECT_NE(diagram.owners().download<std::uint32_t>(expected.size()), expected);
    int asked = 0;
    diagram.stopWhen([&] { return ++asked < 0; });
    EXPECT_TRUE(diagram.build());
    EXPECT_GT(asked, 0);
    EXPECT_EQ(diagram.owners().download<std::uint32_t>(expected.size()), expected);
}

/// Methods with errors: how large a share of wrong pixels each is allowed, a little above what was measured
/// on these very sites, and why it has any.
struct ErrorBound {
    DiagramMethod method;
    double open_crowd;  // 400 sites of 8 px in 512 x 512: 0.3 tiles over each pixel
    double dense;       // 16,384 sites of 6 px: many share a pixel or stand next to each other
    double mixed;       // radii from 2 to 14 px
};

class InexactDiagramTest : public GpuTest, public ::testing::WithParamInterface<ErrorBound> {
  protected:
    void expectBound(std::size_t count, float least, float most, double bound, const char* what) {
        std::mt19937 random(4);
        const Window window{512, 512};
        std::uniform_real_distribution<float> place(0.0f, 512.0f);
        std::uniform_real_distribution<float> radius(least, most);
        std::vector<gpu::DiagramSite> sites;
        for (std::uint32_t id = 0; id < count; ++id)
            sites.push_back({{place(random), place(random)}, radius(random), id});
        const Outcome outcome =
            compare(library, optionsFor(GetParam().method, window, sites, count / 4), sites);
        std::printf("    %s: %.4f %% wrong\n", what, 100.0 * outcome.wrongShare());
        EXPECT_LE(outcome.wrongShare(), bound) << what;
        EXPECT_EQ(outcome.beyond_reach, 0u) << what;
        EXPECT_EQ(outcome.wrong_distances, 0u) << what;
        // Only jump flooding may not hear of any site.
        if (!floods_) {
            EXPECT_EQ(outcome.missed, 0u) << what;
        }
    }
    bool floods_ = authoring::wordFor(GetParam().method).find("jfa") != std::string_view::npos;
};

TEST_P(InexactDiagramTest, StaysWithinItsErrorAndTruncatesExactly) {
    expectBound(400, 8.0f, 8.0f, GetParam().open_crowd, "open");
    expectBound(16384, 6.0f, 6.0f, GetParam().dense, "dense");
    expectBound(1234, 2.0f, 14.0f, GetParam().mixed, "mixed");
}

INSTANTIATE_TEST_SUITE_P(WithErrors, InexactDiagramTest,
                         ::testing::Values(ErrorBound{DiagramMethod::cones, 0.0004, 0.008, 0.002},
                                           ErrorBound{DiagramMethod::gradient2_packed, 1.0e-5, 6.0e-5,
                                                      1.0e-5},
                                           ErrorBound{DiagramMethod::jfa, 5.0e-5, 0.021, 0.0025},
                                           ErrorBound{DiagramMethod::jfa_one_before, 2.0e-5, 0.019, 0.002},
                                           ErrorBound{DiagramMethod::jfa_one_after, 2.0e-5, 0.019, 0.002},
                                           ErrorBound{DiagramMethod::jfa_from_radius, 5.0e-5, 0.021, 0.0025}),
                         [](const auto& test) {
                             return testName({test.param.method, test.index});
                         });

}  // namespace
}  // namespace throng::test
