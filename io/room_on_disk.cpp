// SPDX-License-Identifier: Apache-2.0
#include "io/room_on_disk.h"

#include <fmt/format.h>

#include <cmath>

#include "base/files/errors.h"
#include "base/numbers.h"
#include "io/streams/stream_format.h"

namespace throng::io {
namespace {

StreamFormats exactOf(const StreamFormats& formats) {
    StreamFormats exact;
    for (const StreamFormatInfo& info : kStreamFormats)
        if (info.is_exact && formats.has(info.id)) exact.add(info.id);
    return exact;
}

}  // namespace

std::uint64_t bytesOfStreams(std::size_t streams, const StreamFormats& formats, std::uint64_t frames,
                             std::uint64_t rows) {
    std::uint64_t bytes = 0;
    for (const StreamFormatInfo& info : kStreamFormats) {
        if (!formats.has(info.id)) continue;
        const std::uint64_t head = info.is_exact ? headerSize(info.id) : 0;
        bytes += head + static_cast<std::uint64_t>(std::llround(info.bytes * static_cast<double>(frames) *
                                                                static_cast<double>(rows)));
    }
    return bytes * streams;
}

void requireRoom(const std::filesystem::path& folder, std::size_t streams, const StreamFormats& formats,
                 std::uint64_t frames, std::uint64_t rows) {
    const std::uint64_t needed = bytesOfStreams(streams, exactOf(formats), frames, rows);
    std::error_code unknown;
    const std::filesystem::space_info disk = std::filesystem::space(folder, unknown);
    if (unknown || needed <= disk.available) return;
    throw OutputError(
        folder, fmt::format("the disk has room for {}, and {} streams of {} frames of {} people take {}. "
                            "`--streams npy` or `--streams pc2` writes half of what both take, `--streams "
                            "packed` about a tenth; `--set simulation.duration=SECONDS` bakes less",
                            readableBytes(disk.available), streams, frames, rows, readableBytes(needed)));
}

}  // namespace throng::io
