// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <set>

#include "applied_crowd.h"

namespace throng::io {
namespace {

using test::SampleCrowd;

constexpr std::uint32_t kSampleRows = 64, kSampleFrames = 48;

/// Whom one selector means among the sample's people, after some layers before it.
class SelectionTest : public testing::Test {
  protected:
    SelectionTest() { crowd_.bake(folder_ / "bake"); }

    std::set<std::uint32_t> whom(const std::string& who, const std::string& before = "") {
        const std::string last = R"({"name": "last", "who": )" + who + R"(, "do": {"hide": true}})";
        CrowdReader reader(loadBake(folder_ / "bake"));
        LayeredCrowd layered(reader);
        const auto results =
            applyLayers(layered, test::layersOf("[" + before + (before.empty() ? "" : ", ") + last + "]"),
                        loadEntrants(reader));
        remarks_ = results.empty() ? std::vector<std::string>{"no layers"} : results.back().remarks;
        if (results.empty()) return {};
        return {results.back().rows.begin(), results.back().rows.end()};
    }

    static std::set<std::uint32_t> those(const std::function<bool(std::uint32_t)>& are) {
        std::set<std::uint32_t> rows;
        for (std::uint32_t row = 0; row < kSampleRows; ++row)
            if (are(row)) rows.insert(row);
        return rows;
    }
    /// Those of whom it is true in a frame of some in which they are there.
    std::set<std::uint32_t> ever(std::uint32_t first, std::uint32_t last,
                                 const std::function<bool(glm::dvec2)>& is) const {
        return those([&](std::uint32_t row) {
            for (std::uint32_t frame = first; frame <= last; ++frame)
                if (crowd_.isAlive(row, frame) && is(crowd_.position(row, frame))) return true;
            return false;
        });
    }

