// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// The JSON Schemas (draft-07) of what the program writes, put into it by the build.
namespace throng::cli {

std::string_view bakeSchema();     ///< of bake.json
std::string_view measureSchema();  ///< of what `throng measure --json` prints
std::string_view resultSchema();   ///< of a batch's results/ID.json
std::string_view batchSchema();    ///< of what `throng batch --json` prints

}  // namespace throng::cli
