// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/apply_overrides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>

#include "applied_crowd.h"
#include "io/agent_rows.h"
#include "io/overrides/agent_table_edit.h"
#include "io/overrides/row_sampler.h"
#include "io/streams/stream_reader.h"
#include "io/streams/stream_writer.h"
#include "io/verify_bake.h"

namespace throng::io {
namespace {

using authoring::PersonChange;
using test::applyOverrides;
using test::contentOf;
using test::SampleCrowd;
using test::TemporaryFolder;

/// A sample bake, and what becomes of it with changes.
struct Applied {
    explicit Applied(const std::vector<RowChange>& changes, test::SampleOptions options = {})
        : crowd(options) {
        crowd.bake(folder / "bake");
        source = loadBake(folder / "bake");
        ApplyOptions apply;
        apply.output = folder / "applied";
        apply.gltf = true;
        apply.applied = {{"overrides", "x"}};
        CrowdReader reader(source);
        result = applyOverrides(reader, changes, apply);
        made = loadBake(folder / "applied");
        problems = verifyBake(folder / "applied").problems;
    }
    static std::vector<float> frame(const Bake& bake, Stream stream, std::uint32_t index) {
        CrowdReader reader(bake);
        const CrowdFrame frame = reader.frame(index);
        return {frame[stream].begin(), frame[stream].end()};
    }
    std::vector<float> row(Stream stream, std::uint32_t index, std::uint32_t person) const {
        const std::vector<float> values = frame(made, stream, index);
        return {values.begin() + 3 * person, values.begin() + 3 * person + 3};
    }

