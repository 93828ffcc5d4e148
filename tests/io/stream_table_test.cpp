// SPDX-License-Identifier: Apache-2.0
// Every stream of the table, wherever streams go: a part of the program that forgets one fails here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "applied_crowd.h"
#include "io/crowd_reader.h"
#include "io/verify_bake.h"
#include "recording/motion_recorder.h"
#include "sample_crowd.h"

namespace throng::io {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using test::SampleCrowd;
using test::TemporaryFolder;

const fs::path kSource = THRONG_SOURCE;

test::SampleOptions everyStream(std::uint32_t rows, const std::string& formats) {
    test::SampleOptions options;
    options.formats = readFormats(formats).formats;
    options.rows = rows;
    options.frames = 24;
    options.every_stream = true;
    options.gltf = false;
    return options;
}

TEST(StreamTable, TellsEachStreamOnceAndWhole) {
    std::set<std::string_view> names;
    for (const StreamInfo& info : kStreams) {
        EXPECT_TRUE(!info.name.empty() && names.insert(info.name).second) << info.name;
        EXPECT_NE(info.about, "") << info.name;
        std::set<std::string_view> components;
        for (const StreamComponent& component : info.components) {
            EXPECT_TRUE(!component.name.empty() && components.insert(component.name).second) << info.name;
            EXPECT_NE(component.unit, "") << info.name;
        }
        if (info.source == StreamSource::device)
            EXPECT_TRUE(fs::is_regular_file(kSource / info.shader)) << info.name;
        else
            EXPECT_TRUE(info.shader.empty() && !info.needs_diagram) << info.name;
    }
}

/// One entry for all components where they agree.
template <class Text>
std::string listOf(const StreamInfo& info, Text text) {
    std::string list;
    bool agree = true;
    for (const StreamComponent& component : info.components) {
        list += (list.empty() ? "" : ", ") + text(component);
        agree = agree && text(component) == text(info.components[0]);
    }
    return agree ? text(info.components[0]) : list;
}

TEST(StreamTable, IsTheOneInTheDocs) {
    const std::string docs = contentOf(kSource / "docs" / "bake.md");
    for (const StreamInfo& info : kStreams) {
        const std::string line = fmt::format(
            "| `{}` | {} | {} | {} | {} | {} |", info.name, info.about,
            listOf(info, [](const auto& each) { return fmt::format("`{}`", each.name); }),
            listOf(info, [](const auto& each) { return std::string(each.unit); }),
            listOf(info,
                   [](const auto& each) {
                       return std::string(each.between == Between::nearest  ? "nearest"
                                          : each.between == Between::linear ? "linear"
                                                                            : "heading");
                   }),
            listOf(info, [](const auto& each) {
                return std::string(each.before_entry == BackFill::first_alive ? "its first" : "0");
            }));
        EXPECT_NE(docs.find(line + " "), std::string::npos) << "docs/bake.md should have the line\n" << line;
        if (isAskedFor(info)) {
            EXPECT_NE(docs.find(fmt::format("`--{}`", info.asksFor())), std::string::npos) << info.name;
        }
    }
}

TEST(StreamTable, HashesOfInputsAreThoseOfEarlierBakes) {
    StreamChoice asked;
    EXPECT_EQ(identityOf(asked), "false");
    asked[Stream::density] = true;
    EXPECT_EQ(identityOf(asked), "true");
}

class EveryStream : public testing::TestWithParam<std::tuple<std::uint32_t, std::string>> {
  protected:
    EveryStream() : crowd(everyStream(rows(), std::get<1>(GetParam()))) { crowd.bake(folder / "bake"); }
    static std::uint32_t rows() { return std::get<0>(GetParam()); }

    /// What the table says that a file holds.
    float expected(const StreamInfo& info, std::uint32_t row, std::uint32_t frame, std::size_t i) const {
        const bool is_early = !crowd.isRefused(row) && frame < crowd.spawnFrame(row);
        const BackFill rule = info.components[i].before_entry;
        const std::uint32_t shown = is_early && rule == BackFill::first_alive ? crowd.spawnFrame(row) : frame;
        if (info.source == StreamSource::terrain && crowd.isRefused(row))
            return crowd.extra(info, row, frame, i);
        return is_early && rule == BackFill::zero ? 0.0f : crowd.extra(info, row, shown, i);
    }

