// SPDX-License-Identifier: Apache-2.0
#include "io/room_on_disk.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/files/errors.h"

namespace throng::test {
namespace {

StreamFormats only(StreamFormat format) {
    StreamFormats formats;
    formats.add(format);
    return formats;
}

TEST(RoomOnDisk, StreamsTakeTwelveBytesAPersonAndFrameInEachExactForm) {
    EXPECT_EQ(io::bytesOfStreams(1, only(StreamFormat::npy), 10, 7), 128u + 12 * 70);
    EXPECT_EQ(io::bytesOfStreams(3, only(StreamFormat::pc2), 10, 7), 3u * (32 + 12 * 70));
    EXPECT_EQ(io::bytesOfStreams(3, StreamFormats::standard(), 10, 7), 3u * (128 + 32 + 24 * 70));
    EXPECT_EQ(io::bytesOfStreams(0, StreamFormats::standard(), 10, 7), 0u);
}

TEST(RoomOnDisk, WhatCannotFitIsRefusedBeforeItBegins) {
    const std::filesystem::path here = std::filesystem::temp_directory_path();
    const std::uint64_t fits = 1, never = std::uint64_t{1} << 40;
    EXPECT_NO_THROW(io::requireRoom(here, 3, StreamFormats::standard(), fits, 1000));
    EXPECT_NO_THROW(io::requireRoom(here, 3, only(StreamFormat::packed), never, 1000))
        << "may turn out small";
    try {
        io::requireRoom(here, 3, StreamFormats::standard(), never, 1000);
        FAIL() << "a disk of " << never << " frames";
    } catch (const OutputError& error) {
        const std::string said = error.what();
        EXPECT_NE(said.find("has room for"), std::string::npos) << said;
        EXPECT_NE(said.find("--streams packed"), std::string::npos) << said;
    }
}

TEST(RoomOnDisk, WhereNobodyKnowsNothingIsRefused) {
    EXPECT_NO_THROW(io::requireRoom("/nowhere/at/all", 3, StreamFormats::standard(), 1, 1));
}

}  // namespace
}  // namespace throng::test
