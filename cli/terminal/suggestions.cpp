// SPDX-License-Identifier: Apache-2.0
#include "cli/terminal/suggestions.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "authoring/layout/words.h"

namespace throng::cli {
namespace {

std::vector<std::string> optionNames(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

}  // namespace

bool isCommand(const CLI::App& app, const std::string& word) {
    const std::vector<const CLI::App*> commands = app.get_subcommands({});
    return std::any_of(commands.begin(), commands.end(),
                       [&](const CLI::App* command) { return command->get_name() == word; });
}

std::string suggestFor(const CLI::App& app, int argc, const char* const* argv) {
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands({}))
        commands.push_back(command->get_name());
    const CLI::App* command = nullptr;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (!command && !word.starts_with("-")) {
            const auto found = std::find(commands.begin(), commands.end(), word);
            if (found == commands.end()) {
                const std::string meant = authoring::nearestWord(word, commands);
                return meant.empty() ? "" : fmt::format("did you mean `{}`?", meant);
            }
            command = app.get_subcommand(word);
        } else if (word.starts_with("--")) {
            const std::string name = word.substr(0, word.find('='));
            const std::vector<std::string> known = optionNames(command ? *command : app);
            if (std::find(known.begin(), known.end(), name) != known.end()) continue;
            const std::string meant = authoring::nearestWord(name, known);
            if (!meant.empty()) return fmt::format("did you mean `{}`?", meant);
        }
    }
    return "";
}

}  // namespace throng::cli
