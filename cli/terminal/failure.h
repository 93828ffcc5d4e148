// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "authoring/diagnostics.h"

namespace throng::cli {

/// All that is wrong with a file, as every command says it with --json: a list of objects with `severity`,
/// `file`, `line`, `column`, `pointer`, `message` and `hint`.
nlohmann::ordered_json diagnosticsJson(const authoring::Diagnostics& diagnostics);

/// Whether the command line asks for JSON: even one that cannot be understood is answered so.
bool asksForJson(int argc, const char* const* argv);

/// Why a command came to nothing, on standard output: {"error": {"code", "message", "hint", "diagnostics"}}.
void sayFailureJson(int code, const std::string& message, const std::string& hint = {},
                    const nlohmann::ordered_json& diagnostics = nlohmann::ordered_json::array());

}  // namespace throng::cli
