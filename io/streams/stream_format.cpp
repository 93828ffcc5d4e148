// SPDX-License-Identifier: Apache-2.0
#include "io/streams/stream_format.h"

#include <fmt/format.h>

#include <cstring>

namespace throng::io {
namespace {

template <typename T>
void append(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

std::string npyHeader(std::uint64_t frames, std::uint64_t rows) {
    constexpr std::size_t kPreamble = 10;  // magic, version, length of the description
    std::string bytes("\x93NUMPY\x01\x00", 8);
    append(bytes, static_cast<std::uint16_t>(headerSize(StreamFormat::npy) - kPreamble));
    bytes += fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, 3), }}", frames, rows);
    bytes.resize(headerSize(StreamFormat::npy) - 1, ' ');
    return bytes + '\n';
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
    return format == StreamFormat::npy ? npyHeader(frames, rows) : pc2Header(frames, rows);
}

}  // namespace throng::io
