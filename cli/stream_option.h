// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "base/stream_formats.h"

namespace throng::cli {

/// `--streams`, of commands that write bakes.
/// @param words what is read into it, and what holds where it is not told
void addStreamsOption(CLI::App& command, std::string& words);

/// @throws CLI::ValidationError
StreamFormats formatsOf(const std::string& words);

}  // namespace throng::cli
