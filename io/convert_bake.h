// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "io/crowd_reader.h"

namespace throng::io {

struct ConvertOptions {
    std::filesystem::path output;  ///< the bake to make; with `force` it may be the one that is read
    bool force = false;            ///< replace an existing bake
    StreamFormats formats = StreamFormats::standard();
    /// Asked after each frame; false stops and leaves nothing behind.
    std::function<bool(std::uint32_t frames_done)> go_on = [](std::uint32_t) { return true; };
};

/// Writes a bake with its streams in other forms and everything else as it is. The new bake appears when it
/// is complete. @returns where it is; nothing when `go_on` said no. Throws InputError and OutputError.
std::optional<std::filesystem::path> convertBake(CrowdReader& source, const ConvertOptions& options);

}  // namespace throng::io