    TemporaryFolder folder;
    SampleCrowd crowd;
};

TEST_P(EveryStream, IsInTheFilesAndTheManifest) {
    const Bake bake = loadBake(folder / "bake");
    EXPECT_TRUE(verifyBake(folder / "bake").isWhole());
    for (const StreamInfo& info : kStreams) {
        EXPECT_TRUE(bake.streams[info.id]) << info.name;
        const auto& told = bake.manifest["streams"][std::string(info.name)];
        for (std::size_t i = 0; i < kComponents; ++i) {
            EXPECT_EQ(told["components"].at(i).get<std::string>(), info.components[i].name);
            EXPECT_EQ(told["units"].at(i).get<std::string>(), info.components[i].unit);
            EXPECT_NE(told["interpolation"].at(i), "");
        }
        for (const StreamFormatInfo& each : kStreamFormats) {
            const StreamFormat format = each.id;
            if (!bake.formats.has(format)) continue;
            EXPECT_EQ(told[std::string(each.name)], streamFile(info, format));
            const std::filesystem::path file = folder / "bake" / streamFile(info, format);
            std::filesystem::rename(file, folder / "elsewhere");
            const auto problems = verifyBake(folder / "bake").problems;
            std::filesystem::rename(folder / "elsewhere", file);
            ASSERT_EQ(problems.size(), 1u);
            EXPECT_EQ(problems[0].path, streamFile(info, format));
            EXPECT_EQ(problems[0].kind, BakeProblem::Kind::missing);
        }
        if (!bake.formats.has(StreamFormat::npy) || !bake.formats.has(StreamFormat::pc2)) continue;
        const std::string npy = contentOf(bake.streamPath(info.id));
        const std::string pc2 = contentOf(bake.streamPath(info.id, StreamFormat::pc2));
        EXPECT_TRUE(npy.substr(headerSize(StreamFormat::npy)) == pc2.substr(headerSize(StreamFormat::pc2)))
            << info.name;
    }
}

TEST_P(EveryStream, ComesBackAsTheTableSays) {
    CrowdReader reader(loadBake(folder / "bake"));
    for (std::uint32_t frame = 0; frame < reader.frames(); ++frame)
        for (const StreamInfo& info : kStreams) {
            if (info.source == StreamSource::motion) continue;
            const CrowdFrame held = reader.frame(frame);
            for (std::uint32_t row = 0; row < reader.rows(); ++row)
                for (std::size_t i = 0; i < kComponents; ++i)
                    ASSERT_EQ(rowOf(held[info.id], row)[i], expected(info, row, frame, i))
                        << info.name << " frame " << frame << " row " << row;
        }
}

TEST_P(EveryStream, GoesThroughApplyAndWhoHidesIsGoneFromIt) {
    CrowdReader source(loadBake(folder / "bake"));
    ApplyOptions options;
    options.output = folder / "applied";
    authoring::PersonChange hide;
    hide.hide = true;
    ASSERT_TRUE(test::applyOverrides(source, std::vector<RowChange>{{0, hide}}, options));
    CrowdReader made(loadBake(options.output));
    EXPECT_TRUE(verifyBake(options.output).isWhole());
    for (std::uint32_t frame = 0; frame < source.frames(); ++frame)
        for (const StreamInfo& info : kStreams)
            for (std::uint32_t row = 0; row < source.rows(); ++row)
                for (std::size_t i = 0; i < kComponents; ++i) {
                    const bool is_gone = row == 0 && info.components[i].before_entry == BackFill::keep;
                    ASSERT_EQ(rowOf(made.frame(frame)[info.id], row)[i],
                              is_gone ? 0.0f : rowOf(source.frame(frame)[info.id], row)[i])
                        << info.name;
                }
}

TEST_P(EveryStream, FromTheDeviceIsRecordedAsItIs) {
    recording::BakeDescription description = crowd.description(folder / "recorded");
    description.smoothing = 0.25;
    std::uint32_t seen = 0;
    const auto sink = [&](const Frame& frame) {
        ASSERT_EQ(frame.index, seen++);
        for (const StreamInfo& info : kStreams) {
            ASSERT_EQ(frame[info.id].size(), rows() * kComponents) << info.name;
            std::size_t changed = 0;
            for (std::uint32_t row = 0; info.source == StreamSource::device && row < rows(); ++row) {
                const auto recorded = rowOf(frame[info.id], row);
                for (std::size_t i = 0; i < kComponents; ++i)
                    changed += recorded[i] != crowd.extra(info, row, frame.index, i);
            }
            ASSERT_EQ(changed, 0u) << info.name;
        }
    };
    auto recorder = std::make_unique<recording::MotionRecorder>(description, sink);
    crowd.makeFrames(description.frames, [&](const Frame& frame) {
        recorder->take(frame);
        if (frame.index != 12) return;
        const std::vector<std::byte> checkpoint = recorder->save();
        recorder = std::make_unique<recording::MotionRecorder>(description, sink);
        recorder->restore(checkpoint);
        recording::BakeDescription other = description;
        other.asked = {};
        EXPECT_THROW(recording::MotionRecorder(other, sink).restore(checkpoint), std::runtime_error);
    });
    recorder->finish();
    EXPECT_EQ(seen, description.frames);
}

INSTANTIATE_TEST_SUITE_P(OfSomePeople, EveryStream,
                         testing::Combine(testing::Values(1u, 63u, 1234u),
                                          testing::Values("npy,pc2", "packed", "pc2,packed")));

TEST(BakeWriter, RefusesAFrameThatLacksAStreamOfItsBake) {
    const TemporaryFolder folder;
    const SampleCrowd crowd(everyStream(5, "npy,pc2,packed"));
    for (const StreamInfo& info : kStreams) {
        BakeWriter writer(crowd.description(folder / std::string(info.name)));
        crowd.makeFrames(1, [&](Frame frame) {
            frame[info.id] = {};
            try {
                writer.write(frame);
                ADD_FAILURE() << "without " << info.name;
            } catch (const std::invalid_argument& error) {
                EXPECT_NE(std::string(error.what()).find(info.name), std::string::npos);
            }
        });
        EXPECT_EQ(writer.framesWritten(), 0u);
    }
}

}  // namespace
}  // namespace throng::io
