// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "analysis/preview/preview.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace {

struct PreviewOptions {
    std::string bake;
    std::string output;
    bool video = false;
    bool json = false;
    std::optional<int> width;
    analysis::PreviewOptions preview;
    std::optional<std::uint32_t> frame;
};

/// Whether a name's ending asks for a film; other endings than the two that there are would lie.
bool isFilm(const std::string& output, bool film_asked) {
    std::string ending = std::filesystem::path(output).extension().string();
    std::ranges::transform(ending, ending.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    const bool picture = ending == ".png", film = ending == ".mp4";
    if (!picture && !film)
        throw CLI::ValidationError(
            "--output", fmt::format("`{}` has to end in .png (a picture) or .mp4 (a film)", output));
    if (picture && film_asked)
        throw CLI::ValidationError("--output",
                                   fmt::format("--mp4 makes a film: `{}` has to end in .mp4", output));
    return film;
}

void runPreview(const PreviewOptions& options) {
    const std::string bake = options.bake;
    const std::string output = !options.output.empty() ? options.output
                               : options.video         ? "preview.mp4"
                                                       : "preview.png";
    analysis::PreviewOptions preview = options.preview;
    preview.frame = options.frame;
    if (options.width) preview.width = *options.width;
    if (!isFilm(output, options.video)) {
        const std::uint32_t frame = analysis::drawPreview(bake, output, preview);
        if (options.json)
            sayJson({{"output", output}, {"frame", frame}});
        else
            say(stdout, "{}: frame {}\n", output, frame);
        return;
    }
    const bool terminal = isatty(STDERR_FILENO);
    constexpr int kFilmHeight = 1080;  // px
    if (!options.width) preview.height = kFilmHeight;
    analysis::writePreviewVideo(bake, output, preview, [&](double share) {
        if (terminal) fmt::print(stderr, "\r{:3.0f} %\x1b[K", 100.0 * share);
    });
    if (terminal) fmt::print(stderr, "\n");
    if (options.json)
        sayJson({{"output", output}});
    else
        say(stdout, "{}\n", output);
}

}  // namespace

void addPreview(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("preview", "Draw a bake from above: layout, people, trails, density (PNG or MP4)");
    auto options = std::make_shared<PreviewOptions>();
    command->add_option("bake", options->bake, "A bake's folder, or its bake.json")->required();
    command->add_option("-o,--output", options->output,
                        "The picture: NAME.png, or NAME.mp4 for a film (default preview.png)");
    command->add_flag("--mp4", options->video, "Make a film of all frames (needs ffmpeg)");
    command->add_option("--frame", options->frame,
                        "The frame to draw, from 0; by default the one with most people");
    command
        ->add_option("--width", options->width,
                     "Width in pixels; by default 1400, and of films less where they would be higher than "
                     "1080")
        ->check(CLI::Range(200, 8000));
    command
        ->add_option("--trails", options->preview.trail_seconds,
                     "Length of the trails in seconds, 0 for none")
        ->check(CLI::Range(0.0, 600.0))
        ->capture_default_str();
    command->add_flag("!--no-density", options->preview.density, "Leave out the density layer");
    command->add_option(
        "--level", options->preview.level,
        "Of a layout with levels, only this one: its floor, who is on it, and who is on a link "
        "nearer to it than to the other end; by default all levels over each other");
    command->add_flag("--json", options->json, "Print a JSON document");
    command->footer("Example:\n  throng preview bakes/intersection -o intersection.png --frame 800");
    command->callback([options] { runPreview(*options); });
}

}  // namespace throng::cli
