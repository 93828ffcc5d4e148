// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <numeric>

#include "authoring/family/family_reader.h"
#include "authoring/layout/layout_reader.h"

namespace throng::authoring {
namespace {

constexpr const char* kBase =
    R"("base": {"throng": 1, "roads": [{"id": "r", "centreline": [[0, 0], [20, 0]], "width": 4}],
 "flows": [{"id": "f", "from": "r:start", "to": "r:end", "rate": 1}]})";

std::optional<Family> familyOf(const std::string& rest, Diagnostics& diagnostics) {
    return readFamily(std::string(R"({"throng_family": 1, )") + kBase + ", " + rest + "}", ".", diagnostics);
}

std::vector<Scenario> plan(const std::string& rest) {
    Diagnostics diagnostics;
    const auto family = familyOf(rest, diagnostics);
    for (const Diagnostic& entry : diagnostics.entries)
        ADD_FAILURE() << entry.message;
    return family ? planFamily(*family) : std::vector<Scenario>{};
}

TEST(Family, BakesMayBeAskedForEveryStreamFromTheDevice) {
    const auto schema = Json::parse(familySchema());
    for (const StreamInfo& info : kStreams) {
        if (info.source != StreamSource::device) continue;
        const std::string name(info.name);
        EXPECT_EQ(schema["properties"]["bake"]["properties"][name]["type"], "boolean") << name;
        Diagnostics diagnostics;
        const auto family = familyOf(
            R"("axes": [{"set": "/simulation/seed", "range": [1, 2, 1]}], "bake": {")" + name + R"(": true})",
            diagnostics);
        ASSERT_TRUE(family) << name;
        EXPECT_TRUE(family->bake.streams[info.id]);
    }
}

std::vector<double> column(const std::vector<Scenario>& scenarios, std::size_t axis) {
    std::vector<double> values;
    for (const Scenario& scenario : scenarios)
        values.push_back(scenario.parameters[axis].second.get<double>());
    return values;
}

TEST(Family, RangesIncludeBothEndsAndStayWhole) {
    const auto whole = plan(R"("axes": [{"set": "/simulation/seed", "range": [3, 7, 2]}])");
    ASSERT_EQ(whole.size(), 3u);
    EXPECT_TRUE(whole[0].parameters[0].second.is_number_integer());
    EXPECT_EQ(column(whole, 0), (std::vector<double>{3, 5, 7}));
    EXPECT_EQ(column(plan(R"("axes": [{"set": "/flows/0/rate", "range": [0.1, 0.5, 0.1]}])"), 0),
              (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5}));
}

TEST(Family, RangesBeginWithTheSmallestNumberThatThereIs) {
    const auto values = column(plan(R"("axes": [{"set": "/flows/0/rate", "range": [5e-324, 2.736]}])"), 0);
    ASSERT_EQ(values.size(), 3u);
    EXPECT_LT(values[0], 1e-300);
    EXPECT_EQ(values[2], 2.0);
}

TEST(Family, RandomNormalsAreTruncatedAndNotPiledUpAtTheirLimits) {
    const auto scenarios = plan(
        R"("sampling": "random", "count": 4000,
 "axes": [{"set": "/flows/0/rate", "normal": [2, 1], "min": 1, "max": 4}])");
    std::vector<double> values = column(scenarios, 0);
    ASSERT_GT(values.size(), 3900u);
    std::sort(values.begin(), values.end());
    EXPECT_GT(values.front(), 1.0);
    EXPECT_LT(values.back(), 4.0);
    const double mean =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    // Of a normal distribution cut at -1 and +2 deviations: (phi(-1) - phi(2)) / (Phi(2) - Phi(-1)) above its
    // mean.
    EXPECT_NEAR(mean, 2.0 + (0.24197 - 0.05399) / (0.97725 - 0.15866), 0.04);
}

