// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/bake_reader.h"

namespace throng::io {

/// Something wrong with one file of a bake.
struct BakeProblem {
    enum class Kind { missing, truncated, too_long, changed, unreadable, stranger, unlisted } kind;
    std::string path;     ///< relative to the bake
    std::string message;  ///< e.g. "missing", "truncated: 100 of 200 bytes"
};
const char* nameOf(BakeProblem::Kind kind);

/// What came of comparing a bake with its own list of files.
struct Verification {
    bool has_checksums = true;  ///< false: bake.json lists none, so nothing can be said of the files
    std::vector<BakeProblem> problems;
    std::size_t files = 0;    ///< in the list
    std::uint64_t bytes = 0;  ///< that they should have
    bool isWhole() const { return has_checksums && problems.empty(); }
};

/// Told how much of how much has been read.
using VerifyProgress = std::function<void(std::uint64_t read, std::uint64_t of)>;

/// Compares every file with the list in bake.json: presence, size, XXH3, the headers of the streams; and
/// bake.json with its own checksum. Files that the list does not have are problems, too, but for checkpoints
/// that a killed process did not get to remove. Reads all of the bake, in pieces, and nothing outside it.
/// @param path the folder or its bake.json
Verification verifyBake(const std::filesystem::path& path, const VerifyProgress& progress = {});

/// What is wrong with one file of the list; nothing where it is as it was written.
/// @param advance called with the bytes of each piece that has been read
std::optional<BakeProblem> problemOf(const Bake& bake, const Bake::File& file,
                                     const std::function<void(std::uint64_t bytes)>& advance = {});

}  // namespace throng::io
