// SPDX-License-Identifier: Apache-2.0
// The form `packed`: what is read is what was written, to within half a step, from anywhere; a file that is
// not what it says is one error.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "io/streams/packed_writer.h"
#include "io/streams/stream_reader.h"
#include "sample_crowd.h"

namespace throng::io {
namespace {

using test::contentOf;
using test::TemporaryFolder;

const StreamInfo& kPlaces = infoOf(Stream::pos);

/// Somebody who walks, and shakes a little.
std::vector<float> walkers(std::uint32_t rows, std::uint32_t frame) {
    std::vector<float> values;
    for (std::uint32_t row = 0; row < rows; ++row) {
        const float t = static_cast<float>(frame) / 24.0f, r = static_cast<float>(row);
        values.insert(values.end(),
                      {1.3f * t + 0.001f * std::sin(7.0f * t + r), -0.37f * r, 0.1f * std::cos(t)});
    }
    return values;
}

void write(const std::filesystem::path& path, std::uint32_t rows, std::uint32_t frames) {
    PackedWriter writer(path, kPlaces, rows);
    for (std::uint32_t frame = 0; frame < frames; ++frame)
        writer.append(walkers(rows, frame), {});
    writer.finish();
}

class PackedSizes : public testing::TestWithParam<std::tuple<std::uint32_t, std::uint32_t>> {};

TEST_P(PackedSizes, ComeBackToWithinHalfAStepFromAnywhere) {
    const auto [rows, frames] = GetParam();
    const TemporaryFolder folder;
    write(folder / "stream", rows, frames);
    const StreamReader reader(folder / "stream");
    ASSERT_EQ(reader.format(), StreamFormat::packed);
    ASSERT_EQ(reader.frames(), frames);
    ASSERT_EQ(reader.rows(), rows);
    std::mt19937 generator(5);
    const auto random = [&] { return static_cast<std::uint32_t>(generator()); };
    for (std::uint32_t look = 0; look < std::min(frames, 40u) && rows > 0; ++look) {
        const std::uint32_t frame = random() % frames, first = random() % rows;
        std::vector<float> read((1 + random() % (rows - first)) * kComponents);
        reader.readRows(frame, first, read);
        const std::vector<float> written = walkers(rows, frame);
        for (std::size_t i = 0; i < read.size(); ++i)
            ASSERT_LE(std::abs(static_cast<double>(read[i]) - written[first * kComponents + i]), kFinest / 2)
                << "frame " << frame << " value " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(OfAllKinds, PackedSizes,
                         testing::Combine(testing::Values(0, 1, 1023, 1024, 2500),
                                          testing::Values(0, 1, 63, 64, 65, 200)));

TEST(PackedWriter, TakesFewFramesTogetherWhereThereAreManyRows) {
    EXPECT_EQ(blockFrames(0), 64u);
    EXPECT_EQ(blockFrames(16'384), 64u);
    EXPECT_EQ(blockFrames(262'144), 16u);
    EXPECT_EQ(blockFrames(4'000'000), 8u);
}

TEST(PackedWriter, AgainGivesTheSameBytes) {
    const TemporaryFolder folder;
    write(folder / "once", 30, 90);
    const StreamReader reader(folder / "once");
    PackedWriter again(folder / "again", kPlaces, 30);
    std::vector<float> values(30 * kComponents);
    for (std::uint32_t frame = 0; frame < 90; ++frame) {
        reader.readFrame(frame, values);
        again.append(values, {});
    }
    again.finish();
    EXPECT_EQ(contentOf(folder / "once"), contentOf(folder / "again"));
}

TEST(PackedWriter, LargeNumbersAreExact) {
    const TemporaryFolder folder;
    const std::vector<float> values = {130'000.03f, -131'000.97f, 4096.2501f,
                                       1e-30f,      -0.0f,        17.0f / 16384.0f};
    PackedWriter writer(folder / "stream", kPlaces, 2);
    writer.append(values, {});
    writer.finish();
    std::vector<float> read(values.size());
    StreamReader(folder / "stream").readFrame(0, read);
    EXPECT_EQ(read, (std::vector<float>{values[0], values[1], values[2], 0.0f, 0.0f, values[5]}));
}

TEST(PackedWriter, WhatHasNoPackedFormIsAnError) {
    const TemporaryFolder folder;
    PackedWriter places(folder / "places", kPlaces, 1);
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1.5e5f, -1e30f})
        EXPECT_THROW(places.append(std::vector<float>{0.0f, bad, 0.0f}, {}), OutputError) << bad;
    PackedWriter states(folder / "states", infoOf(Stream::state), 1);
    EXPECT_THROW(states.append(std::vector<float>{1.0001f, 0.0f, 0.0f}, {}), OutputError);
    EXPECT_THROW(states.append(std::vector<float>{1.0f, 0.5f, 0.0f}, {}), OutputError);
    EXPECT_NO_THROW(states.append(std::vector<float>{1.0f + 5.0f / 8192.0f, 3.0f, 0.3f}, {}));
}

/// Rows that enter in some frame, in the first, within one block and beyond it, or never.
constexpr std::uint32_t kEnters[] = {0, 5, 63, 64, 65, 199, 200, std::numeric_limits<std::uint32_t>::max()};

/// As far as is known up to a frame.
std::vector<std::uint32_t> knownIn(std::uint32_t frame) {
    std::vector<std::uint32_t> known(std::begin(kEnters), std::end(kEnters));
    for (std::uint32_t& first : known)
        if (first > frame) first = std::numeric_limits<std::uint32_t>::max();
    return known;
}

/// -999 where nobody is yet.
std::vector<float> entering(std::uint32_t frame) {
    std::vector<float> values = walkers(std::size(kEnters), frame);
    for (std::uint32_t row = 0; row < std::size(kEnters); ++row)
        if (frame < kEnters[row]) std::fill_n(values.begin() + row * kComponents, kComponents, -999.0f);
    return values;
}

/// As StreamWriter fills it in.
void expectFilledIn(const std::filesystem::path& path, const StreamInfo& info, std::uint32_t frames) {
    const StreamReader reader(path);
    std::vector<float> read(std::size(kEnters) * kComponents);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        reader.readFrame(frame, read);
        for (std::uint32_t row = 0; row < std::size(kEnters); ++row) {
            const std::uint32_t first = kEnters[row];
            const bool is_early = frame < first && first < frames;
            for (std::size_t i = 0; i < kComponents; ++i) {
                const BackFill rule = info.components[i].before_entry;
                const bool is_first = is_early && rule == BackFill::first_alive;
                const float shown = entering(is_first ? first : frame)[row * kComponents + i];
                ASSERT_NEAR(read[row * kComponents + i], is_early && rule == BackFill::zero ? 0.0f : shown,
                            info.components[i].step)
                    << info.name << " row " << row << " frame " << frame;
            }
        }
    }
}

TEST(PackedWriter, FillsInWhatRowsHoldBeforeTheyEnter) {
    for (const Stream stream : {Stream::pos, Stream::dir, Stream::wish}) {
        const StreamInfo& info = infoOf(stream);
        const TemporaryFolder folder;
        PackedWriter writer(folder / "stream", info, std::size(kEnters));
        for (std::uint32_t frame = 0; frame < 200; ++frame)
            writer.append(entering(frame), knownIn(frame));
        writer.backFill(kEnters);
        writer.finish();
        expectFilledIn(folder / "stream", info, 200);
    }
}

TEST(PackedWriter, GoesOnFromAnyFrameToTheSameBytes) {
    const TemporaryFolder folder;
    const auto writeFrom = [](PackedWriter& writer, std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t frame = begin; frame < end; ++frame)
            writer.append(entering(frame), knownIn(frame));
    };
    const auto end = [](PackedWriter& writer) {
        writer.backFill(kEnters);
        writer.finish();
    };
    PackedWriter whole(folder / "whole", kPlaces, std::size(kEnters));
    writeFrom(whole, 0, 200);
    end(whole);
    for (const std::uint32_t stop : {0u, 1u, 63u, 64u, 66u, 128u, 199u, 200u}) {
        const std::filesystem::path path = folder / std::to_string(stop);
        std::vector<std::byte> state;
        {
            PackedWriter first(path, kPlaces, std::size(kEnters));
            writeFrom(first, 0, stop);
            state = first.state();
            writeFrom(first, stop, 200);  // what a killed run wrote after its checkpoint
        }
        PackedWriter second(path, kPlaces, std::size(kEnters), state);
        writeFrom(second, stop, 200);
        end(second);
        EXPECT_EQ(contentOf(path), contentOf(folder / "whole")) << stop;
        if (stop < 64) continue;
        std::string changed = contentOf(path);
        changed[40] ^= 1;
        std::filesystem::remove(path);
        writeFile(path, changed);
        EXPECT_THROW(PackedWriter(path, kPlaces, std::size(kEnters), state), InputError);
    }
}

TEST(PackedWriter, RejectsStatesThatAreNone) {
    const TemporaryFolder folder;
    PackedWriter writer(folder / "stream", kPlaces, 3);
    for (std::uint32_t frame = 0; frame < 70; ++frame)
        writer.append(walkers(3, frame), {});
    const std::vector<std::byte> state = writer.state();
    for (std::size_t length = 0; length < state.size(); ++length)
        EXPECT_ANY_THROW(PackedWriter(folder / "stream", kPlaces, 3, std::span(state).first(length)))
            << length;
    EXPECT_ANY_THROW(PackedWriter(folder / "stream", kPlaces, 5, state));
    EXPECT_NO_THROW(PackedWriter(folder / "stream", kPlaces, 3, state));
}

/// All that reading it says, or nothing.
std::string problemOf(const std::filesystem::path& path) try {
    const StreamReader reader(path);
    std::vector<float> values(std::size_t{reader.rows()} * kComponents);
    for (std::uint32_t frame = 0; frame < reader.frames(); ++frame)
        reader.readFrame(frame, values);
    return "";
} catch (const InputError& error) {
    return error.reason();
}

std::vector<float> allOf(const std::filesystem::path& path) {
    const StreamReader reader(path);
    std::vector<float> all(std::size_t{reader.rows()} * reader.frames() * kComponents);
    for (std::uint32_t frame = 0; frame < reader.frames(); ++frame)
        reader.readFrame(frame, std::span(all).subspan(std::size_t{frame} * reader.rows() * kComponents,
                                                       std::size_t{reader.rows()} * kComponents));
    return all;
}

/// But for the few bits that Zstandard has no use for, which `throng verify` knows of, too.
TEST(PackedReader, EveryTruncationIsAnErrorAndNoFlipChangesAnything) {
    const TemporaryFolder folder;
    write(folder / "good", 3, 70);
    const std::string whole = contentOf(folder / "good");
    ASSERT_EQ(problemOf(folder / "good"), "");
    for (std::size_t length = 0; length < whole.size(); ++length) {
        writeFile(folder / "short", whole.substr(0, length));
        EXPECT_NE(problemOf(folder / "short"), "") << length;
        std::filesystem::remove(folder / "short");
    }
    std::size_t harmless = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string flipped = whole;
        flipped[at] ^= static_cast<char>(1 << (at % 8));
        writeFile(folder / "flipped", flipped);
        if (problemOf(folder / "flipped").empty()) {
            ++harmless;
            EXPECT_EQ(allOf(folder / "flipped"), allOf(folder / "good")) << at;
        }
        std::filesystem::remove(folder / "flipped");
    }
    EXPECT_LT(harmless, whole.size() / 20);
}

/// The same file with another directory, with the checksum that fits it.
void putDirectory(const std::filesystem::path& path, const std::string& whole,
                  const std::function<void(std::string&)>& change) {
    PackedTail tail;
    std::memcpy(&tail, whole.data() + whole.size() - sizeof tail, sizeof tail);
    std::string directory = whole.substr(tail.directory, tail.bytes);
    change(directory);
    tail.bytes = directory.size();
    Hasher hash;
    hash.add(std::as_bytes(std::span(directory)));
    tail.xxh3 = hash.digest();
    std::string made = whole.substr(0, tail.directory) + directory;
    made.append(reinterpret_cast<const char*>(&tail), sizeof tail);
    std::filesystem::remove(path);
    writeFile(path, made);
}

TEST(PackedReader, CountsThatTheFileCannotHoldAreErrorsBeforeAnythingIsMadeOfThem) {
    const TemporaryFolder folder;
    write(folder / "good", 3, 70);
    const std::string whole = contentOf(folder / "good");
    const auto put = [](std::size_t offset, auto value) {
        return [=](std::string& directory) { std::memcpy(directory.data() + offset, &value, sizeof value); };
    };
    const std::size_t frames = offsetof(PackedHead, frames), rows = offsetof(PackedHead, rows);
    const std::size_t step = offsetof(PackedHead, component);
    for (const auto& change : std::vector<std::function<void(std::string&)>>{
             put(0, 2u),
             put(frames, 0xffffffffu),
             put(frames, 0u),
             put(frames, 200u),
             put(rows, 0xffffffffu),
             put(rows, 1000u),
             put(rows, 0u),
             put(offsetof(PackedHead, block_frames), 0u),
             put(offsetof(PackedHead, block_frames), 0x80000000u),
             put(offsetof(PackedHead, block_rows), 0u),
             put(offsetof(PackedHead, block_rows), 0xffffffffu),
             put(offsetof(PackedHead, components), 4u),
             put(step, 0.0),
             put(step, 0.3),
             put(step, -0.5),
             put(step, std::numeric_limits<double>::quiet_NaN()),
             put(step, std::numeric_limits<double>::infinity()),
             put(step, 0x1p-60),
             put(step + 8, 3u),
             put(sizeof(PackedHead), 0xffffffffu),
             put(sizeof(PackedHead), 1u),
             [](std::string& directory) { directory.pop_back(); },
             [](std::string& directory) { directory += "1234"; },
             [](std::string& directory) { directory.resize(sizeof(PackedHead)); }}) {
        putDirectory(folder / "bad", whole, change);
        EXPECT_NE(problemOf(folder / "bad"), "");
    }
    putDirectory(folder / "same", whole, [](std::string&) {});
    EXPECT_EQ(problemOf(folder / "same"), "");
    // Both fit, and what the blocks hold does not.
    putDirectory(folder / "other", whole, put(offsetof(PackedHead, block_rows), 2048u));
    EXPECT_EQ(problemOf(folder / "other"), "");
    putDirectory(folder / "other", whole, put(frames, 69u));
    EXPECT_NE(problemOf(folder / "other").find("is damaged"), std::string::npos);
}

}  // namespace
}  // namespace throng::io
