// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace throng::io {

/// XXH3, 64 bits, seed 0, as 16 hexadecimal digits (the canonical form: most significant first).
std::string hashText(std::string_view text);

struct FileHash {
    std::uint64_t bytes = 0;
    std::string xxh3;  ///< 16 hexadecimal digits
};

/// Reads the whole file. Throws InputError.
FileHash hashFile(const std::filesystem::path& path);

}  // namespace throng::io
