// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/terminal/shell_texts.h"

namespace throng::cli {

void addCompletions(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("completions", "Print a script that completes this program's words in a shell");
    auto shell = std::make_shared<std::string>();
    command->add_option("shell", *shell, "Which shell")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    command->footer(
        "Installed packages bring these scripts along. Elsewhere, a line in ~/.bashrc does:\n\n"
        "Example:\n  source <(throng completions bash)");
    command->callback([&app, shell] {
        fmt::print("{}", *shell == "bash"  ? bashCompletions(app)
                         : *shell == "zsh" ? zshCompletions(app)
                                           : fishCompletions(app));
    });
}

void addManual(CLI::App& app) {
    CLI::App* command = app.add_subcommand("manual", "Print the manual page, as man reads it");
    command->footer("Example:\n  throng manual | man -l -");
    command->callback([&app] { fmt::print("{}", manualPage(app)); });
}

}  // namespace throng::cli
