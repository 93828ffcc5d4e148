// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace throng::cli {

/// Scripts that complete commands, options and their words in a shell, from the table of commands.
std::string bashCompletions(const CLI::App& app);
std::string zshCompletions(const CLI::App& app);
std::string fishCompletions(const CLI::App& app);

/// The manual page, in roff: all commands in one.
std::string manualPage(const CLI::App& app);

}  // namespace throng::cli
