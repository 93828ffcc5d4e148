// SPDX-License-Identifier: Apache-2.0
// Streams that are read while they are written: what is there is what was written, and no more is there.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/stream_formats.h"
#include "io/streams/growing_stream.h"
#include "io/streams/packed_layout.h"
#include "io/streams/packed_writer.h"
#include "io/streams/stream_writer.h"
#include "sample_crowd.h"

namespace throng::io {
namespace {

using test::TemporaryFolder;

const StreamInfo& kGrowing = infoOf(Stream::pos);

/// Values that every form holds exactly.
std::vector<float> frameOf(std::uint32_t rows, std::uint32_t frame) {
    std::vector<float> values;
    for (std::uint32_t row = 0; row < rows; ++row)
        values.insert(values.end(), {0.5f * static_cast<float>(frame), 0.25f * static_cast<float>(row),
                                     static_cast<float>((frame * 7 + row) % 13)});
    return values;
}

class Growing : public testing::TestWithParam<std::uint32_t> {};

TEST_P(Growing, ArraysAreReadAsFarAsTheyHaveCome) {
    const std::uint32_t rows = GetParam(), frames = 40;
    const TemporaryFolder folder;
    StreamWriter writer(folder / "stream", StreamFormat::npy, rows, frames);
    GrowingStream reader(folder / "stream", kGrowing, StreamFormat::npy, frames, rows);
    std::vector<float> read(rows * kComponents);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        ASSERT_EQ(reader.frames(), frame);
        ASSERT_THROW(reader.readFrame(frame, read), std::out_of_range);
        writer.append(frameOf(rows, frame));
        if (frame == 5) std::filesystem::rename(folder / "stream", folder / "elsewhere");
        reader.readFrame(frame, read);
        ASSERT_EQ(read, frameOf(rows, frame));
    }
    writer.finish();
    EXPECT_EQ(reader.frames(), frames);
}

TEST_P(Growing, PackedStreamsAreReadBlockByBlock) {
    const std::uint32_t rows = GetParam(), block = blockFrames(rows), frames = 2 * block + 3;
    const TemporaryFolder folder;
    PackedWriter writer(folder / "stream", kGrowing, rows);
    GrowingStream reader(folder / "stream", kGrowing, StreamFormat::packed, frames, rows);
    std::vector<float> read(rows * kComponents);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        ASSERT_EQ(reader.frames(), frame / block * block);
        writer.append(frameOf(rows, frame), {});
    }
    writer.finish();
    ASSERT_EQ(reader.frames(), frames) << "the last block is shorter";
    for (const std::uint32_t frame : {frames - 1, 0u, block, block - 1, frames - 2}) {
        reader.readFrame(frame, read);
        ASSERT_EQ(read, frameOf(rows, frame)) << frame;
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Growing, testing::Values(1u, 63u, 1234u));

TEST(GrowingStream, HalfABlockIsNone) {
    const std::uint32_t rows = 1234, block = blockFrames(rows);
    const TemporaryFolder folder;
    PackedWriter writer(folder / "stream", kGrowing, rows);
    for (std::uint32_t frame = 0; frame < block; ++frame)
        writer.append(frameOf(rows, frame), {});
    const auto whole = std::filesystem::file_size(folder / "stream");
    for (const std::uintmax_t bytes :
         {whole - 1, whole / 2, std::uintmax_t{kPackedMagic.size()}, std::uintmax_t{0}}) {
        std::filesystem::resize_file(folder / "stream", bytes);
        GrowingStream reader(folder / "stream", kGrowing, StreamFormat::packed, 2 * block, rows);
        EXPECT_EQ(reader.frames(), 0u) << bytes;
    }
}

}  // namespace
}  // namespace throng::io
