// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

#include "sim/diagram/bands.h"
#include "sim/diagram/fixed_squares.h"
#include "sim/simulation_parts.h"
#include "tests/sim/diagrams.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/layout_scene.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

using sim::BinGrid;
using sim::Diagram;
using sim::Extent;

/// Sites as a simulation keeps them: those that move in the order of bins, and where each bin starts.
struct SortedSites {
    SortedSites(std::vector<gpu::DiagramSite> sites, std::size_t moving, const BinGrid& the_grid)
        : grid(the_grid), stored(std::move(sites)) {
        const auto middle = stored.begin() + static_cast<std::ptrdiff_t>(moving);
        std::ranges::stable_sort(stored.begin(), middle, {},
                                 [&](const gpu::DiagramSite& site) { return binOf(site); });
        std::vector<std::uint32_t> slots(stored.size()), starts(grid.count() + 1);
        for (std::uint32_t slot = 0; slot < stored.size(); ++slot)
            slots[stored[slot].id] = slot;
        for (std::size_t slot = 0; slot < moving; ++slot)
            ++starts[binOf(stored[slot]) + 1];
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        site_buffer = gl::makeBuffer("sites", stored);
        dispatch = gl::makeBuffer("dispatch", sim::dispatchOf(moving));
        slot_buffer = gl::makeBuffer("slots", slots);
        start_buffer = gl::makeBuffer("starts", starts);
        strip_buffer =
            gl::makeBuffer("strips", std::vector<std::uint32_t>(grid.count() / gpu::CELLS_PER_STRIP + 1));
    }
    sim::DiagramInput input() const {
        return {&site_buffer, &dispatch, &slot_buffer,
                sim::DiagramInput::Sorted{&strip_buffer, &start_buffer, grid}};
    }
    std::uint32_t binOf(const gpu::DiagramSite& site) const {
        const glm::vec2 bin = glm::clamp(glm::floor(site.position / grid.side), glm::vec2(0.0f),
                                         glm::vec2(grid.width - 1, grid.height - 1));
        return static_cast<std::uint32_t>(bin.y) * grid.width + static_cast<std::uint32_t>(bin.x);
    }
    BinGrid grid;
    std::vector<gpu::DiagramSite> stored;
    gl::Buffer site_buffer, dispatch, slot_buffer, start_buffer, strip_buffer;
};

class DiagramBandsTest : public GpuTest {
  protected:
    static constexpr Window kWindow{131, 517};
    static constexpr float kSide = 14.7f, kLook = 23.0f;

    static sim::DiagramOptions options(const std::vector<gpu::DiagramSite>& sites, std::size_t walls,
                                       std::uint32_t bin_lines) {
        sim::DiagramOptions options = optionsFor(authoring::DiagramMethod::binned, kWindow, sites, walls);
        options.look = kLook;
        options.bands = {bin_lines, kSide};
        return options;
    }
    static BinGrid grid() { return {kWindow.width, kWindow.height, kSide}; }
};

TEST_F(DiagramBandsTest, TogetherAreTheWholeDiagram) {
    std::mt19937 random(31);
    for (const std::size_t count : {std::size_t{1}, std::size_t{63}, std::size_t{1234}})
        for (const std::uint32_t bin_lines : {1u, 3u, 10u, 1000u}) {
            const auto sites = randomSites(random, kWindow, count, 2.0f, 11.0f);
            const std::size_t walls = count / 4, moving = count - walls;
            const SortedSites sorted(sites, moving, grid());
            Diagram diagram(library, options(sites, walls, bin_lines), std::span(sites).subspan(moving));
            diagram.connect(sorted.input());
            const std::string what = fmt::format("{} sites, {} lines of bins a band", count, bin_lines);
            EXPECT_EQ(diagram.bands()->count(), (grid().height + bin_lines - 1) / bin_lines) << what;
            EXPECT_TRUE(diagram.build());
            const Reference expected = bruteForce(kWindow, sites);
            const std::size_t pixels = expected.owners.size();
            EXPECT_EQ(diagram.wholeOwners().download<std::uint32_t>(pixels), expected.owners) << what;
            EXPECT_EQ(diagram.measureDistances().download<float>(pixels), expected.squared) << what;
            std::vector<std::uint32_t> owned(moving);
            for (const std::uint32_t owner : expected.owners)
                if (owner < moving) ++owned[owner];
            EXPECT_EQ(diagram.countPixels().download<std::uint32_t>(moving), owned) << what;
        }
}

