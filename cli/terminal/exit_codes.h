// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

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

/// Ends a command with a code; what there is to say has been said.
struct Exit : std::runtime_error {
    explicit Exit(int exit_code) : std::runtime_error("exit"), code(exit_code) {}
    int code;
};

}  // namespace throng::cli
