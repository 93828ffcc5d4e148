// SPDX-License-Identifier: Apache-2.0
#include "io/crowd_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "io/streams/stream_writer.h"
#include "sample_crowd.h"

namespace throng::io {
namespace {

namespace fs = std::filesystem;
using test::SampleCrowd;
using test::TemporaryFolder;

SampleCrowd crowdOf(std::uint32_t rows) {
    test::SampleOptions options;
    options.rows = rows;
    options.frames = 12;
    options.gltf = false;
    return SampleCrowd(options);
}

class CrowdReaderTest : public testing::TestWithParam<std::uint32_t> {
  protected:
    CrowdReaderTest() : crowd(crowdOf(GetParam())) {
        crowd.bake(folder / "bake");
        bake = loadBake(folder / "bake");
    }
    /// What reading a stream of the first frame says.
    std::string refusal(Stream stream = Stream::dir) const {
        try {
            CrowdReader reader(bake);
            static_cast<void>(reader.frame(0)[stream]);
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }

    TemporaryFolder folder;
    SampleCrowd crowd;
    Bake bake;
};

TEST_P(CrowdReaderTest, GivesEveryFrameInAnyOrder) {
    CrowdReader reader(bake);
    EXPECT_EQ(reader.frames(), 12u);
    EXPECT_EQ(reader.rows(), GetParam());
    for (const std::uint32_t index : {11u, 0u, 5u, 4u, 5u, 11u}) {
        const CrowdFrame frame = reader.frame(index);
        ASSERT_EQ(frame.index(), index);
        ASSERT_EQ(frame.rows(), GetParam());
        std::vector<float> places(GetParam() * kComponents);
        StreamReader(bake.streamPath(Stream::pos)).readFrame(index, places);
        EXPECT_TRUE(std::ranges::equal(frame[Stream::pos], places));
        for (std::uint32_t row = 0; row < GetParam(); ++row) {
            ASSERT_EQ(frame.isThere(row), crowd.isAlive(row, index));
            if (!frame.isThere(row)) continue;
            ASSERT_NEAR(frame.place(row).x, crowd.position(row, index).x, 1e-5);
            ASSERT_NEAR(frame.place(row).y, crowd.position(row, index).y, 1e-5);
            ASSERT_NEAR(frame.facing(row).y, std::sin(crowd.heading(row, index)), 1e-6);
            ASSERT_GT(frame.speed(row), 1.0f);
        }
    }
    EXPECT_THROW(reader.frame(12), std::out_of_range);
}

TEST_P(CrowdReaderTest, ReadsAFrameOnceForAsLongAsItIsKept) {
    CrowdReader reader(bake);
    reader.keep(2);
    const CrowdFrame held = reader.frame(0);
    const float* places = held[Stream::pos].data();
    static_cast<void>(reader.frame(1)[Stream::pos]);
    EXPECT_EQ(reader.frame(0)[Stream::pos].data(), places);
    // From here on, whatever is read again fails.
    fs::resize_file(bake.streamPath(Stream::pos), 130);
    EXPECT_EQ(reader.frame(1)[Stream::pos].size(), GetParam() * kComponents);
    EXPECT_EQ(reader.frame(0)[Stream::pos].data(), places);
    EXPECT_THROW(static_cast<void>(reader.frame(11)[Stream::pos]), InputError);
    EXPECT_THROW(static_cast<void>(reader.frame(1)[Stream::pos]), InputError) << "two others were asked for";
    EXPECT_EQ(held[Stream::pos].data(), places) << "who holds a frame keeps it";
}

TEST_P(CrowdReaderTest, GivesEverybodysRowsAndGroups) {
    CrowdReader reader(bake);
    ASSERT_EQ(reader.people().size(), GetParam());
    EXPECT_EQ(&reader.people(), &reader.people()) << "read once";
    EXPECT_EQ(reader.people()[0].group, "eastbound");
    const GroupTable groups = groupsOf(reader.people());
    EXPECT_EQ(groups.group_of.size(), GetParam());
    EXPECT_EQ(groups.names.size(), std::min(GetParam(), 2u));
    EXPECT_EQ(groups.group_of.back(), (GetParam() - 1) % 2);
    bake.agents += 1;
    CrowdReader other(bake);
    EXPECT_THROW(other.people(), InputError);
}

TEST_P(CrowdReaderTest, SaysWhatIsWrongWithAStream) {
    EXPECT_EQ(refusal(), "");
    EXPECT_NE(refusal(Stream::density).find("this bake has no stream `density`"), std::string::npos);
    EXPECT_NE(refusal(Stream::ground).find("this bake has no stream `ground`"), std::string::npos);

    const fs::path path = bake.streamPath(Stream::dir);
    fs::resize_file(path, fs::file_size(path) - 1);
    EXPECT_NE(refusal().find("truncated"), std::string::npos) << refusal();
    EXPECT_EQ(refusal(Stream::pos), "") << "the others can be read";

    fs::remove(path);
    EXPECT_NE(refusal().find("No such file"), std::string::npos) << refusal();
    EXPECT_TRUE(refusal().starts_with(path.string()));

    {
        StreamWriter writer(path, StreamFormat::npy, GetParam() + 1, 1);
        writer.append(std::vector<float>((GetParam() + 1) * kComponents));
        writer.finish();
    }
    EXPECT_NE(refusal().find("1 frames of " + std::to_string(GetParam() + 1) + " people"), std::string::npos)
        << refusal();
}

INSTANTIATE_TEST_SUITE_P(OfSomePeople, CrowdReaderTest, testing::Values(1u, 63u, 1234u));

}  // namespace
}  // namespace throng::io