TEST_F(DiagramBandsTest, KeepWhatThoseWhoStandInThemLookAt) {
    std::mt19937 random(32);
    const auto sites = randomSites(random, kWindow, 400, 2.0f, 11.0f);
    constexpr std::size_t kWalls = 150, kMoving = 250;
    const SortedSites sorted(sites, kMoving, grid());
    for (const Extent extent : {Extent::everywhere, Extent::near_people}) {
        Diagram diagram(library, options(sites, kWalls, 4), std::span(sites).subspan(kMoving));
        diagram.connect(sorted.input());
        const std::vector<std::uint32_t> expected = bruteForce(kWindow, sites).owners;
        const std::size_t kept = diagram.owners().bytes() / gl::kWord;
        EXPECT_LT(kept, expected.size() / 2);
        std::size_t looked_at = 0, wrong = 0;
        for (int build = 0; build < 2; ++build) {  // nothing of the first may be seen in the second
            diagram.build(extent);
            for (std::uint32_t band = 0; band < diagram.bands()->count(); ++band) {
                diagram.buildBand(band, extent);
                const auto owners = diagram.owners().download<std::uint32_t>(kept);
                const glm::uvec2 lines = diagram.bands()->lines(band);
                ASSERT_LE((lines.y - lines.x) * kWindow.width, kept);
                for (std::size_t slot = 0; slot < kMoving; ++slot) {
                    const gpu::DiagramSite& site = sorted.stored[slot];
                    if (sorted.binOf(site) / grid().width / 4 != band) continue;
                    const glm::vec2 last(kWindow.width - 1, kWindow.height - 1);
                    const glm::uvec2 lower(glm::clamp(site.position - kLook, glm::vec2(0.0f), last));
                    const glm::uvec2 upper(glm::clamp(site.position + kLook, glm::vec2(0.0f), last));
                    ASSERT_GE(lower.y, lines.x);
                    ASSERT_LT(upper.y, lines.y);
                    for (std::uint32_t y = lower.y; y <= upper.y; ++y)
                        for (std::uint32_t x = lower.x; x <= upper.x; ++x) {
                            ++looked_at;
                            wrong += owners[(y - lines.x) * kWindow.width + x] !=
                                     expected[std::size_t{y} * kWindow.width + x];
                        }
                }
            }
        }
        EXPECT_EQ(wrong, 0u) << "of " << looked_at;
        EXPECT_GT(looked_at, 2u * kMoving);
    }
}

TEST_F(DiagramBandsTest, NeedSitesThatComeSortedAndOneMethod) {
    const std::vector<gpu::DiagramSite> sites = {{{20.0f, 20.0f}, 9.0f, 0}};
    const SortedSites sorted(sites, 1, grid());
    Diagram diagram(library, options(sites, 0, 2), {});
    sim::DiagramInput input = sorted.input();
    input.sorted.reset();
    EXPECT_THROW(diagram.connect(input), std::logic_error);
    EXPECT_THROW(diagram.use(authoring::DiagramMethod::per_site), std::logic_error);
}

class BandedCrowdTest : public GpuTest {
  protected:
    /// What a frame shows after some steps, half of which another simulation does, and how dense it is half
    /// way.
    std::vector<float> moved(const authoring::Scene& scene, int steps) {
        sim::Simulation first(scene, library);
        for (int step = 0; step < steps / 2; ++step)
            first.step();
        sim::Simulation second(scene, library);
        second.restore(first.save());
        for (int step = steps / 2; step < steps; ++step)
            second.step();
        std::vector<float> all = frameOf(second);
        const std::vector<float> counted = densityOf(first);
        all.insert(all.end(), counted.begin(), counted.end());
        return all;
    }

    static std::vector<float> frameOf(sim::Simulation& simulation) {
        const gl::Buffer frame("frame", simulation.frameBytes());
        simulation.packFrame(frame);
        return frame.download<float>(simulation.frameBytes() / sizeof(float));
    }

    static std::vector<float> densityOf(sim::Simulation& simulation) {
        const std::size_t rows = simulation.parameters().row_count;
        const gl::Buffer stream("stream", 3 * rows * sizeof(float));
        simulation.buildDiagramNow(Extent::near_people);
        simulation.packStream(Stream::density, stream);
        return stream.download<float>(3 * rows);
    }

    void expectTheSameInBands(authoring::Scene scene, double pixels_per_metre, int steps) {
        scene.settings.pixels_per_metre = pixels_per_metre;
        scene.settings.method = authoring::DiagramMethod::per_site;
        const std::vector<float> whole = moved(scene, steps);
        scene.settings.method = authoring::DiagramMethod::automatic;
        EXPECT_NE(sim::Simulation(scene, library).diagram().bands(), nullptr);
        EXPECT_EQ(moved(scene, steps), whole);
    }
};

