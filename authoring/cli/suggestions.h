// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace throng::cli {

/// "did you mean `bake`?" for a mistyped command or option, or nothing.
std::string suggestFor(const CLI::App& app, int argc, const char* const* argv);

}  // namespace throng::cli
