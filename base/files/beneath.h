// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/files/input_file.h"

namespace throng {

/// Opens a file that an untrusted document names, if it is a regular file in `folder` or below: neither `..`,
/// nor absolute paths, nor links lead out of it.
/// @throws InputError
InputFile openBeneath(const std::filesystem::path& folder, const std::string& relative);

/// The whole of such a file.
/// @throws InputError, also when it is larger than `limit` bytes
std::vector<unsigned char> readBeneath(const std::filesystem::path& folder, const std::string& relative,
                                       std::uint64_t limit);

}  // namespace throng
