// SPDX-License-Identifier: Apache-2.0
#include "cli/stream_option.h"

namespace throng::cli {

void addStreamsOption(CLI::App& command, std::string& words) {
    command
        .add_option("--streams", words,
                    "The forms of the streams' files, with commas between: " + formatsInWords())
        ->capture_default_str();
}

StreamFormats formatsOf(const std::string& words) {
    const FormatsRead read = readFormats(words);
    if (!read.problem.empty()) throw CLI::ValidationError("--streams", read.problem);
    return read.formats;
}

}  // namespace throng::cli