    TemporaryFolder folder;
    SampleCrowd crowd;
    Bake source, made;
    std::optional<ApplyResult> result;
    std::vector<BakeProblem> problems;
};

TEST(ApplyOverrides, ChangesNobodyElse) {
    PersonChange hide;
    hide.hide = true;
    const Applied applied({{2, hide}});
    EXPECT_TRUE(applied.problems.empty());
    for (std::uint32_t frame = 0; frame < 48; ++frame)
        for (const Stream stream : {Stream::pos, Stream::dir, Stream::state}) {
            const auto before = applied.frame(applied.source, stream, frame);
            const auto after = applied.frame(applied.made, stream, frame);
            for (std::size_t i = 0; i < before.size(); ++i) {
                const bool hidden = i == 2 * 3 && stream == Stream::state;
                ASSERT_EQ(after[i], hidden ? 0.0f : before[i]) << infoOf(stream).name << " " << i;
            }
        }
    const auto rows = loadAgentRows(applied.made);
    EXPECT_EQ(rows[2].outcome, "refused");
    EXPECT_EQ(rows[2].spawn_frame, 0xffffffffu);
    EXPECT_EQ(rows[0].group, "eastbound");
    EXPECT_EQ(rows[1].group, "north, \"bound\"");
    EXPECT_EQ(applied.made.account.refused, applied.source.account.refused + 1);
    EXPECT_EQ(applied.made.account.walking + applied.made.account.arrived, applied.made.account.spawned);
    EXPECT_EQ(contentOf(applied.folder / "bake" / "layout.json"),
              contentOf(applied.folder / "applied" / "layout.json"));
}

TEST(ApplyOverrides, TurnsWaysAboutTheirEntryAndMovesThem) {
    PersonChange move;
    move.move = {5.0, -1.0, 0.5};
    move.turn = 90.0;
    const Applied applied({{9, move}});  // enters late
    const SampleCrowd& crowd = applied.crowd;
    const std::uint32_t spawn = crowd.spawnFrame(9);
    ASSERT_GT(spawn, 0u);
    const glm::dvec2 pivot = crowd.position(9, spawn);
    for (const std::uint32_t frame : {0u, spawn, spawn + 1, 47u}) {
        const glm::dvec2 arm = crowd.position(9, frame) - pivot;
        const auto position = applied.row(Stream::pos, frame, 9);
        EXPECT_NEAR(position[0], pivot.x - arm.y + 5.0, 1e-5);
        EXPECT_NEAR(position[1], pivot.y + arm.x - 1.0, 1e-5);
        EXPECT_NEAR(position[2], 0.5, 1e-6);
        const auto direction = applied.row(Stream::dir, frame, 9);
        const double heading = crowd.heading(9, frame) + 0.5 * std::numbers::pi;
        EXPECT_NEAR(direction[0], std::cos(heading), 1e-6);
        EXPECT_NEAR(direction[1], std::sin(heading), 1e-6);
    }
    const auto before = loadAgentRows(applied.source)[9], after = loadAgentRows(applied.made)[9];
    const glm::dvec2 arm = before.goal - pivot;
    EXPECT_NEAR(after.goal.x, pivot.x - arm.y + 5.0, 1e-4);
    EXPECT_NEAR(after.goal.y, pivot.y + arm.x - 1.0, 1e-4);
}

TEST(ApplyOverrides, RetimesFromTheEntryOn) {
    PersonChange retime;
    retime.delay = 4.0;
    retime.speed = 1.5;
    const Applied applied({{14, retime}});
    const SampleCrowd& crowd = applied.crowd;
    const std::uint32_t first = crowd.spawnFrame(14);
    ASSERT_EQ(first, 15u);
    for (std::uint32_t frame = 0; frame < 48; ++frame) {
        const double at = first + (frame - static_cast<double>(first) - 4.0) * 1.5;
        const auto low = static_cast<std::uint32_t>(std::clamp(std::floor(at), 0.0, 47.0));
        const auto high = std::min(low + 1, 47u);
        const double share = std::clamp(at, 0.0, 47.0) - low;
        const glm::dvec2 before = crowd.position(14, low), after = crowd.position(14, high);
        const glm::dvec2 expected = before + (after - before) * share;
        const auto position = applied.row(Stream::pos, frame, 14);
        EXPECT_NEAR(position[0], expected.x, 1e-5) << frame;
        EXPECT_NEAR(position[1], expected.y, 1e-5) << frame;
        const auto state = applied.row(Stream::state, frame, 14);
        EXPECT_EQ(state[0] > 0.5f, at >= first - 0.5) << frame;
        const double phase = std::lerp(crowd.phase(14, low), crowd.phase(14, high), share);
        EXPECT_NEAR(state[2], phase, 1e-5);
        const auto direction = applied.row(Stream::dir, frame, 14);
        const double heading = std::lerp(crowd.heading(14, low), crowd.heading(14, high), share);
        EXPECT_NEAR(std::atan2(direction[1], direction[0]), heading, 1e-5);
        const double speed = at < first - 1 || at > 47.0 ? 0.0 : 1.5 * (1.1 + 0.1 * (14 % 4));
        if (std::abs(at - first) > 1.0) {
            EXPECT_NEAR(direction[2], speed, 1e-5) << frame;
        }
    }
    EXPECT_EQ(loadAgentRows(applied.made)[14].spawn_frame, 19u);
    EXPECT_EQ(applied.result->held, 1u);  // 15 + (47 - 15 - 4) * 1.5 is past the last frame
}

TEST(ApplyOverrides, HeadingsGoTheShorterWayRound) {
    // Somebody who walks due west and sways: headings on both sides of pi.
    TemporaryFolder folder;
    std::filesystem::create_directory(folder / "streams");
    const auto write = [&](Stream stream, const std::vector<float>& values) {
        StreamWriter writer(folder / streamFile(infoOf(stream), StreamFormat::npy), StreamFormat::npy, 1, 2);
        writer.append(std::span(values).first(3));
        writer.append(std::span(values).last(3));
        writer.finish();
    };
    const auto c = static_cast<float>(std::cos(3.0)), s = static_cast<float>(std::sin(3.0));
    write(Stream::pos, {0, 0, 0, 1, 0, 0});
    write(Stream::dir, {c, s, 1, c, -s, 1});
    write(Stream::state, {1, 2, 0.5f, 2, 3, 1.5f});
    const StreamSet streams(folder.path(), streamsOf(false, {}), StreamFormats::standard(), 2, 1);
    const RowSampler sampler(streams);
    const auto at = [&](double frame, double pace) {
        return sampleBetween([&](std::uint32_t index) { return sampler.whole(0, index); }, 2, frame, pace);
    };
    EXPECT_NEAR(at(0.5, 1.0)[Stream::dir][0], -1.0, 1e-6);
    EXPECT_NEAR(at(0.25, 2.0)[Stream::dir][2], 2.0, 1e-6);
    EXPECT_EQ(at(0.49, 1.0)[Stream::state][0], 1.0f);
    EXPECT_EQ(at(0.5, 1.0)[Stream::state][1], 3.0f);
    EXPECT_FLOAT_EQ(at(0.25, 1.0)[Stream::state][2], 0.75f);
    EXPECT_EQ(at(-3.0, 1.0)[Stream::pos][0], 0.0f);
    EXPECT_EQ(at(7.0, 1.0)[Stream::dir][2], 0.0f);
}

TEST(ApplyOverrides, LooksGoIntoTheTableTheManifestAndTheGltf) {
    PersonChange look;
    look.character = 6;
    look.scale = 1.5;
    look.tint = authoring::Tint{"#a01020", {}, 0xa01020u};
    const Applied applied({{3, look}});
    const AgentTableEdit table(applied.made);
    EXPECT_EQ(table.at(3, "scale"), "1.5");
    EXPECT_EQ(table.at(3, "tint"), "#a01020");
    EXPECT_EQ(table.at(3, "variation"), "6");
    EXPECT_EQ(table.at(3, "overrides"), "character tint scale");
    EXPECT_EQ(table.at(2, "scale"), "1");
    EXPECT_EQ(applied.row(Stream::state, 0, 3)[1], 6.0f);
    EXPECT_EQ(applied.made.manifest["variations"], 7);
    EXPECT_EQ(applied.made.manifest["applied"]["overrides"], "x");
    std::ifstream file(applied.folder / "applied" / "crowd.glb", std::ios::binary);
    const std::string glb(std::istreambuf_iterator<char>(file), {});
    std::uint32_t bytes = 0;
    std::memcpy(&bytes, glb.data() + 12, sizeof bytes);
    const auto document = nlohmann::json::parse(glb.substr(20, bytes));
    for (const auto& node : document["nodes"]) {
        if (node["name"] != "person 3" && node["name"] != "person 2") continue;
        const bool changed = node["name"] == "person 3";
        EXPECT_NEAR(node["scale"][1], changed ? 1.5 : 1.0, 1e-6);
        const std::string body = document["meshes"][node["mesh"].get<std::size_t>()]["name"];
        EXPECT_EQ(body, changed ? "#a01020" : "eastbound");
    }
}

TEST(ApplyOverrides, WhatStopsItLeavesNothingBehind) {
    TemporaryFolder folder;
    SampleCrowd({}).bake(folder / "bake");
    const Bake source = loadBake(folder / "bake");
    ApplyOptions apply;
    apply.output = folder / "applied";
    apply.go_on = [](std::uint32_t frames) { return frames < 5; };
    CrowdReader whole(source);
    EXPECT_FALSE(applyOverrides(whole, {}, apply));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"bake"});
    std::filesystem::resize_file(source.streamPath(Stream::dir), 4000);
    apply.go_on = [](std::uint32_t) { return true; };
    CrowdReader truncated(source);
    EXPECT_THROW(applyOverrides(truncated, {}, apply), InputError);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"bake"});
}

TEST(ApplyOverrides, EntrantsAreWhereTheBakeSaysTheyEnter) {
    TemporaryFolder folder;
    test::SampleOptions options;
    options.origin = {500000.0, 5600000.0};
    const SampleCrowd crowd(options);
    crowd.bake(folder / "bake");
    const auto people = loadEntrants(CrowdReader(loadBake(folder / "bake")));
    ASSERT_EQ(people.size(), 64u);
    EXPECT_EQ(people[14].frame, 15u);
    EXPECT_EQ(people[14].group, "eastbound");
    EXPECT_FALSE(people[63].enters);
    EXPECT_NEAR(people[14].place.x, 500000.0 + crowd.position(14, 15).x, 1e-5);
    EXPECT_NEAR(people[14].place.y, 5600000.0 + crowd.position(14, 15).y, 1e-5);
}

}  // namespace
}  // namespace throng::io
