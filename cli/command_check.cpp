// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/baking/load_layout.h"
#include "cli/commands.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace {

struct Options {
    std::vector<std::string> layouts;
    std::vector<std::string> overrides;
    bool json = false;
};

nlohmann::ordered_json toJson(const LoadAttempt& attempt) {
    nlohmann::ordered_json diagnostics = nlohmann::ordered_json::array();
    for (const authoring::Diagnostic& entry : attempt.loaded.diagnostics.entries)
        diagnostics.push_back(
            {{"severity", entry.severity == authoring::Severity::error ? "error" : "warning"},
             {"line", entry.where.line},
             {"column", entry.where.column},
             {"pointer", entry.where.pointer()},
             {"message", entry.message},
             {"hint", entry.hint}});
    nlohmann::ordered_json result = {{"file", attempt.loaded.diagnostics.file}, {"valid", attempt.valid}};
    if (attempt.valid) result["agents"] = attempt.loaded.scene.people.size();
    result["diagnostics"] = diagnostics;
    return result;
}

void printSummary(const LoadedLayout& loaded) {
    const authoring::Scene& scene = loaded.scene;
    say(stdout,
        "{}: ok: {} people in {} groups, {} wall segments, {:.0f} x {:.0f} m, {:.4g} s at {:.4g} frames/s\n",
        loaded.diagnostics.file, scene.people.size(), scene.groups.size(), scene.wall_segments.size(),
        scene.maximum.x - scene.minimum.x, scene.maximum.y - scene.minimum.y, scene.settings.duration,
        scene.settings.fps);
}

void run(const Options& options) {
    bool all_valid = true;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const std::string& path : options.layouts) {
        const LoadAttempt attempt = tryLoadLayout(path, options.overrides);
        all_valid = all_valid && attempt.valid;
        if (options.json) {
            list.push_back(toJson(attempt));
            continue;
        }
        printDiagnostics(attempt.loaded);
        if (attempt.valid) printSummary(attempt.loaded);
    }
    if (options.json) sayJson(list);
    if (!all_valid) throw Exit(kInvalidInput);
}

}  // namespace

void addCheck(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("check", "Say everything that is wrong with layouts, without baking them");
    auto options = std::make_shared<Options>();
    command->add_option("layout", options->layouts, "Layout files (- for standard input)")->required();
    command
        ->add_option("--set", options->overrides,
                     "Override a value, e.g. --set simulation.seed=7 (repeatable)")
        ->take_all()
        ->expected(1);
    command->add_flag("--json", options->json, "Print a JSON document");
    command->footer("Example:\n  throng check examples/*.json");
    command->callback([options] { run(*options); });
}

}  // namespace throng::cli
