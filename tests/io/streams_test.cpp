// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <numeric>
#include <string>

#include "io/streams/stream_reader.h"
#include "io/streams/stream_writer.h"
#include "sample_crowd.h"

namespace throng::io {
namespace {

using test::contentOf;
using test::TemporaryFolder;

void writeContent(const std::filesystem::path& path, const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
}

std::string bytes(std::initializer_list<int> values) {
    std::string result;
    for (const int value : values)
        result += static_cast<char>(value);
    return result;
}

/// Frame f of a stream whose values tell their own place.
std::vector<float> countingFrame(std::uint32_t frame, std::uint32_t rows) {
    std::vector<float> values(rows * 3);
    std::iota(values.begin(), values.end(), static_cast<float>(frame * rows * 3));
    return values;
}

void writeCounting(const std::filesystem::path& path, StreamFormat format, std::uint32_t rows,
                   std::uint32_t expected, std::uint32_t frames) {
    StreamWriter writer(path, format, rows, expected);
    for (std::uint32_t frame = 0; frame < frames; ++frame)
        writer.append(countingFrame(frame, rows));
    writer.finish();
}

std::string messageOf(const std::filesystem::path& path) {
    try {
        const StreamReader reader(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(StreamHeader, OfPointCachesHasItsExactBytes) {
    const std::string expected = std::string("POINTCACHE2\0", 12) + bytes({1, 0, 0, 0}) +
                                 bytes({0xd2, 4, 0, 0}) + bytes({0, 0, 0x80, 0x3f}) +
                                 bytes({0, 0, 0x80, 0x3f}) + bytes({0xe0, 1, 0, 0});
    EXPECT_EQ(streamHeader(StreamFormat::pc2, 480, 1234), expected);
}

TEST(StreamHeader, OfNumpyArraysHasItsExactBytes) {
    const std::string start = bytes({0x93}) + "NUMPY" + bytes({1, 0, 118, 0}) +
                              "{'descr': '<f4', 'fortran_order': False, 'shape': (480, 1234, 3), }";
    const std::string header = streamHeader(StreamFormat::npy, 480, 1234);
    ASSERT_EQ(header.size(), 128u);
    EXPECT_EQ(header.substr(0, start.size()), start);
    EXPECT_EQ(header.substr(start.size()), std::string(127 - start.size(), ' ') + "\n");
}

TEST(StreamHeader, OfNumpyArraysHasRoomForTheLargestCounts) {
    const std::string header = streamHeader(StreamFormat::npy, 0xffffffffu, 0xffffffffu);
    EXPECT_EQ(header.size(), 128u);
    EXPECT_NE(header.find("(4294967295, 4294967295, 3), }"), std::string::npos);
}

class StreamSizes : public testing::TestWithParam<std::tuple<StreamFormat, std::uint32_t>> {};

TEST_P(StreamSizes, ReadBackWhatWasWritten) {
    const auto [format, rows] = GetParam();
    const TemporaryFolder folder;
    writeCounting(folder / "stream", format, rows, 5, 5);
    EXPECT_EQ(std::filesystem::file_size(folder / "stream"), headerSize(format) + 5u * rows * 12u);
    const StreamReader reader(folder / "stream");
    EXPECT_EQ(reader.format(), format);
    EXPECT_EQ(reader.frames(), 5u);
    EXPECT_EQ(reader.rows(), rows);
    std::vector<float> frame(rows * 3);
    reader.readFrame(3, frame);
    EXPECT_EQ(frame, countingFrame(3, rows));
    std::vector<float> last(3);
    reader.readRows(4, rows - 1, last);
    EXPECT_EQ(last[2], static_cast<float>(5 * rows * 3 - 1));
    EXPECT_THROW(reader.readFrame(5, frame), std::out_of_range);
    EXPECT_THROW(reader.readRows(0, rows, last), std::out_of_range);
}

TEST_P(StreamSizes, CountTheFramesThatCameWhenABakeEndsEarly) {
    const auto [format, rows] = GetParam();
    const TemporaryFolder folder;
    writeCounting(folder / "early", format, rows, 480, 2);
    writeCounting(folder / "planned", format, rows, 2, 2);
    EXPECT_EQ(contentOf(folder / "early"), contentOf(folder / "planned"));
}

TEST_P(StreamSizes, AreRejectedWhenTruncatedOrTooLong) {
    const auto [format, rows] = GetParam();
    const TemporaryFolder folder;
    writeCounting(folder / "whole", format, rows, 2, 2);
    const std::string whole = contentOf(folder / "whole");
    for (const std::size_t size : {std::size_t{0}, std::size_t{5}, headerSize(format) - 1, headerSize(format),
                                   whole.size() - 12, whole.size() - 1}) {
        writeContent(folder / "cut", whole.substr(0, size));
        EXPECT_NE(messageOf(folder / "cut"), "") << size << " bytes";
    }
    writeContent(folder / "cut", whole.substr(0, whole.size() - 1));
    EXPECT_NE(messageOf(folder / "cut").find("truncated"), std::string::npos);
    writeContent(folder / "long", whole + "x");
    EXPECT_NE(messageOf(folder / "long"), "");
    EXPECT_EQ(messageOf(folder / "whole"), "");
}

INSTANTIATE_TEST_SUITE_P(OfBothFormats, StreamSizes,
                         testing::Combine(testing::Values(StreamFormat::npy, StreamFormat::pc2),
                                          testing::Values(1u, 63u, 1234u)),
                         [](const auto& entry) {
                             return std::string(std::get<0>(entry.param) == StreamFormat::npy ? "npy"
                                                                                              : "pc2") +
                                    std::to_string(std::get<1>(entry.param));
                         });

TEST(StreamReader, RejectsWhatIsNotAStream) {
    const TemporaryFolder folder;
    EXPECT_NE(messageOf(folder / "absent").find("No such file"), std::string::npos);
    EXPECT_NE(messageOf(folder.path()).find("is a folder"), std::string::npos);
    writeContent(folder / "text", "once upon a time there was a stream");
    EXPECT_NE(messageOf(folder / "text").find("neither"), std::string::npos);
}

TEST(StreamReader, RejectsOtherArraysAndVersions) {
    const TemporaryFolder folder;
    writeCounting(folder / "good", StreamFormat::npy, 2, 1, 1);
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string content = contentOf(folder / "good");
        content.replace(content.find(from), from.size(), to);
        writeContent(folder / "bad", content);
        return messageOf(folder / "bad");
    };
    EXPECT_EQ(with("<f4", "<f4"), "");
    EXPECT_NE(with("<f4", "<f8"), "");
    EXPECT_NE(with("<f4", ">f4"), "");
    EXPECT_NE(with("False", "True "), "");
    EXPECT_NE(with("(1, 2, 3)", "(1, 3, 2)"), "");
    EXPECT_NE(with("(1, 2, 3)", "(1, 6)   "), "");
    EXPECT_NE(with("(1, 2, 3)", "(1, 2, x)"), "");
    EXPECT_NE(with("(1, 2, 3)", "(9223372036854775807, 2, 3)"), "");
    EXPECT_NE(with("NUMPY\x01", "NUMPY\x03"), "");

    std::filesystem::remove(folder / "good");
    writeCounting(folder / "good", StreamFormat::pc2, 2, 1, 1);
    EXPECT_NE(with(bytes({2, 0, 0, 0}), bytes({2, 0, 0, 0x80})), "");  // a negative number of points
    EXPECT_NE(with(bytes({1, 0, 0, 0}), bytes({2, 0, 0, 0})), "");     // another version
}

TEST(StreamReader, ReadsArraysWithOtherHeaderLengths) {
    const TemporaryFolder folder;
    const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 3), }   \n";
    const float values[3] = {1.5f, 2.5f, 3.5f};
    std::string data(12, '\0');
    std::memcpy(data.data(), values, 12);
    writeContent(folder / "v1",
                 bytes({0x93}) + "NUMPY" + bytes({1, 0, static_cast<int>(header.size()), 0}) + header + data);
    writeContent(folder / "v2", bytes({0x93}) + "NUMPY" +
                                    bytes({2, 0, static_cast<int>(header.size()), 0, 0, 0}) + header + data);
    for (const char* name : {"v1", "v2"}) {
        std::vector<float> frame(3);
        StreamReader(folder / name).readFrame(0, frame);
        EXPECT_EQ(frame, (std::vector<float>{1.5f, 2.5f, 3.5f})) << name;
    }
}

/// Long enough that back-filling goes through several chunks of the file.
TEST(BackFilling, GivesLateRowsTheirFirstValuesInAllEarlierFrames) {
    constexpr std::uint32_t kRows = 30'011;
    constexpr std::uint32_t kFrames = 40;
    const auto first_alive = [](std::uint32_t row) {
        return row % 7 == 6 ? kNone : row % 3 == 0 ? row % (kFrames + 5) : 0u;
    };
    const auto value = [](std::uint32_t frame, std::uint32_t row, std::uint32_t component) {
        return static_cast<float>(frame * 100 + row % 97 + component * 0.25);
    };
    std::vector<std::uint32_t> first(kRows);
    for (std::uint32_t row = 0; row < kRows; ++row)
        first[row] = first_alive(row);
    for (const StreamFormat format : {StreamFormat::npy, StreamFormat::pc2}) {
        const TemporaryFolder folder;
        StreamWriter writer(folder / "stream", format, kRows, kFrames);
        std::vector<float> frame_values(kRows * 3);
        for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
            for (std::uint32_t i = 0; i < kRows * 3; ++i)
                frame_values[i] = value(frame, i / 3, i % 3);
            writer.append(frame_values);
        }
        writer.backFill(first, {BackFill::first_alive, BackFill::keep, BackFill::zero});
        writer.finish();

        const StreamReader reader(folder / "stream");
        std::size_t wrong = 0;
        for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
            reader.readFrame(frame, frame_values);
            for (std::uint32_t row = 0; row < kRows; ++row) {
                const bool is_early = first[row] < kFrames && frame < first[row];
                wrong += frame_values[row * 3] != value(is_early ? first[row] : frame, row, 0);
                wrong += frame_values[row * 3 + 1] != value(frame, row, 1);
                wrong += frame_values[row * 3 + 2] != (is_early ? 0.0f : value(frame, row, 2));
            }
        }
        EXPECT_EQ(wrong, 0u);
    }
}

TEST(StreamWriter, RefusesFramesOfAnotherSizeAndExistingFiles) {
    const TemporaryFolder folder;
    StreamWriter writer(folder / "stream", StreamFormat::npy, 4, 1);
    EXPECT_THROW(writer.append(countingFrame(0, 3)), std::invalid_argument);
    EXPECT_THROW(StreamWriter(folder / "stream", StreamFormat::npy, 4, 1), OutputError);
    EXPECT_THROW(StreamWriter(folder / "large", StreamFormat::pc2, 0x80000000u, 1), OutputError);
}

}  // namespace
}  // namespace throng::io
