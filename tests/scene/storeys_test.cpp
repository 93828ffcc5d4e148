// SPDX-License-Identifier: Apache-2.0
// Levels and links as charts in the plane: who owns which ground, where it ends, and that routes go on over
// seams.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>
#include <numbers>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/chart_map.h"
#include "authoring/scene/raster.h"
#include "authoring/scene/scene_builder.h"
#include "authoring/storeys/chart_mesh.h"
#include "authoring/storeys/charts.h"
#include "authoring/storeys/railings.h"

namespace throng::authoring {
namespace {

using Points = std::vector<glm::dvec2>;

Points box(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Level level(const std::string& id, double height, Points floor) {
    return {id, height, std::move(floor), {}};
}

Link stairs(std::size_t from, std::size_t to, glm::dvec2 begin, glm::dvec2 end, double width = 2.0) {
    return {"stairs", Link::Kind::stairs, from, to, begin, end, width, {}};
}

/// A hall with a gallery over half of it, and stairs within the hall.
Layout hallWithGallery() {
    Layout layout;
    layout.levels = {level("hall", 0.0, box(-10, -5, 10, 5)), level("gallery", 3.0, box(2, -5, 10, 5))};
    layout.links = {stairs(0, 1, {-4, 1}, {2, 1})};
    return layout;
}

std::shared_ptr<const Charts> chartsIn(const Layout& layout) {
    Diagnostics diagnostics;
    auto charts = layOut(layout, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        ADD_FAILURE() << entry.message;
    return charts;
}

double railingLength(const std::vector<Chart>& charts, std::size_t index) {
    double length = 0.0;
    for (const Railing& railing : railingsOf(charts, index))
        length += glm::distance(railing.points[0], railing.points[1]);
    return length;
}

double areaOf(const TerrainMesh& mesh, double height) {
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                         c = mesh.positions[mesh.indices[i + 2]];
        const glm::dvec3 twice = glm::cross(b - a, c - a);
        if (twice.z > 0.0 && std::abs(a.z - height) + std::abs(b.z - height) + std::abs(c.z - height) < 1e-9)
            area += 0.5 * twice.z;
    }
    return area;
}

TEST(Charts, RailingsStandWhereGroundEndsAndNoOtherBegins) {
    const auto charts = chartsIn(hallWithGallery());
    // The stairs are open at both ends; the hall is closed all round, and round the stairs where these are
    // too low.
    const double low = kHeadroom / 3.0 * 6.0, width = 2.0 + kRailing;
    EXPECT_NEAR(railingLength(charts->charts, 2), 2 * 6.0, 0.02);
    EXPECT_NEAR(railingLength(charts->charts, 0), 60.0 + 2 * low + width, 0.02);
    // The gallery's edge is open where the stairs end.
    EXPECT_NEAR(railingLength(charts->charts, 1), 36.0 - width, 0.02);
}

TEST(Charts, FloorsThatMeetAtTheSameHeightHaveNoRailingBetweenThem) {
    Layout layout;
    layout.levels = {level("a", 0.0, box(0, 0, 5, 4)), level("b", 0.1, box(5, 1, 9, 4)),
                     level("c", 1.0, box(-3, 0, 0, 4))};
    const auto charts = chartsIn(layout);
    EXPECT_NEAR(railingLength(charts->charts, 0), 18.0 - 3.0, 0.02);
    EXPECT_NEAR(railingLength(charts->charts, 1), 14.0 - 3.0, 0.02);
    EXPECT_NEAR(railingLength(charts->charts, 2), 14.0, 0.02);
}

/// What a chart shows beyond its seams is what is there, seen from the chart that owns it.
TEST(ChartRaster, ShowsBeyondSeamsWhatOthersOwn) {
    const auto charts = chartsIn(hallWithGallery());
    std::size_t shown = 0;
    for (std::size_t chart = 0; chart < charts->rasters.size(); ++chart) {
        const ChartRaster& raster = charts->rasters[chart];
        for (int y = 0; y < raster.size().y; ++y)
            for (int x = 0; x < raster.size().x; ++x) {
                const glm::ivec2 cell = raster.first() + glm::ivec2(x, y);
                const std::uint32_t owner = raster.ownerAt(cell);
                if (owner == gpu::NO_CHART) continue;
                EXPECT_EQ(charts->rasters[owner].ownerAt(cell), owner);
                shown += owner != chart ? 1 : 0;
            }
    }
    EXPECT_GT(shown, 300u);
    // The gallery and the hall below it know nothing of each other.
    EXPECT_FALSE(charts->rasters[0].isJoinedTo(1));
    EXPECT_EQ(charts->rasters[0].ownerOf({6.0, 0.0}), 0u);
    EXPECT_EQ(charts->rasters[1].ownerOf({6.0, 0.0}), 1u);
    // Up the stairs from the hall, down them from the gallery.
    EXPECT_EQ(charts->rasters[0].ownerOf({-3.6, 1.0}), 2u);
    EXPECT_EQ(charts->rasters[1].ownerOf({1.6, 1.0}), 2u);
    EXPECT_EQ(charts->rasters[2].ownerOf({-4.4, 1.0}), 0u);
    EXPECT_EQ(charts->rasters[2].ownerOf({2.4, 1.0}), 1u);
}

/// In the hall the stairs' opening ends in a railing, under the stairs: nobody on these is in its way.
TEST(Charts, NoWallOfOneStoreyStandsInTheWayOnAnother) {
    const auto charts = chartsIn(hallWithGallery());
    const Footprint& link = charts->charts[2].link;
    std::size_t beside = 0;
    for (std::size_t i = charts->walls.size(); i < charts->plane.walls.size(); ++i)
        for (const glm::dvec2 point : charts->plane.walls[i].points) {
            const glm::dvec2 home = point - charts->charts[2].shift;
            const double along = link.alongOf(home), aside = std::abs(link.asideOf(home));
            if (along < -charts->reach || along > link.length + charts->reach || aside > charts->reach)
                continue;
            EXPECT_FALSE(along > 0.2 && along < link.length - 0.2 && aside < link.half_width - 0.01)
                << charts->plane.walls[i].id << " " << along << " " << aside;
            ++beside;
        }
    EXPECT_GT(beside, 4u);
}

TEST(ChartRaster, CastsImagesOfThoseWhoAreNearASeamOnly) {
    const auto charts = chartsIn(hallWithGallery());
    const auto images = [&](std::size_t chart, glm::dvec2 at) {
        return charts->rasters[chart].imagesAt(chartCellOf(at));
    };
    EXPECT_EQ(images(0, {-4.5, 1.0}) & gpu::NO_CHART, 2u);
    EXPECT_EQ(images(0, {8.0, -4.0}), gpu::NO_IMAGES);
    EXPECT_EQ(images(1, {2.5, 1.0}) & gpu::NO_CHART, 2u);
    // In the middle of six metres of stairs, both ends are near.
    const std::uint32_t middle = images(2, {-1.0, 1.0});
    EXPECT_EQ((middle & gpu::NO_CHART) + (middle >> 8 & gpu::NO_CHART), 0u + 1u);
    EXPECT_EQ(charts->most_images, 2u);
}

/// Who stands over the foot of stairs is in nobody's way on these, nor who walks under their head.
TEST(ChartRaster, CastsNoImagesWhereTheOtherHasGroundOfItsOwn) {
    Layout layout = hallWithGallery();
    layout.levels[1].floor = box(-10, -5, 10, 5);  // over all of the hall, but for the stairs' opening
    const auto charts = chartsIn(layout);
    const auto isOn = [&](std::uint32_t there, std::size_t chart, glm::dvec2 at) {
        const std::uint32_t images = charts->rasters[chart].imagesAt(chartCellOf(at));
        for (std::uint32_t place = 0; place < gpu::MOST_IMAGES; ++place)
            if ((images >> (8 * place) & gpu::NO_CHART) == there) return true;
        return false;
    };
    constexpr std::uint32_t kHall = 0, kGallery = 1, kStairs = 2;
    // The stairs are 2.2 m below the gallery at x = -2.4, and as much over the hall at x = 0.4.
    EXPECT_EQ(charts->rasters[kGallery].ownerOf({-2.9, 1.0}), kGallery);
    EXPECT_FALSE(isOn(kStairs, kGallery, {-2.9, 1.0}));
    EXPECT_FALSE(isOn(kStairs, kGallery, {-4.5, 1.0}));  // over the hall that the stairs show
    EXPECT_FALSE(isOn(kGallery, kStairs, {-2.9, 1.0}));
    EXPECT_TRUE(isOn(kGallery, kStairs, {-2.1, 1.0}));  // seen through the opening
    EXPECT_EQ(charts->rasters[kHall].ownerOf({0.9, 1.0}), kHall);
    EXPECT_FALSE(isOn(kHall, kStairs, {0.9, 1.0}));
    EXPECT_FALSE(isOn(kStairs, kHall, {0.9, 1.0}));
    EXPECT_TRUE(isOn(kHall, kStairs, {0.1, 1.0}));
    // Beyond their ends all are seen, and beside them who is close to these.
    EXPECT_TRUE(isOn(kStairs, kGallery, {4.0, 1.0}) && isOn(kStairs, kGallery, {2.4, 3.0}));
    EXPECT_TRUE(isOn(kStairs, kGallery, {1.6, 2.6}) && isOn(kStairs, kHall, {-3.6, 2.6}));
    EXPECT_FALSE(isOn(kStairs, kGallery, {0.9, 2.6}) || isOn(kStairs, kHall, {-2.9, 2.6}));
}

TEST(Charts, LieApartByMoreThanPeopleSense) {
    Layout layout = hallWithGallery();
    for (int i = 0; i < 20; ++i)
        layout.levels.push_back(level("storey " + std::to_string(i), 6.0 + 3.0 * i, box(-20, -3, 20, 5 + i)));
    const auto charts = chartsIn(layout);
    for (std::size_t i = 0; i < charts->charts.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const auto [lower_i, upper_i] = charts->charts[i].bounds();
            const auto [lower_j, upper_j] = charts->charts[j].bounds();
            const glm::dvec2 a = charts->charts[i].shift, b = charts->charts[j].shift;
            const glm::dvec2 gap = glm::max(lower_i + a - upper_j - b, lower_j + b - upper_i - a);
            EXPECT_GE(std::max(gap.x, gap.y), 2.0 * charts->reach) << i << " " << j;
        }
    EXPECT_EQ(std::fmod(charts->charts.back().shift.x, double{gpu::SHIFT_STEP}), 0.0);
}

TEST(ChartMesh, FloorsHaveTheOpeningsOfLinksAndStairsTheirTreads) {
    const Layout layout = hallWithGallery();
    const auto charts = chartsIn(layout);
    const double low = kHeadroom / 3.0 * 6.0, width = 2.0 + kRailing;
    EXPECT_NEAR(areaOf(charts->home_mesh, 0.0), 200.0 - low * width, 1e-6);
    EXPECT_EQ(treadsOf(charts->charts[2], layout), 18u);
    // The last tread is level with the gallery.
    EXPECT_NEAR(areaOf(charts->home_mesh, 3.0), 80.0 + 6.0 / 18.0 * width, 1e-6);
    for (int tread = 1; tread < 18; ++tread)
        EXPECT_NEAR(areaOf(charts->home_mesh, 3.0 * tread / 18.0), 6.0 / 18.0 * width, 1e-6) << tread;
}

/// A plain with a wall across it, in pieces or whole, and somebody who walks to a place in its last piece.
Scene plainOf(std::vector<Level> pieces) {
    Layout layout;
    const std::size_t last = pieces.size() - 1;
    layout.levels = std::move(pieces);
    layout.areas = {{"goal", box(7, 3, 9, 5), {}, last}};
    layout.walls = {{"wall", {{2, 2}, {2, 6}}, false, 0.2, 3.0, {}}};
    layout.walls.front().level = last;
    Formation walker;
    walker.id = "walker";
    GridFormation grid;
    grid.origin = {-8, 0};
    Destination destination;
    destination.places = {{Place::Kind::area, 0, {}}};
    grid.goal = destination;
    walker.shape = grid;
    layout.formations = {walker};
    Diagnostics diagnostics;
    std::optional<Scene> scene = buildScene(layout, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        ADD_FAILURE() << entry.message;
    return std::move(*scene);
}

TEST(Fields, GoOnOverSeamsAsIfThereWereNone) {
    const Scene whole = plainOf({level("all", 0, box(-10, -8, 10, 8))});
    const std::vector<std::vector<Level>> cuts = {
        {level("west", 0, {{-10, -8}, {1.1, -8}, {-2.2, 8}, {-10, 8}}),
         level("east", 0, {{1.1, -8}, {10, -8}, {10, 8}, {-2.2, 8}})},
        {level("west", 0, box(-10, -8, 0.6, 8)), level("south", 0, box(0.6, -8, 10, 1.7)),
         level("north", 0, box(0.6, 1.7, 10, 8))}};
    for (const std::vector<Level>& cut : cuts) {
        const Scene parts = plainOf(cut);
        ASSERT_EQ(whole.grid.cell_size, parts.grid.cell_size);
        const auto cellOf = [](const Scene& scene, glm::dvec2 home, std::uint32_t chart) {
            const glm::vec2 place = glm::vec2(home - scene.origin) + scene.chart_map.shifts[chart];
            return (*scene.fields.fields.front())[cellAt(scene.grid, place)];
        };
        int compared = 0;
        for (double y = -7.44; y < 7.5; y += 0.125)
            for (double x = -9.44; x < 9.5; x += 0.125) {
                const glm::dvec2 home(x, y);
                const gpu::FieldCell expected = cellOf(whole, home, 0);
                for (std::uint32_t chart = 0; chart < cut.size(); ++chart) {
                    if (parts.charts->rasters[chart].ownerOf(home) == gpu::NO_CHART) continue;
                    const gpu::FieldCell found = cellOf(parts, home, chart);
                    EXPECT_EQ(found.distance, expected.distance) << cut[chart].id << " " << x << " " << y;
                    EXPECT_EQ(found.direction, expected.direction) << cut[chart].id << " " << x << " " << y;
                    ++compared;
                }
            }
        EXPECT_GT(compared, 20'000);
    }
}

/// Along a ramp the way is shorter, up the stairs it takes less time.
TEST(Storeys, RoutesCountTheTimeThatLinksTake) {
    const MotionSettings motion;
    EXPECT_NEAR(costOfLink(motion, true, 0.5), 0.5 * (1.34 / 0.61 + 1.34 / 0.694), 0.01);
    EXPECT_NEAR(costOfLink(motion, false, 0.2), 0.5 * (std::exp(3.5 * 0.2) + std::exp(3.5 * 0.1)), 0.01);
    EXPECT_EQ(costOfLink(motion, false, 0.0), 1.0f);
    Layout layout;
    layout.levels = {level("ground", 0.0, box(-20, -6, 0, 6)), level("upper", 3.0, box(0, -6, 10, 6))};
    layout.links = {stairs(0, 1, {-6, 3}, {0, 3})};
    layout.links.push_back({"ramp", Link::Kind::ramp, 0, 1, {-13, -3}, {0, -3}, 2.0, {}});
    layout.areas = {{"goal", box(8, -1, 9, 1), {}, 1}};
    Formation walker;
    walker.id = "walker";
    GridFormation grid;
    grid.origin = {-18, 0};
    Destination destination;
    destination.places = {{Place::Kind::area, 0, {}}};
    grid.goal = destination;
    walker.shape = grid;
    layout.formations = {walker};
    const auto firstWay = [&] {
        Diagnostics diagnostics;
        const Scene scene = *buildScene(layout, diagnostics);
        const glm::vec2 place = glm::vec2(glm::dvec2(-17.0, -3.0) - scene.origin);
        return glm::unpackSnorm2x16((*scene.fields.fields.front())[cellAt(scene.grid, place)].direction);
    };
    EXPECT_GT(firstWay().y, 0.3f);
    for (std::size_t row = 0; row < motionParameters().size(); ++row)
        if (motionParameters()[row].rule == "slope_pace" && motionParameters()[row].is_switch)
            layout.simulation.motion.set(row, 0.0);
    EXPECT_LT(std::abs(firstWay().y), 0.1f);
}

Link escalator(std::size_t from, std::size_t to, glm::dvec2 begin, glm::dvec2 end) {
    Link link = stairs(from, to, begin, end, 1.0);
    link.id = "escalator";
    link.kind = Link::Kind::escalator;
    return link;
}

/// Somebody in the hall who wants to get up, and somebody on the gallery who wants to get down.
Layout upAndDown(std::vector<Link> links) {
    Layout layout;
    layout.levels = {level("ground", 0.0, box(-20, -6, 0, 6)), level("upper", 3.0, box(0, -6, 10, 6))};
    layout.links = std::move(links);
    layout.areas = {{"above", box(8, -1, 9, 1), {}, 1}, {"below", box(-18, -1, -17, 1), {}, 0}};
    for (const std::size_t goal : {0u, 1u}) {
        Formation walker;
        walker.id = goal == 0 ? "up" : "down";
        walker.level = goal;
        GridFormation grid;
        grid.origin = goal == 0 ? glm::dvec2(-19, 0) : glm::dvec2(9.5, 0);
        Destination destination;
        destination.places = {{Place::Kind::area, goal, {}}};
        grid.goal = destination;
        walker.shape = grid;
        layout.formations.push_back(walker);
    }
    return layout;
}

/// One way only: beyond its seams an escalator shows where it leads, and is shown where it begins.
TEST(Belts, AreNoWayBack) {
    const Link up = escalator(0, 1, {-5.5, 3}, {0, 3}), down = escalator(1, 0, {0, -3}, {-5.5, -3});
    Diagnostics diagnostics;
    const auto both = buildScene(upAndDown({up, down}), diagnostics);
    EXPECT_TRUE(both && diagnostics.entries.empty());
    Diagnostics nobody_gets_down;
    buildScene(upAndDown({up}), nobody_gets_down);
    ASSERT_FALSE(nobody_gets_down.entries.empty());
    EXPECT_NE(nobody_gets_down.entries.front().message.find("down"), std::string::npos)
        << nobody_gets_down.entries.front().message;

    const ChartMap& map = both->chart_map;
    const auto leads = [&](std::uint32_t chart, glm::dvec2 home) {
        return map.leadsAgainstBelt(glm::vec2(home - both->origin) + map.shifts[chart]);
    };
    EXPECT_FALSE(leads(0, {-5.1, 3}));  // on to it from below
    EXPECT_FALSE(leads(2, {0.4, 3}));   // off it
    EXPECT_TRUE(leads(2, {-5.9, 3}));   // back down
    EXPECT_TRUE(leads(1, {-0.4, 3}));   // on to its end
    EXPECT_TRUE(leads(0, {-5.1, -3}));
    EXPECT_FALSE(leads(1, {-0.4, -3}));
}

TEST(Belts, MoveAlongTheirSlope) {
    Diagnostics diagnostics;
    Link up = escalator(0, 1, {-5.5, 3}, {0, 3});
    up.stand = Link::Stand::right;
    const auto scene = buildScene(upAndDown({up, escalator(1, 0, {0, -3}, {-5.5, -3})}), diagnostics);
    ASSERT_TRUE(scene);
    const gpu::Belt& belt = scene->chart_map.belts[2];
    EXPECT_NEAR(belt.velocity.x, 0.5 * 5.5 / std::hypot(5.5, 3.0), 1e-6);
    EXPECT_NEAR(belt.velocity.y, 0.0, 1e-6);
    EXPECT_NEAR(belt.lane, 0.3, 1e-6);
    EXPECT_EQ(belt.stand, -1.0f);
    EXPECT_FALSE(scene->chart_map.isBelt(0));
    EXPECT_TRUE(scene->chart_map.isBelt(3));
    // Nothing moves where no link does.
    EXPECT_TRUE(buildScene(upAndDown({stairs(0, 1, {-6, 3}, {0, 3})}), diagnostics)->chart_map.belts.empty());
}

/// A metre of it takes who walks on it as long as so many on the flat.
TEST(Belts, CostTheTimeOfThoseWhoWalkOnThem) {
    const MotionSettings motion;
    EXPECT_NEAR(costOfBelt(motion, true, 0.577, 0.433), 1.34 / (0.61 + 0.433), 0.01);
    EXPECT_LT(costOfBelt(motion, true, 0.577, 0.433), costOfLink(motion, true, 0.577));
    EXPECT_NEAR(costOfBelt(motion, false, 0.0, 0.75), 1.34 / 2.09, 1e-6);  // less than on the flat
}

std::vector<std::string> complaintsAbout(const std::string& members) {
    Diagnostics diagnostics;
    const std::string text = R"({"throng": 1, "simulation": {"duration": 1},
 "formations": [{"id": "p", "type": "grid", "origin": [0, 0], "rows": 1, "columns": 1, "goal": {"offset": [1, 0]}}],
 )" + members + "}";
    if (const auto layout = readLayout(text, {}, diagnostics)) buildScene(*layout, diagnostics);
    std::vector<std::string> found;
    for (const Diagnostic& entry : diagnostics.entries)
        found.push_back(std::to_string(entry.where.line) + ": " + entry.message);
    return found;
}

TEST(Storeys, MistakesAreToldWhereTheyAre) {
    const std::string ground = R"({"id": "ground", "floor": [[-9, -5], [9, -5], [9, 5], [-9, 5]]})";
    const std::string upper = R"({"id": "upper", "height": 3, "floor": [[4, -5], [9, -5], [9, 5], [4, 5]]})";
    const std::string levels = "\"levels\": [" + ground + ", " + upper + "],\n";
    using Texts = std::vector<std::string>;
    EXPECT_EQ(
        complaintsAbout(
            levels + R"("links": [{"id": "s", "from": "ground", "to": "uper", "path": [[0, 0], [4, 0]]}])"),
        Texts{"4: there is no level `uper`"});
    EXPECT_EQ(
        complaintsAbout(
            levels + R"("links": [{"id": "s", "from": "ground", "to": "upper", "path": [[3, 0], [4, 0]]}])"),
        Texts{"4: link `s` climbs 3.00 m over 1.00 m: stairs climb at most 120 %"});
    EXPECT_EQ(
        complaintsAbout(
            levels + R"("links": [{"id": "s", "from": "ground", "to": "upper", "path": [[-3, 0], [3, 0]]}])"),
        Texts{"4: link `s` does not reach the floor of level `upper` at [3.00, 0.00]"});
    EXPECT_EQ(complaintsAbout(levels + R"("links": [{"id": "s", "type": "escalator", "from": "ground",
 "to": "upper", "path": [[1, 0], [4, 0]]}])"),
              Texts{"5: link `s` climbs 3.00 m over 3.00 m: escalators climb at most 71 %"});
    EXPECT_EQ(complaintsAbout(levels + R"("links": [{"id": "s", "from": "ground", "to": "upper", "speed": 1,
 "path": [[0, 0], [4, 0]]}])"),
              Texts{"4: `speed` is of ground that moves, and stairs do not"});
    EXPECT_EQ(complaintsAbout(levels + R"("links": [{"id": "s", "type": "escalator", "from": "ground",
 "to": "ground", "path": [[0, 0], [4, 0]]}])"),
              Texts{"5: link `s` begins and ends at the same level"});
    EXPECT_EQ(
        complaintsAbout("\"levels\": [" + ground +
                        ",\n{\"id\": \"mezzanine\", \"height\": 1.5, \"floor\": [[0, 0], [5, 0], [5, 5]]}]"),
        Texts{"4: levels `ground` and `mezzanine` lie over each other at [0.12, 0.12], 1.50 m apart"});
    EXPECT_EQ(complaintsAbout(levels + R"("terrain": {"file": "ground.glb"})"),
              (Texts{"3: level `ground`: a layout with a terrain has no floors of its own",
                     "3: level `upper`: a layout with a terrain has no floors of its own"}));
    EXPECT_EQ(
        complaintsAbout(levels + R"("walls": [{"id": "w", "points": [[0, 1], [1, 1]], "level": "upper"}])"),
        Texts{"4: wall `w` does not stand on the floor of level `upper`"});
    EXPECT_EQ(complaintsAbout(levels + R"("walls": [{"points": [[0, 1], [1, 1]], "level": "cellar"}])"),
              Texts{"4: there is no level `cellar`"});
}

