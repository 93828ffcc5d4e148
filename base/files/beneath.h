// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace throng {

/// Reads a file that an untrusted document names, if it is a regular file in `folder` or below: neither `..`,
/// nor absolute paths, nor links lead out of it, and nothing blocks on a named pipe.
/// @throws InputError, also when it is larger than `limit` bytes
std::vector<unsigned char> readBeneath(const std::filesystem::path& folder, const std::string& relative,
                                       std::uint64_t limit);

}  // namespace throng
