// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "base/capsule.h"
#include "base/files/beneath.h"
#include "base/files/errors.h"
#include "base/files/input_file.h"
#include "base/files/output_file.h"
#include "base/json_shape.h"
#include "base/plane_grid.h"
#include "base/text/printable.h"

namespace throng {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(::testing::TempDir()) / ("files-" + std::to_string(::getpid()));
        fs::create_directories(folder / "inner");
        std::ofstream(folder / "inner" / "text") << "inside";
        std::ofstream(folder / "outside") << "outside";
    }
    void TearDown() override { fs::remove_all(folder); }
    static std::string errorOf(const fs::path& path, std::uint64_t limit = kMostText) {
        try {
            readFile(path, limit);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    fs::path folder;
};

TEST_F(Files, NothingButRegularFilesOfASensibleSizeAreRead) {
    EXPECT_EQ(readFile(folder / "inner" / "text"), "inside");
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_NE(errorOf(folder / "pipe").find("not a regular file"), std::string::npos);
    EXPECT_NE(errorOf("/dev/zero").find("not a regular file"), std::string::npos);
    EXPECT_NE(errorOf(folder).find("is a folder"), std::string::npos);
    EXPECT_NE(errorOf(folder / "inner" / "text", 5).find("larger than"), std::string::npos);
}

TEST_F(Files, LinksLeadNowhereOutside) {
    fs::create_symlink("../outside", folder / "inner" / "out");
    fs::create_symlink("text", folder / "inner" / "in");
    EXPECT_EQ(openBeneath(folder / "inner", "in").size(), 6u);
    EXPECT_THROW(openBeneath(folder / "inner", "out"), InputError);
    EXPECT_THROW(openBeneath(folder / "inner", "../outside"), InputError);
    EXPECT_THROW(openBeneath(folder / "inner", (folder / "outside").string()), InputError);
}

TEST_F(Files, NothingIsLeftWhereAFileCannotBeReplaced) {
    fs::create_directories(folder / "taken" / "by");
    EXPECT_THROW(replaceFile(folder / "taken", "text"), OutputError);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        EXPECT_EQ(entry.path().filename().string().find(".new-"), std::string::npos) << entry.path();
}

TEST(Printable, WritesOutWhatATerminalWouldObey) {
    EXPECT_EQ(printable("plain \xc3\xa4 \xe2\x82\xac \xf0\x9f\x9a\xb6"),
              "plain \xc3\xa4 \xe2\x82\xac \xf0\x9f\x9a\xb6");
    EXPECT_EQ(printable("a\x1b[31m\n\x7f"), "a\\x1b[31m\\x0a\\x7f");
    EXPECT_EQ(printable("a\n\tb\r", true), "a\n\tb\\x0d");
    EXPECT_EQ(printable("\xc2\x9b|\xe2\x80\xae"), "\\x9b|\\u202e");
    EXPECT_EQ(printable("\xff\xc0\xaf\xed\xa0\x80\xe2\x82"), "\\xff\\xc0\\xaf\\xed\\xa0\\x80\\xe2\\x82");
}

TEST(FileName, IsOneThatStaysInItsFolder) {
    EXPECT_TRUE(isFileName("two <streams> & \"quotes\""));
    for (const char* name : {"", ".", "..", "../x", "/tmp/x", "a/b", "a\x1b", "a\nb", "\xff"})
        EXPECT_FALSE(isFileName(name)) << name;
    EXPECT_FALSE(isFileName(std::string(300, 'a')));
}

TEST(InputError, RepeatsAsMuchOfAFileAsOneReads) {
    std::string euros;
    for (int i = 0; i < 2000; ++i)
        euros += "\xe2\x82\xac";
    const InputError error("bake.json", "found " + euros);
    EXPECT_LT(std::string(error.what()).size(), 700u);
    EXPECT_LT(error.reason().size(), 700u);
    EXPECT_TRUE(error.reason().ends_with("\xe2\x82\xac...")) << "a letter was cut in two";
}

TEST(JsonShape, IsLookedAtBeforeAnythingIsParsed) {
    EXPECT_EQ(tooMuchIn(R"({"a": [1, {"b": "[[[[::::{{{{\""}]})"), nullptr);
    EXPECT_EQ(tooMuchIn(std::string(64, '[')), nullptr);
    EXPECT_NE(tooMuchIn(std::string(65, '[')), nullptr);
    std::string keys = "{";
    for (int i = 0; i < 2000; ++i)
        keys += "\"\":{},";
    EXPECT_EQ(tooMuchIn(keys), nullptr);
    EXPECT_NE(tooMuchIn(keys + "\"\":0"), nullptr);
}

TEST(PlaneGrid, TakesPlacesAndBoundsHoweverFar) {
    for (const glm::dvec2 most :
         {glm::dvec2(10.0, 10.0), glm::dvec2(1.0e12, 1.0), glm::dvec2(1.0e12, 1.0e12)}) {
        PlaneGrid grid({0.0, 0.0}, most, 1.0);
        grid.sort({{-1.0e300, 5.0}, {1.0e300, 1.0e300}, {5.0, 5.0}, {NAN, 5.0}});
        std::vector<std::uint32_t> found;
        grid.near({5.0, 5.0}, 1.0, [&](std::uint32_t index) { found.push_back(index); });
        EXPECT_NE(std::find(found.begin(), found.end(), 2u), found.end());
        grid.near({-1.0e300, NAN}, HUGE_VAL, [&](std::uint32_t) {});
        grid.nearSegment({-1.0e300, NAN}, {NAN, 1.0e300}, HUGE_VAL, [&](std::uint32_t) {});
    }
}

TEST(PlaneGrid, FindsEachOnceOfAllBesideALine) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(-30.0, 30.0);
    PlaneGrid grid({-20.0, -10.0}, {20.0, 10.0}, 1.3);  // a third of them are outside
    std::vector<glm::dvec2> places(1234);
    for (glm::dvec2& place : places)
        place = {anywhere(random), 0.5 * anywhere(random)};
    grid.sort(places);
    std::size_t beside = 0, looked_at = 0;
    for (int line = 0; line < 300; ++line) {
        glm::dvec2 from{anywhere(random), anywhere(random)}, to{anywhere(random), anywhere(random)};
        if (line % 5 == 0) to.y = from.y;
        if (line % 5 == 1) to.x = from.x;
        std::vector<int> found(places.size(), 0);
        grid.nearSegment(from, to, 0.5, [&](std::uint32_t index) { ++found[index]; });
        for (std::size_t i = 0; i < places.size(); ++i) {
            EXPECT_LE(found[i], 1);
            looked_at += static_cast<std::size_t>(found[i]);
            if (segmentsDistance(places[i] - 0.5 * (from + to), glm::dvec2(0.0), 0.5 * (to - from)) > 0.5)
                continue;
            EXPECT_EQ(found[i], 1) << "line " << line;
            ++beside;
        }
    }
    EXPECT_GT(beside, 1000u);
    EXPECT_LT(looked_at, 10 * beside);
}

}  // namespace
}  // namespace throng
