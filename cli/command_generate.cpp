// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <stdexcept>

#include "authoring/family/generators.h"
#include "base/files/output_file.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace {

struct GenerateOptions {
    std::string kind;
    std::vector<std::string> settings;
    std::string output;
    bool list = false;
    bool json = false;
};

nlohmann::ordered_json listJson() {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const authoring::Generator& generator : authoring::generators()) {
        nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
        for (const authoring::GeneratorParameter& parameter : generator.parameters)
            parameters.push_back({{"name", parameter.name},
                                  {"meaning", parameter.meaning},
                                  {"default", parameter.standard},
                                  {"minimum", parameter.least},
                                  {"maximum", parameter.most},
                                  {"whole", parameter.whole}});
        list.push_back(
            {{"kind", generator.name}, {"meaning", generator.meaning}, {"parameters", parameters}});
    }
    return list;
}

void list(bool as_json) {
    if (as_json) return sayJson(listJson());
    for (const authoring::Generator& generator : authoring::generators()) {
        fmt::print("{}: {}\n", generator.name, generator.meaning);
        for (const authoring::GeneratorParameter& parameter : generator.parameters)
            fmt::print("  {:<14} {:>6g}   {:g} to {:g}   {}\n", parameter.name, parameter.standard,
                       parameter.least, parameter.most, parameter.meaning);
    }
}

std::pair<std::string, double> settingOf(const std::string& text) {
    const std::size_t equals = text.find('=');
    double value = 0.0;
    if (equals != std::string::npos) {
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data() + equals + 1, end, value);
        if (error == std::errc() && stop == end) return {text.substr(0, equals), value};
    }
    throw CLI::ValidationError("--set", fmt::format("expects name=number, not `{}`", text));
}

void runGenerate(const GenerateOptions& options) {
    if (options.list) return list(options.json);
    const authoring::Generator* generator = authoring::generatorNamed(options.kind);
    if (!generator) {
        std::string known;
        for (const authoring::Generator& each : authoring::generators())
            known += fmt::format("{}{}", known.empty() ? "" : ", ", each.name);
        throw CLI::ValidationError(
            "kind", fmt::format("there is no generator `{}`; there are: {}", options.kind, known));
    }
    authoring::GeneratorValues values(generator->parameters);
    try {
        for (const std::string& setting : options.settings) {
            const auto [name, value] = settingOf(setting);
            values.set(name, value);
        }
    } catch (const std::invalid_argument& error) {
        throw CLI::ValidationError("--set", error.what());
    }
    const std::string text = generator->make(values).dump(1) + "\n";
    if (options.output.empty())
        fmt::print("{}", text);
    else
        writeNewFile(options.output, text);
    if (options.json && !options.output.empty()) sayJson({{"output", options.output}});
}

}  // namespace

void addGenerate(CLI::App& app) {
    CLI::App* command = app.add_subcommand("generate", "Make a layout from a few numbers");
    auto options = std::make_shared<GenerateOptions>();
    command->add_option("kind", options->kind,
                        "crossing, corridor, streets, marathon, plaza, stadium, station or office");
    command->add_option("--set", options->settings, "A parameter, e.g. --set arms=5 (repeatable)")
        ->take_all()
        ->expected(1);
    command->add_option("-o,--output", options->output, "The file to make; by default the layout is printed");
    command->add_flag("--list", options->list,
                      "Tell all generators with their parameters, standard values and ranges");
    command->add_flag("--json", options->json,
                      "What --list tells, or which file was made, as JSON; layouts are JSON anyway");
    command->footer("Example:\n  throng generate crossing --set arms=5 --set seed=3 -o crossing.json");
    command->callback([options] { runGenerate(*options); });
}

}  // namespace throng::cli
