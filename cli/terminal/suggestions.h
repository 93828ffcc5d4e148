// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace throng::cli {

/// Whether the application has a command of this name.
bool isCommand(const CLI::App& app, const std::string& word);

/// "did you mean `bake`?" for a mistyped command or option, or nothing.
std::string suggestFor(const CLI::App& app, int argc, const char* const* argv);

}  // namespace throng::cli
