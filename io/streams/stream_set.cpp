// SPDX-License-Identifier: Apache-2.0
#include "io/streams/stream_set.h"

#include <fmt/format.h>

#include <utility>

namespace throng::io {

StreamSet::StreamSet(std::filesystem::path bake, const StreamChoice& streams, const StreamFormats& formats,
                     std::uint32_t frames, std::uint32_t rows)
    : bake_(std::move(bake)), streams_(streams), format_(formats.preferred()), frames_(frames), rows_(rows) {}

const StreamReader& StreamSet::operator[](Stream stream) const {
    std::optional<StreamReader>& reader = readers_[stream];
    if (reader) return *reader;
    const StreamInfo& info = infoOf(stream);
    if (!has(stream)) throw InputError(bake_, fmt::format("this bake has no stream `{}`", info.name));
    const std::filesystem::path path = bake_ / streamFile(info, format_);
    StreamReader opened(path);
    if (opened.frames() != frames_ || opened.rows() != rows_)
        throw InputError(path, fmt::format("holds {} frames of {} people where bake.json says {} of {}",
                                           opened.frames(), opened.rows(), frames_, rows_));
    return reader.emplace(std::move(opened));
}

}  // namespace throng::io
