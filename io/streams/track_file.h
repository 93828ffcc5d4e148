// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace throng::io {

/// Frames, things in each of them, and numbers of each thing.
using TrackShape = std::array<std::size_t, 3>;

/// Writes so many numbers as an .npy file; what is not known is zero. Throws OutputError.
void writeTrack(const std::filesystem::path& path, std::span<const float> track, const TrackShape& shape);

/// Reads them again. @param things what they are of, for messages. Throws InputError.
std::vector<float> readTrack(const std::filesystem::path& path, const TrackShape& shape, const char* things);

}  // namespace throng::io