TEST_F(BandedCrowdTest, WalksAsInOnePieceOnSeveralLevels) {
    expectTheSameInBands(sceneOfExample("station-levels"), 10.0, 24);
}

TEST_F(BandedCrowdTest, WalksAsInOnePieceWhileSomeComeAndOthersGo) {
    expectTheSameInBands(sceneOfExample("intersection"), 16.0, 48);
}

TEST_F(BandedCrowdTest, WalksAsInOnePieceBeforeGatesAndWallsThatHide) {
    authoring::Scene scene = uniformScene(1234, 1.1f, 41);
    addWall(scene, {5, 5}, {30, 22});
    addWall(scene, {5, 25}, {33, 12});
    for (std::uint32_t segment = 0; segment < scene.wall_segments.size(); ++segment)
        scene.wall_segments[segment].wall = segment;
    scene.open_at_start = {0};
    scene.gate_moves = {{0.1, 0, false}, {0.4, 1, true}, {0.6, 0, true}};
    scene.hiding_walls = {1};
    expectTheSameInBands(scene, 28.0, 24);
}

class FixedSitesTest : public GpuTest {};

TEST_F(FixedSitesTest, SquaresAreThoseThatTilesReach) {
    std::mt19937 random(33);
    const Window window{257, 130};
    for (const std::size_t count : {std::size_t{1}, std::size_t{63}, std::size_t{1234}}) {
        const auto sites = randomSites(random, window, count, 1.0f, 3.0f);
        const sim::FixedSquares squares(window.width, window.height, sites);
        ASSERT_EQ(squares.per_line, 17u);
        ASSERT_EQ(squares.places.size(), 17u * 9u);
        EXPECT_EQ(squares.squares.front(), gpu::NO_INDEX);
        for (std::uint32_t place = 1; place < squares.squares.size(); ++place)
            EXPECT_EQ(squares.places.at(squares.squares[place]), place);
        std::size_t missed = 0;
        const auto owners = bruteForce(window, sites).owners;
        for (std::size_t pixel = 0; pixel < owners.size(); ++pixel) {
            const std::size_t square = pixel / window.width / gpu::PAGE_SIDE * squares.per_line +
                                       pixel % window.width / gpu::PAGE_SIDE;
            missed += owners[pixel] != gpu::NO_INDEX && squares.places[square] == 0;
        }
        EXPECT_EQ(missed, 0u) << count;
        EXPECT_LE(squares.squares.size(), 1 + 4 * count) << "small tiles reach four squares at most";
    }
    EXPECT_EQ(sim::FixedSquares(64, 64, {}).squares.size(), 1u);
    const std::vector<gpu::DiagramSite> outside = {{{-1.0e9f, 30.0f}, 60.0f, 0}, {{30.0f, -200.0f}, 9.0f, 1}};
    EXPECT_EQ(sim::FixedSquares(64, 64, outside).squares.size(), 1u);
}

TEST_F(FixedSitesTest, LeaveNothingBehindWhereTheyChange) {
    std::mt19937 random(34);
    const Window window{200, 300};
    const auto sites = randomSites(random, window, 400, 2.0f, 11.0f);
    constexpr std::size_t kMoving = 250;
    const BinGrid grid(window.width, window.height, 13.0f);
    enum class Kept { whole, pages, bands };
    for (const Kept kept : {Kept::whole, Kept::pages, Kept::bands})
        for (const auto method : {authoring::DiagramMethod::binned, authoring::DiagramMethod::per_site}) {
            if (kept != Kept::whole && method != authoring::DiagramMethod::binned) continue;
            sim::DiagramOptions options = optionsFor(method, window, sites, 400 - kMoving);
            options.look = 20.0f;
            options.paged = kept == Kept::pages;
            if (kept == Kept::bands) options.bands = {3, grid.side};
            Diagram diagram(library, options, std::span(sites).subspan(kMoving));
            auto changed = sites;
            for (const bool opens : {true, false, true}) {
                for (std::size_t i = kMoving; i < sites.size(); i += 2)
                    changed[i].radius = opens ? 0.0f : sites[i].radius;
                const SortedSites sorted(changed, kMoving, grid);
                diagram.connect(sorted.input());
                diagram.changeFixedSites(std::span(changed).subspan(kMoving));
                diagram.build();
                const auto expected = bruteForce(window, changed).owners;
                EXPECT_EQ(diagram.wholeOwners().download<std::uint32_t>(expected.size()), expected)
                    << authoring::wordFor(method) << ", kept " << static_cast<int>(kept);
            }
        }
}

}  // namespace
}  // namespace throng::test
