// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "analysis/report/page.h"
#include "authoring/layout/layout_reader.h"
#include "base/files/input_file.h"
#include "base/process.h"
#include "cli/baking/baker.h"
#include "cli/commands.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/failure.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/say.h"
#include "cli/watch/file_watch.h"
#include "cli/watch/follow_bake.h"
#include "cli/watch/live_run.h"
#include "cli/watch/live_server.h"
#include "io/growing_bake.h"

namespace throng::cli {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
constexpr std::chrono::milliseconds kAsksEvery{50};

struct WatchOptions {
    std::string input;
    std::vector<std::string> overrides;
    int port = 0;
    bool open = false;
    double per_second = 8.0;
    int megabytes = 256;
    int device = -1;
    std::string shader_dir;
    bool json = false;
};

/// A browser, whatever the desktop takes for one.
void openBrowser(const std::string& address) try {
    if (!runProgram({"xdg-open", address}).end.isGood())
        say(stderr, "throng: no browser could be opened; the address is {}\n", address);
} catch (const std::system_error& error) {
    say(stderr, "throng: no browser could be opened: {}\n", error.what());
}

/// A layout that is simulated anew whenever it changes.
class LayoutWatch {
  public:
    LayoutWatch(const WatchOptions& options, LiveLog& log, const InterruptGuard& interrupt)
        : options_(options), log_(log), interrupt_(interrupt) {}

    void run() {
        while (!interrupt_.signal()) {
            files_.watch({options_.input});
            if (const std::optional<LoadedLayout> loaded = read()) simulate(*loaded);
            while (!shouldStop())
                std::this_thread::sleep_for(kAsksEvery);
            if (!interrupt_.signal()) files_.settle();
        }
    }

  private:
    bool shouldStop() { return interrupt_.signal() != 0 || files_.hasChanged(); }

    /// The layout, unless there are mistakes in it: those are told.
    std::optional<LoadedLayout> read() try {
        LoadAttempt attempt =
            tryReadLayout(readFile(options_.input), options_.input, options_.overrides, &ground_);
        attempt.loaded.file = fs::path(options_.input).filename().string();
        if (attempt.loaded.layout.terrain)
            files_.add({fs::path(options_.input).parent_path() / attempt.loaded.layout.terrain->file});
        for (const authoring::GivenPeople& given : attempt.loaded.layout.given)
            if (!given.file.empty()) files_.add({fs::path(options_.input).parent_path() / given.file});
        printDiagnostics(attempt.loaded);
        tellMistakes(attempt.loaded, attempt.valid);
        if (!attempt.valid) return std::nullopt;
        return std::move(attempt.loaded);
    } catch (const InputError& error) {
        tellFailure(error.what());
        return std::nullopt;
    }

    void tellMistakes(const LoadedLayout& loaded, bool valid) {
        Json texts = Json::array();
        for (const authoring::Diagnostic& entry : loaded.diagnostics.entries)
            texts.push_back(authoring::formatDiagnostic(entry, loaded.diagnostics.file, loaded.text));
        log_.note({{"diagnostics", diagnosticsJson(loaded.diagnostics)}, {"texts", std::move(texts)}});
        log_.tell({{"state", valid ? "read" : "mistaken"}});
    }

    /// @param what is wrong, of what has no line
    void tellFailure(const std::string& what) {
        say(stderr, "throng: {}\n", what);
        log_.note({{"diagnostics", Json::array()}, {"texts", Json::array({what})}});
        log_.tell({{"state", "mistaken"}});
    }

    void simulate(const LoadedLayout& loaded) try {
        if (!baker_) baker_.emplace(options_.device, options_.shader_dir, loaded.scene.people.size());
        const Clock::time_point begin = Clock::now();
        const LiveEnd end =
            simulateLive(*baker_, loaded, options_.per_second, log_, [&] { return shouldStop(); });
        if (end == LiveEnd::stopped) return;
        say(stderr, "{}: {:.4g} s simulated in {:.1f} s{}\n", options_.input, loaded.scene.settings.duration,
            secondsSince(begin), end == LiveEnd::full ? ", as far as there is room for" : "");
    } catch (const gl::DeviceLost&) {
        throw;
    } catch (const gl::GraphicsError& error) {  // too large, say: the next layout may be smaller
        if (!baker_) throw;
        tellFailure(error.what());
    }

    const WatchOptions& options_;
    LiveLog& log_;
    const InterruptGuard& interrupt_;
    FileWatch files_;
    authoring::GroundCache ground_;
    std::optional<Baker> baker_;
};

bool isBake(const fs::path& path) {
    return path.filename() == "bake.json" || !fs::is_regular_file(path);
}

std::string pageFor(const WatchOptions& options, bool is_bake) {
    const std::string name = fs::absolute(options.input).lexically_normal().filename().string();
    return analysis::makePage("watch", name,
                              {{"file", name},
                               {"is_bake", is_bake},
                               {"per_second", options.per_second},
                               {"megabytes", options.megabytes}},
                              "'self'");
}

void runWatch(const WatchOptions& options) {
    const bool is_bake = isBake(options.input);
    // What is not there at all is said before anybody is told to look.
    if (is_bake)
        io::GrowingBake(options.input);
    else
        readFile(options.input);
    const InterruptGuard interrupt;
    LiveLog log(std::uint64_t(options.megabytes) << 20);
    log.tell({{"state", "reading"}});
    const LiveServer server(log, pageFor(options, is_bake), options.port);
    struct Closing {
        LiveLog& log;
        ~Closing() { log.close(); }
    } const closing{log};  // before the server goes
    if (options.json)
        fmt::print("{}\n", Json{{"address", server.address()}, {"port", server.port()}}.dump());
    else
        say(stdout, "{} (Ctrl-C ends)\n", server.address());
    std::fflush(stdout);
    if (options.open) openBrowser(server.address());
    if (is_bake)
        followBake(options.input, options.per_second, log, [&] { return interrupt.signal() != 0; });
    else
        LayoutWatch(options, log, interrupt).run();
}

}  // namespace

void addWatch(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "watch", "Show in a browser the crowd of a layout that is being changed, or of a bake under way");
    auto options = std::make_shared<WatchOptions>();
    command->add_option("input", options->input, "A layout file, or a bake's folder")->required();
    command
        ->add_option("--set", options->overrides,
                     "Override a value, e.g. --set simulation.substeps=1 (repeatable)")
        ->take_all()
        ->expected(1);
    command->add_option("--port", options->port, "Listen on this port; by default on any that is free")
        ->check(CLI::Range(1, 65535));
    command->add_flag("--open", options->open, "Open the page in a browser");
    command
        ->add_option("--moments", options->per_second,
                     "Moments of a second that are kept; straight lines are played in between")
        ->check(CLI::Range(0.5, 240.0))
        ->capture_default_str();
    command->add_option("--memory", options->megabytes, "MiB of moments that are kept at most")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    command->add_option("--device", options->device, "Run on this device (`throng devices` lists them)");
    command->add_option("--shader-dir", options->shader_dir, "Take shaders from this copy of shaders/")
        ->check(CLI::ExistingDirectory);
    command->add_flag("--json", options->json, "Print the address as a line of JSON");
    command->footer(
        "A layout is read, checked and simulated anew, from its beginning, whenever it or its terrain\n"
        "changes; mistakes are shown on the page and here. Nothing is written. The page is for this machine\n"
        "alone (127.0.0.1). Ctrl-C ends.\n\n"
        "Example:\n  throng watch examples/market.json --open");
    command->callback([options] { runWatch(*options); });
}

}  // namespace throng::cli
