// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>

#include "base/build_name.h"
#include "base/files/errors.h"
#include "base/text/printable.h"
#include "cli/commands.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/failure.h"
#include "cli/terminal/suggestions.h"
#include "sim/gl/context.h"

namespace {

using namespace throng;

constexpr const char* kFooter =
    "Examples:\n"
    "  throng check examples/intersection.json\n"
    "  throng bake examples/intersection.json -o bakes/intersection\n"
    "  throng preview bakes/intersection -o intersection.png\n"
    "\nExit codes: 0 ok, 1 a bar was missed, 2 usage, 3 invalid input, 4 no usable OpenGL, 5 output failed, "
    "85 stopped with a checkpoint, 130 interrupted.";

/// People read standard error, programs that ask for JSON standard output.
int fail(int code, const std::string& what, bool json, const std::string& hint = {}) {
    fmt::print(stderr, "throng: {}\n", printable(what, true));
    if (!hint.empty()) fmt::print(stderr, "  hint: {}\n", hint);
    if (json) cli::sayFailureJson(code, what, hint);
    return code;
}

/// What is printed may go to a file or a program: none of it is missing without a word.
/// @param code what the command ends with otherwise
int withAllPrinted(int code) {
    const bool is_whole = std::fflush(stdout) == 0 && !std::ferror(stdout);
    if (is_whole || (code != cli::kOk && code != cli::kExpectationMissed)) return code;
    const char* const reason = errno ? std::strerror(errno) : "it failed";
    return fail(cli::kOutputFailed, fmt::format("cannot write to standard output: {}", reason), false);
}

int parseAndRun(CLI::App& app, int argc, char** argv, bool json) {
    try {
        app.parse(argc, argv);
        return cli::kOk;
    } catch (const CLI::Success& success) {  // --help and --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        const bool is_unknown = argc > 1 && argv[1][0] != '-' && !cli::isCommand(app, argv[1]);
        const std::string what = is_unknown ? fmt::format("there is no command `{}`", printable(argv[1]))
                                            : std::string(error.what());
        const int code = fail(cli::kUsage, what, json, cli::suggestFor(app, argc, argv));
        fmt::print(stderr,
                   "  `throng --help` lists the commands, `throng COMMAND --help` a command's options.\n");
        return code;
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Bakes crowds: layouts of roads, walls and flows of people in; animation caches and diagrams out.",
        "throng");
    app.set_version_flag("--version", fmt::format("throng {}, build {}", THRONG_VERSION, buildName()));
    app.require_subcommand(1);
    app.footer(kFooter);
    cli::addBake(app);
    cli::addApply(app);
    cli::addConvert(app);
    cli::addCheck(app);
    cli::addInfo(app);
    cli::addVerify(app);
    cli::addPreview(app);
    cli::addSchema(app);
    cli::addDevices(app);
    cli::addCalibrate(app);
    cli::addBench(app);
    cli::addMeasure(app);
    cli::addCompare(app);
    cli::addScenarios(app);
    cli::addGenerate(app);
    cli::addBatch(app);
    cli::addReport(app);
    cli::addWatch(app);
    cli::addCompletions(app);
    cli::addManual(app);
    const bool json = cli::asksForJson(argc, argv);
    try {
        return withAllPrinted(parseAndRun(app, argc, argv, json));
    } catch (const cli::Exit& exit) {
        if (json && !exit.message.empty()) cli::sayFailureJson(exit.code, exit.message, {}, exit.diagnostics);
        return withAllPrinted(exit.code);
    } catch (const gl::GraphicsError& error) {
        return fail(cli::kNoGraphics, error.what(), json);
    } catch (const OutputError& error) {
        return fail(cli::kOutputFailed, error.what(), json);
    } catch (const std::bad_alloc&) {
        return fail(cli::kInvalidInput, "there is not enough memory for this", json);
    } catch (const std::exception& error) {
        // Of what cannot be printed, fmt tells like of any other mistake.
        if (std::ferror(stdout)) return withAllPrinted(cli::kOk);
        return fail(cli::kInvalidInput, error.what(), json);
    }
}
