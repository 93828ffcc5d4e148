// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "base/numbers.h"
#include "cli/commands.h"
#include "cli/stream_option.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "io/bake_info.h"
#include "io/convert_bake.h"

namespace throng::cli {
namespace {

struct ConvertOptions {
    std::string bake;
    std::string output;
    std::string formats = wordsOf(StreamFormats::standard());
    bool force = false;
    bool json = false;
    bool quiet = false;
};

void runConvert(const ConvertOptions& options) {
    io::ConvertOptions convert;
    convert.output = options.output;
    convert.force = options.force;
    convert.formats = formatsOf(options.formats);
    io::CrowdReader crowd(io::loadBake(options.bake));
    const InterruptGuard interrupt;
    Progress progress(progressStyle(options.quiet, options.json), crowd.frames(), 0, 1);
    convert.go_on = [&](std::uint32_t frames) {
        progress.update(frames, crowd.rows(), frames);
        return interrupt.signal() == 0;
    };
    const auto made = io::convertBake(crowd, convert);
    if (!made) {
        say(stderr, "throng: stopped; nothing was written\n");
        throw Exit(128 + interrupt.signal(), "stopped; nothing was written");
    }
    const io::Bake bake = io::loadBake(*made);
    if (options.json) {
        sayJson(io::infoJson(bake));
        return;
    }
    say(stdout, "{}: {} frames, {} people, streams as {}, {}\n", made->string(), bake.frames, bake.agents,
        wordsOf(bake.formats), readableBytes(io::totalBytes(bake)));
}

}  // namespace

void addConvert(CLI::App& app) {
    CLI::App* command = app.add_subcommand("convert", "Write a bake anew with its streams in other forms");
    auto options = std::make_shared<ConvertOptions>();
    command->add_option("bake", options->bake, "A bake's folder, or its bake.json")->required();
    command->add_option("-o,--output", options->output, "The bake to make")->required();
    addStreamsOption(*command, options->formats);
    command->add_flag("--force", options->force, "Replace an existing bake; it may be the one that is read");
    command->add_flag("--json", options->json,
                      "Progress as JSON lines on stderr, the result as a JSON document on stdout");
    command->add_flag("-q,--quiet", options->quiet, "No progress");
    command->footer(
        "Everything but the streams is copied as it is. Ctrl-C leaves nothing behind.\n\n"
        "Example:\n  throng convert bakes/street -o bakes/street-for-blender --streams pc2");
    command->callback([options] { runConvert(*options); });
}

}  // namespace throng::cli
