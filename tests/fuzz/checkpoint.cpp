// SPDX-License-Identifier: Apache-2.0
// Checkpoints, and the bake that goes on from one. An input is a whole file, or what belongs behind its
// header: most of what is changed by chance would otherwise be known by its checksum.
#include "io/checkpoint.h"

#include <cstring>
#include <stdexcept>

#include "base/files/hash.h"
#include "io/bake_folder.h"
#include "io/bake_writer.h"
#include "recording/motion_recorder.h"
#include "support/harness.h"
#include "tests/io/sample_crowd.h"

using namespace throng;

namespace {

constexpr std::string_view kMagic = "THRONGC1";

std::string sealed(std::string_view content) {
    Hasher hasher;
    hasher.add(std::as_bytes(std::span(content)));
    const std::uint64_t words[] = {content.size(), hasher.digest()};
    std::string file(kMagic);
    file.append(reinterpret_cast<const char*>(words), sizeof words);
    return file.append(content);
}

/// @param formats the forms of its streams
test::SampleCrowd crowdWith(const StreamFormats& formats) {
    test::SampleOptions options;
    options.rows = 6;
    options.frames = 8;
    options.gltf = false;
    options.diagram_every = 4;
    options.formats = formats;
    return test::SampleCrowd(options);
}

/// In the forms that a checkpoint tells of: it says more of packed streams.
const test::SampleCrowd& crowdOf(const io::Checkpoint& checkpoint) {
    static const test::SampleCrowd usual = crowdWith(StreamFormats::standard());
    static const test::SampleCrowd packed = crowdWith(readFormats("packed").formats);
    return checkpoint.find("packed pos") ? packed : usual;
}

/// What a bake has written when it leaves its checkpoint.
void leaveUnfinished(const test::SampleCrowd& crowd, const recording::BakeDescription& description) {
    std::filesystem::remove_all(io::BakeFolder::unfinishedPath(description.output));
    std::filesystem::remove_all(description.output);
    io::BakeWriter writer(description, nullptr);
    recording::MotionRecorder recorder(description, [&](const Frame& frame) { writer.write(frame); });
    crowd.makeFrames(5, [&](const Frame& frame) {
        writer.writeDiagram(frame);
        recorder.take(frame);
    });
    writer.save({});
}

void goOn(const test::SampleCrowd& crowd, const recording::BakeDescription& description,
          const io::Checkpoint& checkpoint) {
    io::BakeWriter writer(description, &checkpoint);
    recording::MotionRecorder recorder(description, [&](const Frame& frame) { writer.write(frame); });
    if (const auto* motion = checkpoint.find("motion")) recorder.restore(*motion);
    const std::uint32_t taken = recorder.framesTaken();
    crowd.makeFrames(description.frames, [&](const Frame& frame) {
        if (frame.index < taken) return;
        writer.writeDiagram(frame);
        recorder.take(frame);
    });
    recorder.finish();
    writer.finish(crowd.account(), {});
}

}  // namespace

void fuzz::readOne(std::string_view input) {
    const std::filesystem::path output = folder() / "bake";
    const std::filesystem::path unfinished = io::BakeFolder::unfinishedPath(output);
    std::filesystem::remove_all(unfinished);
    put(unfinished.filename() / "checkpoint.a",
        input.starts_with(kMagic) ? std::string(input) : sealed(input));
    const auto checkpoint = io::loadCheckpoint(unfinished);
    if (!checkpoint) return;
    const test::SampleCrowd& crowd = crowdOf(*checkpoint);
    const recording::BakeDescription description = crowd.description(output);
    leaveUnfinished(crowd, description);
    try {
        goOn(crowd, description, *checkpoint);
    } catch (const std::runtime_error&) {
        // One of another bake, in words.
    }
}
