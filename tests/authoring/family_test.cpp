// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

TEST(Generators, NumbersOutsideTheirRangeAreTold) {
    GeneratorValues values(generatorNamed("crossing")->parameters);
    EXPECT_THROW(values.set("arms", 2), std::invalid_argument);
    EXPECT_THROW(values.set("arms", 3.5), std::invalid_argument);
    EXPECT_THROW(values.set("width", std::nan("")), std::invalid_argument);
    EXPECT_THROW(values.set("legs", 3), std::invalid_argument);
}

}  // namespace
}  // namespace throng::authoring