TEST(Family, LogNormalsHaveTheMedianThatTheirMeanSays) {
    auto values = column(
        plan(
            R"("sampling": "latin", "count": 1001, "axes": [{"set": "/flows/0/rate", "log_normal": [0.5, 0.4]}])"),
        0);
    std::sort(values.begin(), values.end());
    EXPECT_NEAR(values[values.size() / 2], std::exp(0.5), 0.01);
    EXPECT_NEAR(std::log(values[841 * values.size() / 1000]), 0.9, 0.02) << "one deviation up";
}

TEST(Family, AddingAnAxisChangesNothingInTheOthers) {
    const std::string rate = R"({"set": "/flows/0/rate", "uniform": [1, 2]})";
    const std::string seed = R"({"set": "/simulation/seed", "uniform": [1, 99], "whole": true})";
    const std::string head = R"("sampling": "latin", "count": 20, "axes": [)";
    EXPECT_EQ(column(plan(head + rate + "]"), 0), column(plan(head + rate + "," + seed + "]"), 0));
}

TEST(Family, WhatIsDrawnTwiceIsThereOnce) {
    EXPECT_EQ(
        plan(
            R"("sampling": "random", "count": 100, "axes": [{"set": "/simulation/seed", "values": [1, 2, 3]}])")
            .size(),
        3u);
}

TEST(Family, PointersMayAddMembersAndSetSeveralAtOnce) {
    Diagnostics diagnostics;
    const auto family =
        familyOf(R"("axes": [{"set": ["/simulation/seed", "/roads/0/width"], "values": [3]}])", diagnostics);
    ASSERT_TRUE(family);
    const Json layout = composeLayout(*family, planFamily(*family)[0]);
    EXPECT_EQ(layout.at("roads").at(0).at("width"), 3);
    EXPECT_FALSE(layout.at("simulation").contains("fps"));
}

TEST(Family, NumbersAmongMissingMembersMakeNoLongLists) {
    Diagnostics diagnostics;
    const auto family = familyOf(
        R"("axes": [{"set": ["/absent/123456789012/x", "/events/0/at"], "values": [3]}])", diagnostics);
    ASSERT_TRUE(family);
    const Json layout = composeLayout(*family, planFamily(*family)[0]);
    EXPECT_EQ(layout.at("absent"), Json::parse(R"({"123456789012": {"x": 3}})"));
    EXPECT_EQ(layout.at("events"), Json::parse(R"([{"at": 3}])"));
    for (const char* pointer : {"/roads/1/width", "/roads/99999999999999999999/width", "/roads/-/width"}) {
        const auto beyond =
            familyOf(std::string(R"("axes": [{"values": [3], "set": ")") + pointer + "\"}]", diagnostics);
        ASSERT_TRUE(beyond) << pointer;
        EXPECT_THROW(composeLayout(*beyond, planFamily(*beyond)[0]), std::invalid_argument) << pointer;
    }
}

TEST(Family, ItemsAreFoundByTheirIds) {
    Diagnostics diagnostics;
    const auto family = familyOf(R"("axes": [{"set": "/flows/by-id/f/rate", "values": [3]}])", diagnostics);
    ASSERT_TRUE(family);
    EXPECT_EQ(family->axes[0].name, "flows.f.rate");
    EXPECT_EQ(composeLayout(*family, planFamily(*family)[0]).at("flows").at(0).at("rate"), 3);
    const auto absent = familyOf(R"("axes": [{"set": "/flows/by-id/g/rate", "values": [3]}])", diagnostics);
    ASSERT_TRUE(absent);
    try {
        composeLayout(*absent, planFamily(*absent)[0]);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("id `g`; there are `f`"), std::string::npos) << error.what();
    }
}

