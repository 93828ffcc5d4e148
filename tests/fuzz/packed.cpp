// SPDX-License-Identifier: Apache-2.0
// What is in a packed stream: the directory, and blocks before they are compressed. As they lie in files,
// most of what is changed by chance would be known by its checksum.
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "base/files/hash.h"
#include "io/streams/packed_layout.h"
#include "io/streams/stream_reader.h"
#include "support/harness.h"

using namespace throng;

namespace {

/// A piece with two bytes of length before it, which is taken off.
std::string_view takePiece(std::string_view& input) {
    std::uint16_t length = 0;
    if (input.size() < sizeof length) return std::exchange(input, {});
    std::memcpy(&length, input.data(), sizeof length);
    const std::string_view piece = input.substr(sizeof length, length);
    input.remove_prefix(std::min(input.size(), sizeof length + length));
    return piece;
}

std::string compressed(std::string_view content) {
    std::string bytes(ZSTD_compressBound(content.size()), '\0');
    bytes.resize(ZSTD_compress(bytes.data(), bytes.size(), content.data(), content.size(), 1));
    return bytes;
}

std::string fileOf(std::string_view input) {
    std::string directory(takePiece(input));
    std::string file(io::kPackedMagic.begin(), io::kPackedMagic.end());
    for (std::size_t at = sizeof(io::PackedHead); !input.empty(); at += sizeof(io::BlockBytes)) {
        const std::string block = compressed(takePiece(input));
        const auto bytes = static_cast<io::BlockBytes>(block.size());
        if (at + sizeof bytes <= directory.size()) std::memcpy(directory.data() + at, &bytes, sizeof bytes);
        file += block;
    }
    Hasher hasher;
    hasher.add(std::as_bytes(std::span(directory)));
    const io::PackedTail tail{file.size(), directory.size(), hasher.digest(), io::kPackedEnd};
    file += directory;
    return file.append(reinterpret_cast<const char*>(&tail), sizeof tail);
}

}  // namespace

void fuzz::readOne(std::string_view input) {
    const std::string file = fileOf(input);
    const io::StreamReader stream(put("stream", file));
    if (stream.frames() == 0) return;
    const std::size_t values = std::size_t{stream.rows()} * kComponents;
    if (values > file.size()) finding("frames that the file has no bytes for");
    constexpr std::uint32_t kMostFrames = 300;
    std::vector<float> frame(values);
    for (std::uint32_t i = 0; i < std::min(stream.frames(), kMostFrames); ++i)
        stream.readFrame(i, frame);
}
