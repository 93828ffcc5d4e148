// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/stream_formats.h"
#include "base/streams.h"

/// The containers of a stream. NumPy arrays (version 1.0) and point caches hold frames x rows x 3 float32,
/// little endian, frame after frame; packed
/// ones are in io/streams/packed_layout.h.
namespace throng::io {

/// Where a stream is in the folder of its bake, with forward slashes.
std::string streamFile(const StreamInfo& info, StreamFormat format);

/// Of arrays and point caches: the size of the header depends on the format only, so that the counts can be
/// mended in place.
constexpr std::size_t headerSize(StreamFormat format) {
    return format == StreamFormat::npy ? 128 : 32;
}

/// The largest count that the format can express, of frames as well as of rows.
constexpr std::uint64_t largestCount(StreamFormat format) {
    return format == StreamFormat::npy ? 0xffffffffu : 0x7fffffffu;
}

/// All bytes before the first frame.
std::string streamHeader(StreamFormat format, std::uint64_t frames, std::uint64_t rows);

}  // namespace throng::io