TEST(Storeys, LinksDoNotGoThroughEachOther) {
    const auto complaints = [](const std::string& one, const std::string& other) {
        return complaintsAbout(R"("levels": [{"id": "ground", "floor": [[-9, -5], [9, -5], [9, 5], [-9, 5]]},
 {"id": "upper", "height": 3, "floor": [[-9, -5], [9, -5], [9, 5], [-9, 5]]},
 {"id": "top", "height": 6, "floor": [[-9, -5], [9, -5], [9, 5], [-9, 5]]}],
"links": [{"id": "a", )" + one +
                               "},\n{\"id\": \"b\", " + other + "}]");
    };
    using Texts = std::vector<std::string>;
    const std::string up = R"("from": "ground", "to": "upper", "path": [[-4, 0], [0, 0]])";
    EXPECT_EQ(complaints(up, R"("from": "ground", "to": "upper", "path": [[-4, 1], [0, 1]])"),
              Texts{"7: links `a` and `b` go through each other at [-2.00, 0.50]"});
    EXPECT_EQ(complaints(up, R"("from": "ground", "to": "upper", "path": [[-2, -3], [-2, 2]])"),
              Texts{"7: links `a` and `b` go through each other at [-2.00, 0.00]"})
        << "though they are 0.3 m over each other in the middle";
    EXPECT_EQ(complaints(up, R"("type": "lift", "levels": ["ground", "upper"], "at": [-2, 0])"),
              Texts{"7: links `a` and `b` go through each other at [-2.00, 0.00]"});
    EXPECT_EQ(complaints(up, R"("from": "upper", "to": "top", "path": [[-5, 0], [-1, 0]])"), Texts{})
        << "3.75 m over each other";
    EXPECT_EQ(complaints(up, R"("from": "ground", "to": "upper", "path": [[-4, 2.1], [0, 2.1]])"), Texts{})
        << "railings touch";
    const std::string turning =
        R"("from": "ground", "to": "top", "path": [[-8, 3], [-2, 3], [-2, -3], [-8, -3]])";
    EXPECT_EQ(complaints(turning, R"("from": "upper", "to": "top", "path": [[3, 0], [7, 0]])"), Texts{});
    EXPECT_EQ(complaints(turning, R"("type": "lift", "levels": ["ground", "upper"], "at": [-2, 3])"),
              Texts{"7: links `a, flight 1` and `b` go through each other at [-2.00, 3.00]"})
        << "on its landing";
    EXPECT_EQ(
        complaints(R"("from": "ground", "to": "top", "path": [[-8, 0], [0, 0], [0, 4], [-4, 4], [-4, -4]])",
                   R"("from": "upper", "to": "top", "path": [[3, 0], [7, 0]])"),
        Texts{})
        << "where one flight goes over another of the same link";
    EXPECT_EQ(complaints(up, R"("from": "upper", "to": "top", "path": [[-1.22, 0], [-5.22, 0]])"),
              Texts{"7: links `a` and `b` are only 0.99 m over each other at [-2.61, 0.00]"});
}

}  // namespace
}  // namespace throng::authoring
