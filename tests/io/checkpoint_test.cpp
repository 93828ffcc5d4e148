// SPDX-License-Identifier: Apache-2.0
#include "io/checkpoint.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/files/input_file.h"
#include "io/bake_folder.h"
#include "io/bake_writer.h"
#include "sample_crowd.h"

namespace throng::io {
namespace {
namespace fs = std::filesystem;
using test::contentOf;

class CheckpointTest : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::temp_directory_path() / ("throng-checkpoint-" + std::to_string(::getpid()));
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    static Checkpoint checkpointAt(std::uint32_t frames, std::size_t bytes = 1000) {
        Checkpoint checkpoint;
        checkpoint.identity = "this layout";
        checkpoint.frames = frames;
        checkpoint.steps = 2 * frames;
        std::vector<std::byte> content(bytes);
        for (std::size_t i = 0; i < bytes; ++i)
            content[i] = static_cast<std::byte>(i * 7 + frames);
        checkpoint.add("states", content);
        checkpoint.add("nothing", {});
        return checkpoint;
    }
    fs::path fileOf(std::uint32_t frames) const {
        for (const char* name : {"checkpoint.a", "checkpoint.b"}) {
            const fs::path other = folder / (std::string(name) + ".aside");
            if (!fs::exists(folder / name)) continue;
            fs::rename(folder / name, other);
            const auto left = loadCheckpoint(folder);
            fs::rename(other, folder / name);
            if (!left || left->frames != frames) return folder / name;
        }
        return {};
    }

    fs::path folder;
};

TEST_F(CheckpointTest, ComesBackAsItWas) {
    EXPECT_FALSE(loadCheckpoint(folder));
    const Checkpoint saved = checkpointAt(12, 100'003);
    saveCheckpoint(folder, saved);
    const auto loaded = loadCheckpoint(folder);
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->identity, saved.identity);
    EXPECT_EQ(loaded->frames, 12u);
    EXPECT_EQ(loaded->steps, 24u);
    EXPECT_EQ(loaded->sections, saved.sections);
    ASSERT_NE(loaded->find("states"), nullptr);
    EXPECT_EQ(loaded->find("else"), nullptr);
}

TEST_F(CheckpointTest, TheLatestOfTwoIsTakenAndOlderOnesAreReplaced) {
    for (std::uint32_t frames = 1; frames <= 9; ++frames) {
        saveCheckpoint(folder, checkpointAt(frames));
        EXPECT_EQ(loadCheckpoint(folder)->frames, frames);
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
}

TEST_F(CheckpointTest, CutAnywhereOrChangedAnywhereTheOneBeforeIsTaken) {
    saveCheckpoint(folder, checkpointAt(1, 64));
    saveCheckpoint(folder, checkpointAt(2, 64));
    const fs::path newest = fileOf(2);
    const std::string whole = readFile(newest);
    const auto replace = [&](const std::string& content) {
        std::ofstream(newest, std::ios::binary | std::ios::trunc) << content;
    };
    for (std::size_t length = 0; length < whole.size(); ++length) {
        replace(whole.substr(0, length));
        const auto loaded = loadCheckpoint(folder);
        ASSERT_TRUE(loaded) << length;
        EXPECT_EQ(loaded->frames, 1u) << "cut to " << length;
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 0x10);
        replace(changed);
        EXPECT_EQ(loadCheckpoint(folder)->frames, 1u) << "changed at " << at;
    }
    replace(whole);
    EXPECT_EQ(loadCheckpoint(folder)->frames, 2u);
}

TEST_F(CheckpointTest, ABakeGoesOnFromBeforeItsFirstFrame) {
    const test::SampleCrowd crowd({});
    crowd.bake(folder / "whole");
    const recording::BakeDescription description = crowd.description(folder / "bake");
    { BakeWriter(description, nullptr).save({}); }
    const auto checkpoint = loadCheckpoint(BakeFolder::unfinishedPath(description.output));
    ASSERT_TRUE(checkpoint);
    ASSERT_EQ(checkpoint->frames, 0u);

    BakeWriter writer(description, &*checkpoint);
    crowd.writeTo(writer, description.frames);
    writer.finish(crowd.account(), {});
    for (const char* name : {"pos.npy", "dir.npy", "state.npy", "pos.pc2"})
        EXPECT_EQ(contentOf(folder / "bake/streams" / name), contentOf(folder / "whole/streams" / name))
            << name;
}

TEST_F(CheckpointTest, OneThatCountsBeyondItsBakeIsRefused) {
    const test::SampleCrowd crowd({.diagram_every = 12});
    const recording::BakeDescription description = crowd.description(folder / "bake");
    {
        BakeWriter writer(description, nullptr);
        crowd.writeTo(writer, 20);
        writer.save({});
    }
    const auto saved = loadCheckpoint(BakeFolder::unfinishedPath(description.output));
    ASSERT_TRUE(saved);
    Checkpoint frames = *saved;
    frames.frames = description.frames + 1;
    EXPECT_THROW(BakeWriter(description, &frames), std::runtime_error);
    Checkpoint images = *saved;
    for (auto& [name, bytes] : images.sections)
        if (name == "diagrams") bytes.at(3) = std::byte{0xff};  // of their count
    EXPECT_THROW(BakeWriter(description, &images), std::runtime_error);
    EXPECT_NO_THROW(BakeWriter(description, &*saved)) << "nothing was lost";
}

TEST_F(CheckpointTest, ATornOneIsTheFirstToBeReplaced) {
    saveCheckpoint(folder, checkpointAt(1));
    saveCheckpoint(folder, checkpointAt(2));
    std::ofstream(fileOf(2), std::ios::binary | std::ios::trunc) << "torn";
    saveCheckpoint(folder, checkpointAt(3));
    EXPECT_EQ(loadCheckpoint(folder)->frames, 3u);
    std::ofstream(fileOf(3), std::ios::binary | std::ios::trunc) << "torn";
    EXPECT_EQ(loadCheckpoint(folder)->frames, 1u) << "the good one was kept all the time";
}

}  // namespace
}  // namespace throng::io
