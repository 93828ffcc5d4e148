// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace throng::cli {

struct ProgramOutput {
    int status = 0;  ///< exit code, or 128 + signal; 127 where there is no such program
    std::string output, errors;
};

/// Runs a program found on the PATH, without a shell, and waits for it.
ProgramOutput runProgram(const std::vector<std::string>& words);

}  // namespace throng::cli
