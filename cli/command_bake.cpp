// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/outcomes.h"
#include "cli/bake_run.h"
#include "cli/baking/bake_description.h"
#include "cli/baking/baker.h"
#include "cli/baking/device_fields.h"
#include "cli/commands.h"
#include "cli/stream_option.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/say.h"
#include "io/bake_info.h"

namespace throng::cli {
namespace {

/// @returns frames between diagram images, 0 for none
std::uint32_t diagramInterval(const std::string& text) {
    if (text == "none") return 0;
    if (text == "all") return 1;
    std::uint32_t every = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), every);
    if (error == std::errc() && end == text.data() + text.size() && every > 0) return every;
    throw CLI::ValidationError("--diagrams",
                               fmt::format("expects all, none or a number of frames, not `{}`", text));
}

std::string methodWords() {
    std::string words;
    for (const authoring::DiagramMethodEntry& entry : authoring::kDiagramMethods)
        words += (words.empty() ? "" : ", ") + std::string(entry.word);
    return words;
}

FieldsBy fieldsBy(const std::string& word) {
    return word == "gpu" ? FieldsBy::device : word == "cpu" ? FieldsBy::cpu : FieldsBy::automatic;
}

/// --method and --proximity are short for --set; what is set by hand wins.
std::vector<std::string> overridesOf(const BakeRequest& options) {
    std::vector<std::string> overrides;
    if (!options.method.empty()) overrides.push_back("simulation.method=" + options.method);
    if (!options.proximity.empty()) overrides.push_back("simulation.proximity=" + options.proximity);
    overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
    return overrides;
}

void printResult(const io::BakeResult& result, const Account& account, const io::BakeTiming& timing,
                 bool as_json) {
    if (as_json) {
        sayJson(io::infoJson(io::loadBake(result.path)));
        return;
    }
    say(stdout, "{}: {} frames, {} people: {} {}, {} {}, {} {}\n", result.path.string(), result.frames,
        account.agents.size(), account.arrived, wordFor(Fate::arrived), account.walking,
        wordFor(Fate::walking), account.refused, wordFor(Fate::refused));
    say(stdout, "{} steps in {:.1f} s, {:.0f} steps/s\n", timing.steps, timing.wall_seconds,
        static_cast<double>(timing.steps) / std::max(timing.wall_seconds, 1.0e-9));
    for (const auto& [reason, count] : refusals(account))
        say(stdout, "refused: {} people: {}\n", count, reason);
    if (result.gltf && result.gltf->agents < result.gltf->of)
        say(stdout,
            "crowd.glb holds {} of {} people, evenly chosen (--gltf-agents raises the limit; the streams "
            "hold all)\n",
            result.gltf->agents, result.gltf->of);
    if (result.diagrams) say(stdout, "{} diagram images\n", result.diagrams);
}

/// A device that is lost takes nothing along that the last checkpoint has.
BakeRun bakeOrLeave(Baker& baker, LoadedLayout& loaded, const BakeJob& job,
                    const InterruptGuard& interrupt) try {
    return baker.bake(loaded, job, interrupt);
} catch (const gl::DeviceLost& error) {
    const auto unfinished = io::BakeFolder::unfinishedPath(outputOf(loaded, job.options));
    const std::optional<io::Checkpoint> checkpoint = io::loadCheckpoint(unfinished);
    if (!checkpoint) throw;
    say(stderr, "throng: {}; the first {} frames are kept, and the same command with --resume goes on\n",
        error.what(), checkpoint->frames);
    throw Exit(kCheckpointed);
}

/// An option for each name that asks for streams: `--density`, `--feet` (of both), ...
void addStreamOptions(CLI::App& command, StreamChoice& chosen) {
    for (const StreamInfo& first : kStreams) {
        const auto has_same = [&](const StreamInfo& info) {
            return isAskedFor(info) && info.asksFor() == first.asksFor();
        };
        if (!isAskedFor(first) || &*std::ranges::find_if(kStreams, has_same) != &first) continue;
        std::string what;
        for (const StreamInfo& info : kStreams)
            if (has_same(info))
                what += fmt::format("{}`{}`: {}", what.empty() ? "" : "; ", info.name, info.about);
        command.add_flag_callback(
            fmt::format("--{}", first.asksFor()),
            [&chosen, has_same] {
                for (const StreamInfo& info : kStreams)
                    chosen[info.id] = chosen[info.id] || has_same(info);
            },
            "Also the stream " + what);
    }
}

}  // namespace

