// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/bake_reader.h"

namespace throng::io {

/// Something wrong with one file of a bake.
struct BakeProblem {
    std::string path;     ///< relative to the bake
    std::string message;  ///< e.g. "missing", "truncated: 100 of 200 bytes"
};

/// Compares every file with the manifest: presence, size, XXH3 hash, and the headers of the streams. Reads
/// all of the bake. Empty when everything is as it was written.
std::vector<BakeProblem> verifyBake(const Bake& bake);

/// Facts about a bake for people, several lines.
std::string infoText(const Bake& bake);

/// The same for programs: the manifest without the geometry and the list of files, with "path" (the folder),
/// "bytes" (of all files) and "file_count" added.
nlohmann::ordered_json infoJson(const Bake& bake);

}  // namespace throng::io
