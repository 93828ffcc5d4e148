// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace throng::cli {

/// What the process tells its caller. Documented in docs/cli.md.
enum ExitCode : int {
    kOk = 0,
    kExpectationMissed = 1,  ///< a bake misses a bar that its layout sets
    kUsage = 2,              ///< the command line is wrong
    kInvalidInput = 3,       ///< a layout or a bake is wrong
    kNoGraphics = 4,         ///< no usable OpenGL, or the device was lost
    kOutputFailed = 5,       ///< something could not be written
    kCheckpointed = 85,      ///< stopped with a checkpoint: run it again with --resume
    kInterrupted = 130,      ///< Ctrl-C (128 + SIGINT)
    kTerminated = 143,       ///< 128 + SIGTERM
};

/// Ends a command with a code; what there is to say to people has been said.
struct Exit : std::runtime_error {
    /// Where standard output has all there is to know, with --json, too.
    explicit Exit(int exit_code) : std::runtime_error("exit"), code(exit_code) {}
    /// @param what_for what --json is to say of it, in a sentence; @param mistakes as diagnosticsJson()
    Exit(int exit_code, std::string what_for,
         nlohmann::ordered_json mistakes = nlohmann::ordered_json::array())
        : std::runtime_error("exit"),
          code(exit_code),
          message(std::move(what_for)),
          diagnostics(std::move(mistakes)) {}
    int code;
    std::string message;
    nlohmann::ordered_json diagnostics = nlohmann::ordered_json::array();
};

}  // namespace throng::cli
