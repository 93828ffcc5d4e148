// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/bake_reader.h"

/// What making a bake of another one takes of it. All throw InputError where that is not to be used.
namespace throng::io {

/// Some of a bake's files, by their paths from its folder.
using WhichFiles = std::function<bool(const std::string& path)>;

/// Whether a stream lies there, in any form.
bool isStreamFile(const std::string& path);
/// Whether a stream of this bake lies there, in the form that readers take.
bool isReadStream(const Bake& bake, const std::string& path);

/// A bake may come from anywhere, and the new one has what this one has: nothing that a link leads to
/// outside, neither of its list nor of its streams, nor `more` of its files.
void requireInside(const Bake& bake, const std::vector<std::string>& more);

/// What is read or copied is as it was written: damage would get checksums that fit it.
void requireSound(const Bake& bake, const WhichFiles& which);

/// Copies one file of the list to the same path in another folder. Throws OutputError, too.
void copyBakeFile(const Bake& bake, const std::string& path, const std::filesystem::path& folder);

/// The member `files` of bake.json.
nlohmann::ordered_json listOfFiles(const std::filesystem::path& folder, std::span<const std::string> paths);

}  // namespace throng::io
