// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "io/bake_reader.h"

namespace throng::io {

/// Of all its files.
std::uint64_t totalBytes(const Bake& bake);

/// Facts about a bake for people, several lines.
std::string infoText(const Bake& bake);

/// The same for programs: the manifest without the geometry, the list of files and its checksum, with "path"
/// (the folder), "bytes" (of all files) and "file_count" added.
nlohmann::ordered_json infoJson(const Bake& bake);

}  // namespace throng::io
