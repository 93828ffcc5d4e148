// SPDX-License-Identifier: Apache-2.0
#include "io/streams/stream_format.h"

#include <fmt/format.h>

#include <cstring>

#include "io/streams/npy_header.h"

namespace throng::io {
namespace {

template <typename T>
void append(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

std::string pc2Header(std::uint64_t frames, std::uint64_t rows) {
    std::string bytes("POINTCACHE2\0", 12);
    append(bytes, std::int32_t{1});  // version
    append(bytes, static_cast<std::int32_t>(rows));
    append(bytes, 1.0f);  // the first sample's frame
    append(bytes, 1.0f);  // frames between samples
    append(bytes, static_cast<std::int32_t>(frames));
    return bytes;
}

}  // namespace

std::string streamFile(const StreamInfo& info, StreamFormat format) {
    return fmt::format("streams/{}.{}", info.name, infoOf(format).name);
}

std::string streamHeader(StreamFormat format, std::uint64_t frames, std::uint64_t rows) {
    return format == StreamFormat::npy ? npyHeader({frames, rows, 3}) : pc2Header(frames, rows);
}

}  // namespace throng::io
