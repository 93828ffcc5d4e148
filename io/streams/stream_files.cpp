// SPDX-License-Identifier: Apache-2.0
#include "io/streams/stream_files.h"

namespace throng::io {

StreamFiles::StreamFiles(const std::filesystem::path& bake, const StreamInfo& info,
                         const StreamFormats& formats, std::uint32_t rows, std::uint32_t expected_frames,
                         const std::optional<StreamSoFar>& so_far)
    : info_(info), formats_(formats) {
    for (const StreamFormatInfo& each : kStreamFormats) {
        if (!formats.has(each.id)) continue;
        const std::filesystem::path path = bake / streamFile(info, each.id);
        if (each.is_exact && so_far)
            writers_.emplace_back(path, each.id, rows, expected_frames, so_far->frames);
        else if (each.is_exact)
            writers_.emplace_back(path, each.id, rows, expected_frames);
        else if (so_far)
            packed_.emplace(path, info, rows, so_far->packed);
        else
            packed_.emplace(path, info, rows);
    }
}

void StreamFiles::append(std::span<const float> frame, std::span<const std::uint32_t> first_alive) {
    for (StreamWriter& writer : writers_)
        writer.append(frame);
    if (packed_) packed_->append(frame, first_alive);
}

std::optional<std::vector<std::byte>> StreamFiles::packedState() {
    return packed_ ? std::optional(packed_->state()) : std::nullopt;
}

void StreamFiles::flush() {
    for (StreamWriter& writer : writers_)
        writer.flush();
    if (packed_) packed_->flush();
}

void StreamFiles::backFill(std::span<const std::uint32_t> first_alive_frame) {
    std::array<BackFill, kComponents> rule{};
    for (std::size_t i = 0; i < kComponents; ++i)
        rule[i] = info_.components[i].before_entry;
    for (StreamWriter& writer : writers_)
        writer.backFill(first_alive_frame, rule);
    if (packed_) packed_->backFill(first_alive_frame);
}

void StreamFiles::finish() {
    for (StreamWriter& writer : writers_)
        writer.finish();
    if (packed_) packed_->finish();
}

std::vector<std::string> filesOf(std::span<const StreamFiles> streams) {
    std::vector<std::string> files;
    for (const StreamFiles& stream : streams)
        for (const StreamFormatInfo& format : kStreamFormats)
            if (stream.formats().has(format.id)) files.push_back(streamFile(stream.info(), format.id));
    return files;
}

}  // namespace throng::io
