// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

#include "authoring/cli/bake_description.h"
#include "authoring/cli/bake_run.h"
#include "authoring/cli/calibration_file.h"
#include "authoring/cli/commands.h"
#include "authoring/cli/exit_codes.h"
#include "authoring/cli/interrupt.h"
#include "authoring/cli/progress.h"
#include "io/bake_info.h"
#include "io/bake_writer.h"
#include "sim/frame_pump.h"
#include "sim/gl/context.h"

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

/// --method and --proximity are short for --set; what is set by hand wins.
std::vector<std::string> overridesOf(const BakeRequest& options) {
    std::vector<std::string> overrides;
    if (!options.method.empty()) overrides.push_back("simulation.method=" + options.method);
    if (!options.proximity.empty()) overrides.push_back("simulation.proximity=" + options.proximity);
    overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
    return overrides;
}

/// The simulation proper. @returns the signal that stopped it early, or 0
int runFrames(sim::Simulation& simulation, const authoring::SimulationSettings& settings,
              io::BakeWriter& writer, std::uint32_t frames, std::uint32_t diagram_every,
              const sim::FramePump::Cargo& cargo, Progress& progress) {
    InterruptGuard interrupt;
    std::atomic<std::uint32_t> present{0};
    sim::FramePump pump(simulation, cargo, [&](const Frame& frame) {
        std::uint32_t alive = 0;
        for (std::size_t row = 0; row < frame.states.size(); row += 3)
            alive += frame.states[row] > 0.5f;
        present = alive;
        writer.write(frame);
    });
    const auto substeps = static_cast<std::uint32_t>(settings.substeps);
    const std::uint32_t warmup = sim::warmupSteps(settings);
    for (std::uint32_t step = 0; step < warmup && !interrupt.signal(); ++step) {
        simulation.step();
        if (step % substeps == 0) {
            simulation.wait();
            progress.update(0, 0, simulation.stepsDone());
        }
    }
    for (std::uint32_t frame = 0; frame < frames && !interrupt.signal(); ++frame) {
        if (frame > 0)
            for (std::uint32_t step = 0; step < substeps; ++step)
                simulation.step();
        pump.submit(frame, diagram_every > 0 && frame % diagram_every == 0);
        simulation.adaptTo(present);
        progress.update(frame + 1, present, simulation.stepsDone());
    }
    pump.finish();
    progress.update(writer.framesWritten(), present, warmup + frames * substeps);
    return writer.framesWritten() < frames ? interrupt.signal() : 0;
}

void printResult(const io::BakeResult& result, const Account& account, const io::BakeTiming& timing,
                 bool as_json) {
    if (as_json) {
        fmt::print("{}\n", io::infoJson(io::loadBake(result.path)).dump(2));
        return;
    }
    fmt::print("{}: {} frames, {} people: {} arrived, {} still walking, {} refused\n", result.path.string(),
               result.frames, account.agents.size(), account.arrived, account.walking, account.refused);
    fmt::print("{} steps in {:.1f} s, {:.0f} steps/s\n", timing.steps, timing.wall_seconds,
               static_cast<double>(timing.steps) / std::max(timing.wall_seconds, 1.0e-9));
    for (const auto& [reason, count] : refusals(account))
        fmt::print("refused: {} people: {}\n", count, reason);
    if (result.gltf && result.gltf->agents < result.gltf->of)
        fmt::print(
            "crowd.glb holds {} of {} people, evenly chosen (--gltf-agents raises the limit; the streams "
            "hold all)\n",
            result.gltf->agents, result.gltf->of);
    if (result.diagrams) fmt::print("{} diagram images\n", result.diagrams);
}

}  // namespace

void bakeLayout(const BakeRequest& options) {
    const LoadedLayout loaded = loadLayout(options.layout, overridesOf(options));
    const authoring::SimulationSettings& settings = loaded.scene.settings;
    const std::uint32_t diagram_every = diagramInterval(options.diagrams);

    const gl::Context context({options.device, false});
    io::BakeDescription description = describeBake(loaded, options.bake, context.device());
    description.diagram_every = diagram_every;
    description.densities = options.densities;
    const std::uint32_t frames = description.frames;
    io::BakeWriter writer(std::move(description));
    const gl::ShaderLibrary shaders =
        options.shader_dir.empty() ? gl::ShaderLibrary() : gl::ShaderLibrary(options.shader_dir);
    sim::Simulation simulation(loaded.scene, shaders, costsFor(context.device()));
    context.check("setting up the simulation");

    const auto style = options.quiet  ? Progress::Style::quiet
                       : options.json ? Progress::Style::json
                                      : Progress::detectStyle();
    const auto start = std::chrono::steady_clock::now();
    int signal = 0;
    {
        Progress progress(style, frames, sim::warmupSteps(settings),
                          static_cast<std::uint32_t>(settings.substeps));
        signal = runFrames(simulation, settings, writer, frames, diagram_every,
                           {diagram_every > 0, options.seconds, options.densities}, progress);
    }
    context.check("simulating");
    io::BakeTiming timing;
    timing.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    timing.steps = simulation.stepsDone();

    const Account account = simulation.account();
    if (signal) {
        if (writer.framesWritten() == 0) {
            fmt::print(stderr, "throng: stopped before the first frame; nothing was written\n");
            throw Exit(128 + signal);
        }
        const io::BakeResult result = writer.finishPartial(account, timing);
        fmt::print(stderr, "throng: stopped after frame {} of {}; what there is is in {}\n", result.frames,
                   frames, result.path.string());
        throw Exit(128 + signal);
    }
    const io::BakeResult result = writer.finish(account, timing);
    if (options.announce) printResult(result, account, timing, options.json);
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
    command->add_flag(
        "--density", options->densities,
        "Also the stream `density`: persons per square metre by the area of each person's cell");
    command->add_option("--method", options->method,
                        "How the diagram is built: auto, " + methodWords() + " (as simulation.method)");
    command->add_option("--proximity", options->proximity,
                        "What finds neighbours: voronoi, grid or brute (as simulation.proximity)");
    command->add_flag("!--no-gltf", options->bake.gltf, "Write no crowd.glb");
    command->add_option("--gltf-agents", options->bake.gltf_agents, "At most this many people in crowd.glb")
        ->capture_default_str();
    command->add_option("--device", options->device, "Run on this device (`throng devices` lists them)");
    command
        ->add_option("--shader-dir", options->shader_dir,
                     "Take shaders from this copy of shaders/ (for editing them live)")
        ->check(CLI::ExistingDirectory);
    command->add_flag("--json", options->json,
                      "Progress as JSON lines on stderr, the result as a JSON document on stdout");
    command->add_flag("-q,--quiet", options->quiet, "No progress");
    command->footer(
        "Ctrl-C stops after the frame under way and keeps what there is as OUTPUT.partial.\n\n"
        "Example:\n  throng bake examples/intersection.json -o bakes/intersection --diagrams 24 --set "
        "simulation.seed=7");
    command->callback([options] { bakeLayout(*options); });
}

}  // namespace throng::cli