void bakeLayout(const BakeRequest& options) {
    BakeJob job;
    job.options = options.bake;
    job.options.formats = formatsOf(options.formats);
    job.diagram_every = diagramInterval(options.diagrams);
    job.seconds = options.seconds;
    job.streams = options.streams;
    job.checkpoint_seconds = 60.0 * options.checkpoint_minutes;
    job.resume = options.resume;
    job.progress = progressStyle(options.quiet, options.json);
    // Farms say SIGTERM and come back; people at a terminal want to see what there is.
    job.when_stopped = [&](int signal, double) {
        return signal == SIGTERM && options.checkpoint_minutes > 0.0 ? WhenStopped::checkpoint
                                                                     : WhenStopped::keep_partial;
    };
    LoadedLayout loaded = loadLayout(options.layout, overridesOf(options), [&] {
        return makeDeviceFields(fieldsBy(options.fields), options.device, options.shader_dir);
    });
    Baker baker(options.device, options.shader_dir, loaded.scene.people.size());
    const InterruptGuard interrupt;
    const BakeRun run = bakeOrLeave(baker, loaded, job, interrupt);
    switch (run.end) {
        case BakeRun::End::complete:
            if (options.announce) printResult(run.result, run.account, run.timing, options.json);
            return;
        case BakeRun::End::was_complete:
            if (options.json)
                sayJson(io::infoJson(io::loadBake(outputOf(loaded, options.bake))));
            else if (options.announce)
                say(stdout, "{}: is complete already\n", outputOf(loaded, options.bake));
            return;
        case BakeRun::End::checkpointed:
            say(stderr, "throng: stopped after frame {}; the same command with --resume goes on\n",
                run.frames);
            throw Exit(kCheckpointed, "stopped with a checkpoint: the same command with --resume goes on");
        case BakeRun::End::partial:
            say(stderr, "throng: stopped after frame {}; what there is is in {}\n", run.frames,
                run.result.path.string());
            throw Exit(128 + run.signal, "stopped; what there is is in " + run.result.path.string());
        case BakeRun::End::discarded:
            say(stderr, "throng: stopped before the first frame; nothing was written\n");
            throw Exit(128 + run.signal, "stopped before the first frame; nothing was written");
    }
}

void addBake(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("bake", "Simulate a layout and write the crowd: streams, glTF, diagrams");
    auto options = std::make_shared<BakeRequest>();
    command->add_option("layout", options->layout, "The layout file (- for standard input)")->required();
    command->add_option("-o,--output", options->bake.output,
                        "The folder to make; by default the layout's name");
    command->add_flag("--force", options->bake.force, "Replace an existing bake");
    command
        ->add_option("--set", options->overrides,
                     "Override a value, e.g. --set simulation.seed=7 (repeatable)")
        ->take_all()
        ->expected(1);
    CLI::Option* diagrams = command
                                ->add_option("--diagrams", options->diagrams,
                                             "Diagram images as OpenEXR: all, none, or every N-th frame")
                                ->capture_default_str();
    command
        ->add_flag("--second", options->seconds,
                   "With --diagrams: also the second-nearest site of each pixel")
        ->needs(diagrams);
    addStreamOptions(*command, options->streams);
    addStreamsOption(*command, options->formats);
    command->add_option("--method", options->method,
                        "How the diagram is built: auto, " + methodWords() + " (as simulation.method)");
    command->add_option("--proximity", options->proximity,
                        "What finds neighbours: voronoi, grid or brute (as simulation.proximity)");
    command
        ->add_option(
            "--fields", options->fields,
            "What solves distance fields: cpu, gpu, or auto: the GPU unless that is a software renderer")
        ->check(CLI::IsMember({"auto", "cpu", "gpu"}));
    command->add_flag("!--no-gltf", options->bake.gltf, "Write no crowd.glb");
    command->add_option("--gltf-agents", options->bake.gltf_agents, "At most this many people in crowd.glb")
        ->capture_default_str();
    command
        ->add_option("--checkpoint", options->checkpoint_minutes,
                     "Minutes between checkpoints, from which --resume goes on; 0: none")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--resume", options->resume,
                      "Go on from the last checkpoint of a run that was stopped or killed, if there is one");
    command->add_option("--device", options->device, "Run on this device (`throng devices` lists them)");
    command
        ->add_option("--shader-dir", options->shader_dir,
                     "Take shaders from this copy of shaders/ (for editing them live)")
        ->check(CLI::ExistingDirectory);
    command->add_flag("--json", options->json,
                      "Progress as JSON lines on stderr, the result as a JSON document on stdout");
    command->add_flag("-q,--quiet", options->quiet, "No progress");
    command->footer(
        "Ctrl-C stops after the frame under way and keeps what there is as OUTPUT.partial. SIGTERM leaves a\n"
        "checkpoint in OUTPUT.unfinished and exits with 85: --resume goes on from there to the same "
        "bytes.\n\n"
        "Example:\n  throng bake examples/intersection.json -o bakes/intersection --diagrams 24 --set "
        "simulation.seed=7");
    command->callback([options] { bakeLayout(*options); });
}

}  // namespace throng::cli
