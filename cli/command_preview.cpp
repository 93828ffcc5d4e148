// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "analysis/preview/preview.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace {

struct Options {
    std::string bake;
    std::string output;
    bool video = false;
    analysis::PreviewOptions preview;
    std::optional<std::uint32_t> frame;
};

void run(const Options& options) {
    const std::string bake = options.bake;
    const std::string output = !options.output.empty() ? options.output
                               : options.video         ? "preview.mp4"
                                                       : "preview.png";
    const bool video = options.video || output.ends_with(".mp4");
    analysis::PreviewOptions preview = options.preview;
    preview.frame = options.frame;
    if (!video) {
        const std::uint32_t frame = analysis::drawPreview(bake, output, preview);
        say(stdout, "{}: frame {}\n", output, frame);
        return;
    }
    const bool terminal = isatty(STDERR_FILENO);
    analysis::writePreviewVideo(bake, output, preview, [&](double share) {
        if (terminal) fmt::print(stderr, "\r{:3.0f} %\x1b[K", 100.0 * share);
    });
    if (terminal) fmt::print(stderr, "\n");
    say(stdout, "{}\n", output);
}

}  // namespace

void addPreview(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("preview", "Draw a bake from above: layout, people, trails, density (PNG or MP4)");
    auto options = std::make_shared<Options>();
    command->add_option("bake", options->bake, "A bake's folder, or its bake.json")->required();
    command->add_option("-o,--output", options->output,
                        "The picture; a name that ends in .mp4 makes a film (default preview.png)");
    command->add_flag("--mp4", options->video, "Make a film of all frames (needs ffmpeg)");
    command->add_option("--frame", options->frame,
                        "The frame to draw, from 0; by default the one with most people");
    command->add_option("--width", options->preview.width, "Width in pixels")
        ->check(CLI::Range(200, 8000))
        ->capture_default_str();
    command
        ->add_option("--trails", options->preview.trail_seconds,
                     "Length of the trails in seconds, 0 for none")
        ->check(CLI::Range(0.0, 600.0))
        ->capture_default_str();
    command->add_flag("!--no-density", options->preview.density, "Leave out the density layer");
    command->footer("Example:\n  throng preview bakes/intersection -o intersection.png --frame 800");
    command->callback([options] { run(*options); });
}

}  // namespace throng::cli