    test::TemporaryFolder folder_;
    SampleCrowd crowd_{{}};
    std::vector<std::string> remarks_;
};

TEST_F(SelectionTest, WordsAndRows) {
    EXPECT_EQ(whom(R"({"everybody": true})").size(), kSampleRows);
    EXPECT_EQ(whom(R"({"group": "eastbound"})"), those([](auto row) { return row % 2 == 0; }));
    EXPECT_EQ(whom(R"({"rows": [60, 900]})"), (std::set<std::uint32_t>{60, 61, 62, 63}));
    EXPECT_TRUE(remarks_.empty());
    EXPECT_EQ(whom(R"({"group": ["westbound", "eastbound"]})").size(), kSampleRows / 2);
    EXPECT_EQ(remarks_, std::vector<std::string>{"there is no group `westbound` in this bake"});
    EXPECT_TRUE(whom(R"({"profile": "child"})").empty());
    EXPECT_EQ(whom(R"({"party": [1, 1]})").size(), kSampleRows);
    EXPECT_TRUE(whom(R"({"party": [2, 9]})").empty());
}

TEST_F(SelectionTest, AndOrNot) {
    const auto below = [](std::uint32_t row) { return row < 8; };
    EXPECT_EQ(whom(R"({"group": "eastbound", "rows": [0, 7]})"), (std::set<std::uint32_t>{0, 2, 4, 6}));
    EXPECT_EQ(whom(R"({"and": [{"group": "eastbound"}, {"rows": [0, 7]}]})"),
              (std::set<std::uint32_t>{0, 2, 4, 6}));
    EXPECT_EQ(whom(R"({"or": [{"rows": [0, 3]}, {"rows": [3, 7]}]})"), those(below));
    EXPECT_EQ(whom(R"({"not": {"rows": [0, 7]}})"), those([&](auto row) { return !below(row); }));
    EXPECT_EQ(whom(R"({"not": {"or": [{"rows": [0, 9]}, {"group": "eastbound"}]}, "rows": [0, 13]})"),
              (std::set<std::uint32_t>{11, 13}));
}

TEST_F(SelectionTest, PlacesInFrames) {
    const auto in_box = [](glm::dvec2 p) { return p.x > -14.8 && p.x < -14.2 && std::abs(p.y) < 2.0; };
    const std::string polygon = R"("polygon": [[-14.8, -2], [-14.2, -2], [-14.2, 2], [-14.8, 2]])";
    EXPECT_EQ(whom(R"({"region": {)" + polygon + "}}"), ever(0, kSampleFrames - 1, in_box));
    EXPECT_EQ(whom(R"({"region": {"frames": [10, 10], )" + polygon + "}}"), ever(10, 10, in_box));
    EXPECT_LT(ever(10, 10, in_box).size(), ever(0, kSampleFrames - 1, in_box).size());
    const glm::dvec2 point(-13.0, 0.4);
    EXPECT_EQ(whom(R"({"near": {"point": [-13, 0.4], "within": 1.5, "frames": [3, 9]}})"),
              ever(3, 9, [&](glm::dvec2 p) { return glm::distance(p, point) <= 1.5; }));
    // The wall `corner` runs along y = 5.2 up to x = -5.2, is 0.3 m thick, and goes up from there.
    EXPECT_EQ(whom(R"({"near": {"wall": "corner", "within": 1.6}})"),
              ever(0, kSampleFrames - 1, [](glm::dvec2 p) {
                  const double right = std::max(p.x + 5.2, 0.0), below = 5.2 - p.y;
                  return p.x >= -16 && p.y < 5.2 && std::hypot(right, below) <= 1.6 + 0.15;
              }));
    EXPECT_FALSE(whom(R"({"near": {"wall": "corner", "within": 1.6}})").empty());
    EXPECT_TRUE(whom(R"({"near": {"wall": "absent", "within": 99}})").empty());
    EXPECT_EQ(remarks_.front(), "there is no wall `absent` in this bake");
    whom(R"({"region": {"frames": [48, 50], )" + polygon + "}}");
    EXPECT_EQ(remarks_.front(), "the bake has no frame 48: it has 48");
}

TEST_F(SelectionTest, NearOthersButNotNearOneself) {
    const auto near = those([&](std::uint32_t row) {
        for (std::uint32_t frame = 20; frame <= 30; ++frame)
            for (const std::uint32_t other : {3u, 4u})
                if (row != other && crowd_.isAlive(row, frame) && crowd_.isAlive(other, frame) &&
                    glm::distance(crowd_.position(row, frame), crowd_.position(other, frame)) <= 1.3)
                    return true;
        return false;
    });
    EXPECT_EQ(whom(R"({"near": {"who": {"rows": [3, 4]}, "within": 1.3, "frames": [20, 30]}})"), near);
    EXPECT_FALSE(near.empty());
    EXPECT_FALSE(near.contains(3));
}

TEST_F(SelectionTest, WhatACameraSees) {
    // From above the crossing, 4 m wide and 2 m high at 1 m, straight down: 10 m up it sees 40 m by 20 m.
    const std::string down = R"("matrix": [1,0,0,-12, 0,1,0,0, 0,0,1,10, 0,0,0,1])";
    EXPECT_EQ(whom(R"({"seen": {"margin": 0, "frames": [5, 5], "views": [{)" + down +
                   R"(, "size": [0.4, 0.2]}]}})"),
              ever(5, 5, [](glm::dvec2 p) {
                  // The picture is 4 m by 2 m on the ground, and smaller at the head; the feet decide.
                  return std::abs(p.x + 12.0) <= 2.0 && std::abs(p.y) <= 1.0;
              }));
    // A camera that looks east from the west edge: who is behind it is not seen.
    const std::string east = R"("matrix": [0,0,-1,-14.5, -1,0,0,0, 0,1,0,1.7, 0,0,0,1], "size": [2, 1])";
    const auto seen =
        whom(R"({"seen": {"margin": 0, "range": 5, "frames": [7, 7], "views": [{)" + east + "}]}}");
    EXPECT_EQ(seen, ever(7, 7, [](glm::dvec2 p) {
                  const double ahead = p.x + 14.5;
                  return ahead >= 0.0 && ahead <= 5.0 && std::abs(p.y) <= ahead;
              }));
    EXPECT_FALSE(seen.empty());
    // The second view is that of frame 7 on, and looks at nobody.
    const std::string away =
        R"({"frame": 7, "matrix": [1,0,0,500, 0,1,0,0, 0,0,1,10, 0,0,0,1], "size": [1, 1]})";
    EXPECT_TRUE(whom(R"({"seen": {"frames": [7, 9], "views": [{)" + east + "}, " + away + "]}}").empty());
    EXPECT_FALSE(whom(R"({"seen": {"frames": [6, 9], "views": [{)" + east + "}, " + away + "]}}").empty());
    // A parallel picture is as wide far away; 14 m down, 3 m by 2 m.
    const std::string flat =
        R"("matrix": [1,0,0,-13, 0,1,0,0, 0,0,1,14, 0,0,0,1], "size": [3, 2], "parallel": true)";
    EXPECT_EQ(whom(R"({"seen": {"margin": 0.25, "frames": [5, 5], "views": [{)" + flat + "}]}}"),
              ever(5, 5, [](glm::dvec2 p) { return std::abs(p.x + 13.0) <= 1.75 && std::abs(p.y) <= 1.25; }));
}

TEST_F(SelectionTest, SharesAreDrawnByWhoSomebodyIs) {
    const auto half = whom(R"({"share": {"of": 0.5}})");
    EXPECT_GT(half.size(), 20u);
    EXPECT_LT(half.size(), 44u);
    EXPECT_EQ(whom(R"({"share": {"of": 0.5}})"), half);
    EXPECT_NE(whom(R"({"share": {"of": 0.5, "seed": 1}})"), half);
    EXPECT_EQ(whom(R"({"share": {"of": 1}})").size(), kSampleRows);
    EXPECT_TRUE(whom(R"({"share": {"of": 0}})").empty());
    for (const std::uint32_t row : whom(R"({"share": {"of": 0.3}})"))
        EXPECT_TRUE(half.contains(row)) << "who is among fewer is among more";
}

TEST_F(SelectionTest, PeopleAreFoundByTheirEntryAndNotByTheirRow) {
    const glm::dvec2 place = crowd_.position(14, 15);
    const auto person = [&](int id) {
        return R"({"people": [{"id": )" + std::to_string(id) +
               R"(, "group": "eastbound", "spawn": {"frame": 15,
            "position": [)" +
               std::to_string(place.x) + ", " + std::to_string(place.y) + ", 0]}}]}";
    };
    EXPECT_EQ(whom(person(14)), std::set<std::uint32_t>{14});
    EXPECT_EQ(whom(person(50)), std::set<std::uint32_t>{14}) << "as after a retake";
    EXPECT_TRUE(
        whom(
            R"({"people": [{"id": 14, "group": "eastbound", "spawn": {"frame": 15, "position": [99, 0, 0]}}]})")
            .empty());
    EXPECT_NE(remarks_.front().find("person 14 of `eastbound`: nobody else"), std::string::npos);
}

TEST_F(SelectionTest, LayersBeforeHaveChangedThem) {
    const std::string move =
        R"({"name": "away", "who": {"rows": [0, 3]}, "do": {"move": {"by": [500, 0, 0]}}})";
    EXPECT_EQ(whom(R"({"near": {"point": [486, 0], "within": 30}})", move),
              (std::set<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(whom(R"({"changed": true})", move), (std::set<std::uint32_t>{0, 1, 2, 3}));
    const std::string copy =
        R"({"name": "more", "who": {"rows": [2, 3]}, "do": {"duplicate": {"copies": 2, "by": [50, 0, 0]}}})";
    EXPECT_EQ(whom(R"({"copies": "more"})", copy), (std::set<std::uint32_t>{64, 65, 66, 67}));
    EXPECT_EQ(whom(R"({"near": {"point": [86, 0], "within": 20}})", copy), (std::set<std::uint32_t>{66, 67}))
        << "the second copies are twice as far";
    EXPECT_EQ(whom(R"({"group": "eastbound", "rows": [63, 99]})", copy), (std::set<std::uint32_t>{64, 66}));
    const std::string hide =
        R"({"name": "gone", "who": {"rows": [0, 31]}, "do": {"hide": {"frames": [0, 20]}}})";
    const std::string everywhere = R"({"region": {"polygon": [[-99, -99], [99, -99], [99, 99], [-99, 99]], )";
    EXPECT_GE(*whom(everywhere + R"("frames": [20, 20]}})", hide).begin(), 32u);
    EXPECT_EQ(*whom(everywhere + R"("frames": [21, 21]}})", hide).begin(), 0u);
    const std::string off =
        R"({"name": "off", "enabled": false, "who": {"everybody": true}, "do": {"hide": true}})";
    EXPECT_TRUE(whom(R"({"changed": true})", off).empty());
    EXPECT_EQ(remarks_, std::vector<std::string>{"means nobody"});
}

}  // namespace
}  // namespace throng::io
