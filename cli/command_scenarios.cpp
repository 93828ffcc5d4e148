// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/measure/measure.h"
#include "base/files/output_file.h"
#include "cli/bake_run.h"
#include "cli/baking/judge.h"
#include "cli/commands.h"
#include "cli/scenarios.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace {

struct ScenariosOptions {
    std::vector<std::string> names;
    std::string output = "scenarios-baked";
    std::vector<std::string> overrides;
    int device = -1;
    bool list = false;
    bool json = false;
};

const Scenario& scenarioNamed(const std::string& name) {
    std::string known;
    for (const Scenario& scenario : scenarios()) {
        if (scenario.name == name) return scenario;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", scenario.name);
    }
    throw CLI::ValidationError("--run", fmt::format("there is no scenario `{}`; there are: {}", name, known));
}

/// @returns the bars that were missed
std::vector<std::string> runOne(const Scenario& scenario, const ScenariosOptions& options,
                                nlohmann::ordered_json& report) {
    const std::filesystem::path folder(options.output);
    const std::filesystem::path layout = folder / fmt::format("{}.json", scenario.name);
    replaceFile(layout, scenario.layout);
    BakeRequest request;
    request.layout = layout.string();
    request.overrides = options.overrides;
    request.device = options.device;
    request.bake.output = (folder / scenario.name).string();
    request.bake.force = true;
    request.bake.gltf = false;
    request.quiet = options.json;
    request.announce = false;
    bakeLayout(request);

    io::CrowdReader crowd(io::loadBake(request.bake.output));
    const auto [measured, missed] = judgeBake(crowd, {});
    nlohmann::ordered_json json = analysis::measurementJson(measured);
    json["missed"] = missed;
    report[std::string(scenario.name)] = json;
    if (!options.json) {
        say(stdout, "== {}\n{}", scenario.name, analysis::measurementText(measured));
        for (const std::string& bar : missed)
            say(stdout, "MISSED               {}\n", bar);
    }
    return missed;
}

void runScenarios(const ScenariosOptions& options) {
    if (options.list && options.json) {
        nlohmann::ordered_json names = nlohmann::ordered_json::array();
        for (const Scenario& scenario : scenarios())
            names.push_back(scenario.name);
        return sayJson(names);
    }
    if (options.list) {
        for (const Scenario& scenario : scenarios())
            say(stdout, "{}\n", scenario.name);
        return;
    }
    std::vector<const Scenario*> chosen;
    for (const std::string& name : options.names)
        chosen.push_back(&scenarioNamed(name));
    if (chosen.empty())
        for (const Scenario& scenario : scenarios())
            if (!scenario.large) chosen.push_back(&scenario);
    makeFolder(options.output);

    nlohmann::ordered_json report = nlohmann::ordered_json::object();
    bool all_held = true;
    for (const Scenario* scenario : chosen)
        all_held = runOne(*scenario, options, report).empty() && all_held;
    if (options.json) sayJson((chosen.size() == 1 ? report.front() : report));
    if (!all_held) throw Exit(kExpectationMissed);
}

}  // namespace

void addScenarios(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("scenarios", "Bake and measure the scenarios that the motion is judged by");
    auto options = std::make_shared<ScenariosOptions>();
    command->add_flag("--list", options->list, "Only name them");
    command
        ->add_option(
            "--run", options->names,
            "Only this one (repeatable); those of 16,384 people and more run only where they are named")
        ->take_all()
        ->expected(1);
    command->add_option("-o,--output", options->output, "Where layouts and bakes are left")
        ->capture_default_str();
    command->add_option("--set", options->overrides, "Override a value of every layout (repeatable)")
        ->take_all()
        ->expected(1);
    command->add_option("--device", options->device, "Run on this device (`throng devices` lists them)");
    command->add_flag("--json", options->json,
                      "Print what `measure --json` prints; by name where there are several");
    command->footer("Exits with 1 when a bar is missed.\n\nExample:\n  throng scenarios --run ring --json");
    command->callback([options] { runScenarios(*options); });
}

}  // namespace throng::cli
