// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/stream_formats.h"

namespace throng::io {

/// Bytes of some streams on the disk, headers and all; of the form `packed` about.
std::uint64_t bytesOfStreams(std::size_t streams, const StreamFormats& formats, std::uint64_t frames,
                             std::uint64_t rows);

/// Before hours are spent on it: an error where the disk cannot hold what is certain to be written, that of
/// the exact forms.
/// @param folder that is there; @param frames still to be written
/// @throws OutputError
void requireRoom(const std::filesystem::path& folder, std::size_t streams, const StreamFormats& formats,
                 std::uint64_t frames, std::uint64_t rows);

}  // namespace throng::io