TEST(Family, FormulasAreOfOtherAxesAndOfFormulasBefore) {
    const auto scenarios = plan(R"json("axes": [
 {"name": "a", "set": "/simulation/seed", "values": [1, 2]},
 {"name": "b", "set": "/flows/0/rate", "formula": "0.1 * a * 3"},
 {"name": "c", "set": "/roads/0/width", "formula": "-(b - 2) / 2 + min(a, 9, 8) * max(1, 2)"},
 {"name": "d", "set": "/simulation/substeps", "formula": "e * a + 0.4", "whole": true},
 {"name": "e", "set": "/simulation/duration", "values": [3]}])json");
    EXPECT_EQ(column(scenarios, 1), (std::vector<double>{0.3, 0.6}));
    EXPECT_EQ(column(scenarios, 2), (std::vector<double>{2.85, 4.7}));
    EXPECT_EQ(column(scenarios, 3), (std::vector<double>{3, 6}));
    EXPECT_TRUE(scenarios[0].parameters[3].second.is_number_integer());
    const auto doubled = plan(R"json("sampling": "latin", "count": 3, "axes": [
 {"name": "b", "set": "/c", "formula": "2*a"}, {"name": "a", "set": "/b", "uniform": [1, 1]}])json");
    EXPECT_EQ(column(doubled, 0), (std::vector<double>{2}));
}

TEST(Family, WrongFormulasAreToldWhereTheyAreWrong) {
    struct Wrong {
        std::string formula;
        int letter;
        std::string message;
    };
    const Wrong wrong[] = {{"2 * (a + 1", 10, "expected `)`, found the end"},
                           {"2 ** a", 3, "expected a number"},
                           {"sin(a)", 0, "there is no function `sin`"},
                           {"a + b", 4, "there is no axis `b`"},
                           {"a + f", 4, "a formula is of other axes"},
                           {"text + 1", 0, "`text` is no number"},
                           {"a + ", 4, "expected a number"},
                           {"a; 1", 1, "expected +, -, *, / or the end, found `;`"}};
    for (const Wrong& each : wrong) {
        Diagnostics diagnostics;
        const std::string head = R"("axes": [{"name": "a", "set": "/a", "values": [0]},
 {"name": "text", "set": "/b", "values": ["x"]},
 {"name": "f", "set": "/c", "formula": ")";
        EXPECT_FALSE(familyOf(head + each.formula + "\"}]", diagnostics)) << each.formula;
        ASSERT_EQ(diagnostics.entries.size(), 1u) << each.formula;
        const Diagnostic& told = diagnostics.entries[0];
        const std::size_t before = head.size() - head.rfind('\n');  // the column of the first letter
        EXPECT_EQ(told.where.column, static_cast<int>(before) + each.letter) << told.message;
        EXPECT_EQ(told.message.substr(0, each.message.size()), each.message);
    }
    Diagnostics diagnostics;
    const auto family = familyOf(
        R"("axes": [{"name": "a", "set": "/a", "values": [1, 0]}, {"name": "f", "set": "/b", "formula": "1/a"}])",
        diagnostics);
    ASSERT_TRUE(family);
    EXPECT_THROW(planFamily(*family), PlanError);
}

TEST(Family, CasesSetSeveralThings) {
    Diagnostics diagnostics;
    const auto family = familyOf(R"("axes": [{"name": "day", "cases": {
 "quiet": {"/flows/by-id/f/rate": 0.5, "/roads/0/width": 3}, "busy": {"/flows/0/rate": 2}}}])",
                                 diagnostics);
    ASSERT_TRUE(family);
    const auto scenarios = planFamily(*family);
    ASSERT_EQ(scenarios.size(), 2u);
    EXPECT_EQ(describe(scenarios[1]), "day \"busy\"");
    const Json quiet = composeLayout(*family, scenarios[0]), busy = composeLayout(*family, scenarios[1]);
    EXPECT_EQ(quiet.at("flows").at(0).at("rate"), 0.5);
    EXPECT_EQ(quiet.at("roads").at(0).at("width"), 3);
    EXPECT_EQ(busy.at("flows").at(0).at("rate"), 2);
    EXPECT_EQ(busy.at("roads").at(0).at("width"), 4);
    for (const char* wrong : {R"({"cases": {"a": {}}})", R"({"name": "x", "set": "/a", "cases": {"a": {}}})",
                              R"({"name": "x", "cases": {}})", R"({"name": "x", "cases": {"a": 3}})",
                              R"({"name": "x", "cases": {"a": {"flows": 3}}})"})
        EXPECT_FALSE(familyOf(std::string(R"("axes": [)") + wrong + "]", diagnostics)) << wrong;
}

