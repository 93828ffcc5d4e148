// SPDX-License-Identifier: Apache-2.0
// Writes a bake of a synthetic crowd without any simulation, for tests of what reads bakes:
//   write_sample_bake OUT [agents=64] [frames=48] [x=0] [y=0] [diagrams=0] [gltf=2000] [force=0]
//   [stop=FRAMES] [packed=0] [checkpoint=FRAMES]
// `diagrams` is the number of frames from one image to the next, `gltf` the most people in crowd.glb (-1: no
// file); with `stop` the bake ends early, as if it had been interrupted;
// with `packed` its streams are of that form only; with `checkpoint` it is left unfinished after so many
// frames, to be gone on with. Prints the path of the bake.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "io/bake_folder.h"
#include "io/checkpoint.h"
#include "recording/motion_recorder.h"
#include "sample_crowd.h"

namespace {

std::map<std::string, double> readArguments(int count, char** arguments) {
    std::map<std::string, double> values{{"agents", 64},  {"frames", 48},    {"x", 0},     {"y", 0},
                                         {"diagrams", 0}, {"gltf", 2000},    {"force", 0}, {"stop", -1},
                                         {"packed", 0},   {"checkpoint", -1}};
    for (int i = 2; i < count; ++i) {
        const std::string argument = arguments[i];
        const std::size_t equals = argument.find('=');
        if (equals == std::string::npos || !values.contains(argument.substr(0, equals)))
            throw std::invalid_argument("unknown argument " + argument);
        values[argument.substr(0, equals)] = std::stod(argument.substr(equals + 1));
    }
    return values;
}

/// As a run is that has to end now.
void leaveUnfinished(const throng::test::SampleCrowd& crowd, const std::filesystem::path& output,
                     std::uint32_t frames) {
    const throng::recording::BakeDescription description = crowd.description(output);
    throng::io::BakeWriter writer(description, nullptr);
    throng::recording::MotionRecorder recorder(description,
                                               [&](const throng::Frame& frame) { writer.write(frame); });
    crowd.makeFrames(frames, [&](const throng::Frame& frame) {
        writer.writeDiagram(frame);
        recorder.take(frame);
    });
    throng::io::Checkpoint checkpoint;
    checkpoint.add("motion", recorder.save());
    writer.save(std::move(checkpoint));
    fmt::print("{}\n", throng::io::BakeFolder::unfinishedPath(output).string());
}

}  // namespace

int main(int count, char** arguments) try {
    if (count < 2) throw std::invalid_argument("the first argument is the folder to make");
    auto values = readArguments(count, arguments);
    throng::test::SampleOptions options;
    options.rows = static_cast<std::uint32_t>(values["agents"]);
    options.frames = static_cast<std::uint32_t>(values["frames"]);
    options.origin = {values["x"], values["y"]};
    options.diagram_every = static_cast<std::uint32_t>(values["diagrams"]);
    options.gltf = values["gltf"] >= 0;
    options.gltf_agents = static_cast<std::uint32_t>(std::max(values["gltf"], 0.0));
    options.force = values["force"] != 0;
    if (values["packed"] != 0) options.formats = throng::readFormats("packed").formats;
    const throng::test::SampleCrowd crowd(options);

    if (values["checkpoint"] >= 0) {
        leaveUnfinished(crowd, arguments[1], static_cast<std::uint32_t>(values["checkpoint"]));
        return 0;
    }
    throng::io::BakeWriter writer(crowd.description(arguments[1]));
    const bool is_partial = values["stop"] >= 0;
    crowd.writeTo(writer, is_partial ? static_cast<std::uint32_t>(values["stop"]) : options.frames);
    const throng::io::BakeTiming timing{1.5, std::uint64_t{2} * writer.framesWritten()};
    const auto result =
        is_partial ? writer.finishPartial(crowd.account(), timing) : writer.finish(crowd.account(), timing);
    fmt::print("{}\n", result.path.string());
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "write_sample_bake: {}\n", error.what());
    return 1;
}
