// SPDX-License-Identifier: Apache-2.0
#include "authoring/cli/suggestions.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace throng::cli {
namespace {

/// Insertions, deletions and replacements between two words (Levenshtein 1966).
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row[b.size()];
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = editDistance(word, candidate);
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

std::vector<std::string> optionsOf(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

}  // namespace

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
                const std::string meant = nearest(word, commands);
                return meant.empty() ? "" : fmt::format("did you mean `{}`?", meant);
            }
            command = app.get_subcommand(word);
        } else if (word.starts_with("--")) {
            const std::string name = word.substr(0, word.find('='));
            const std::vector<std::string> known = optionsOf(command ? *command : app);
            if (std::find(known.begin(), known.end(), name) != known.end()) continue;
            const std::string meant = nearest(name, known);
            if (!meant.empty()) return fmt::format("did you mean `{}`?", meant);
        }
    }
    return "";
}

}  // namespace throng::cli
