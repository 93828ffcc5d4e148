// SPDX-License-Identifier: Apache-2.0
#include "io/streams/stream_files.h"

namespace throng::io {

StreamFiles::StreamFiles(const std::filesystem::path& bake, const StreamInfo& info,
                         const StreamFormats& formats, std::uint32_t rows, std::uint32_t expected_frames,
                         std::optional<std::uint32_t> frames_there)
    : info_(info), formats_(formats) {
    for (const StreamFormatInfo& each : kStreamFormats) {
        const StreamFormat format = each.id;
        if (!formats.has(format)) continue;
        const std::filesystem::path path = bake / streamFile(info, format);
        if (frames_there)
            writers_.emplace_back(path, format, rows, expected_frames, *frames_there);
        else
            writers_.emplace_back(path, format, rows, expected_frames);
    }
}

void StreamFiles::append(std::span<const float> frame) {
    for (StreamWriter& writer : writers_)
        writer.append(frame);
}

void StreamFiles::flush() {
    for (StreamWriter& writer : writers_)
        writer.flush();
}

void StreamFiles::backFill(std::span<const std::uint32_t> first_alive_frame) {
    std::array<BackFill, kComponents> rule{};
    for (std::size_t i = 0; i < kComponents; ++i)
        rule[i] = info_.components[i].before_entry;
    for (StreamWriter& writer : writers_)
        writer.backFill(first_alive_frame, rule);
}

void StreamFiles::finish() {
    for (StreamWriter& writer : writers_)
        writer.finish();
}

std::vector<std::string> filesOf(std::span<const StreamFiles> streams) {
    std::vector<std::string> files;
    for (const StreamFiles& stream : streams)
        for (const StreamFormatInfo& format : kStreamFormats)
            if (stream.formats().has(format.id)) files.push_back(streamFile(stream.info(), format.id));
    return files;
}

}  // namespace throng::io
