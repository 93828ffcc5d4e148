// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/baking/bake_description.h"

namespace throng::cli {

/// Everything that `throng bake` can be told.
struct BakeRequest {
    std::string layout;
    BakeOptions bake;
    std::vector<std::string> overrides;
    std::string diagrams = "none";
    std::string method, proximity;
    std::string fields = "auto";
    std::string formats = wordsOf(StreamFormats::standard());  ///< of the streams
    StreamChoice streams{};                                    ///< asked for
    bool seconds = false;
    double checkpoint_minutes = 10.0;
    bool resume = false;
    std::string shader_dir;
    int device = -1;
    bool json = false;
    bool quiet = false;
    bool announce = true;  ///< print what came of it
};

/// Simulates a layout file and writes the bake.
/// @throws Exit, and whatever reading, simulating and writing throw
void bakeLayout(const BakeRequest& request);

}  // namespace throng::cli