TEST(Family, EveryMistakeHasItsPlace) {
    Diagnostics diagnostics;
    EXPECT_FALSE(familyOf(
        R"("axes": [{"set": "/a", "values": []}, {"sett": "/a", "values": [1]}, 7], "sampling": "cubes")",
        diagnostics));
    EXPECT_GE(diagnostics.entries.size(), 4u);
    for (const Diagnostic& entry : diagnostics.entries)
        EXPECT_GT(entry.where.line, 0) << entry.message;
}

TEST(Generators, TheSameNumbersGiveTheSameLayoutAndAnotherSeedAnother) {
    for (const Generator& generator : generators()) {
        GeneratorValues values(generator.parameters);
        if (generator.name == "crossing") values.set("irregularity", 0.7);
        const Json layout = generator.make(values);
        EXPECT_EQ(layout, generator.make(values));
        values.set("seed", 99);
        EXPECT_NE(layout, generator.make(values));
        Diagnostics diagnostics;
        EXPECT_TRUE(readLayout(layout.dump(), {}, diagnostics)) << generator.name;
    }
}

/// Where the people of a grid stand that is turned round, before they are moved from there.
std::vector<glm::dvec2> placesOf(const Json& grid) {
    std::vector<glm::dvec2> places;
    EXPECT_EQ(grid["rotation"], 180);
    for (int column = 0; column < grid["columns"].get<int>(); ++column)
        for (int row = 0; row < grid["rows"].get<int>(); ++row)
            if (places.size() < grid["count"].get<std::size_t>())
                places.emplace_back(grid["origin"][0].get<double>() - column * grid["spacing"].get<double>(),
                                    grid["origin"][1].get<double>() - row * grid["spacing"].get<double>());
    return places;
}

TEST(Generators, EverybodyOfAMarathonStandsInTheFieldAndNobodyBesideAnother) {
    for (const double people : {1.0, 63.0, 1234.0, 30000.0}) {
        GeneratorValues values(generatorNamed("marathon")->parameters);
        values.set("people", people);
        values.set("waves", 5);
        const Json layout = generatorNamed("marathon")->make(values);
        const Json& corners = layout["areas"][0]["polygon"];
        const double west = corners[0][0].get<double>(), north = corners[2][1].get<double>();
        std::vector<glm::dvec2> places;
        double wait = -1.0, front = 0.0;
        for (const Json& wave : layout["formations"]) {
            const std::vector<glm::dvec2> its_own = placesOf(wave);
            EXPECT_EQ(wave["arrival"], "leave") << "or the finish fills up";
            EXPECT_GT(wave.value("wait", 0.0), wait) << "who stands further back sets off later";
            wait = wave.value("wait", 0.0);
            for (const glm::dvec2 place : its_own)
                EXPECT_LT(place.x, front - 0.49) << people;
            front = its_own.back().x;
            places.insert(places.end(), its_own.begin(), its_own.end());
        }
        EXPECT_EQ(places.size(), static_cast<std::size_t>(people));
        for (const glm::dvec2 place : places)
            EXPECT_TRUE(place.x > west + 0.5 && place.x < -0.5 && place.y > 0.5 && place.y < north - 0.5)
                << people;
        const auto streets = std::ranges::count_if(layout["roads"], [](const Json& road) {
            return road["id"].get<std::string>().starts_with("street");
        });
        EXPECT_EQ(layout["walls"].size(), 1u + 3u * static_cast<std::size_t>(streets - 1))
            << "houses between them";
    }
}

TEST(Generators, NumbersOutsideTheirRangeAreTold) {
    GeneratorValues values(generatorNamed("crossing")->parameters);
    EXPECT_THROW(values.set("arms", 2), std::invalid_argument);
    EXPECT_THROW(values.set("arms", 3.5), std::invalid_argument);
    EXPECT_THROW(values.set("width", std::nan("")), std::invalid_argument);
    EXPECT_THROW(values.set("legs", 3), std::invalid_argument);
}

}  // namespace
}  // namespace throng::authoring
