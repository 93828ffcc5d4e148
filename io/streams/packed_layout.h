// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/streams.h"
#include "io/streams/packed_block.h"

/// How a file of the form `packed` is laid out (docs/bake.md): the magic word, blocks, the directory, the
/// tail. All little-endian, as they lie in memory.
namespace throng::io {

inline constexpr std::array<char, 8> kPackedMagic = {'T', 'H', 'R', 'O', 'N', 'G', 'P', '1'};
inline constexpr std::array<char, 8> kPackedEnd = {'T', 'H', 'R', 'O', 'N', 'G', 'P', 'E'};
inline constexpr std::uint32_t kPackedVersion = 1;

/// The last bytes of the file.
struct PackedTail {
    std::uint64_t directory = 0;  ///< where it begins
    std::uint64_t bytes = 0;      ///< of it
    std::uint64_t xxh3 = 0;       ///< of it
    std::array<char, 8> end = kPackedEnd;
};

/// What the directory begins with.
struct PackedHead {
    std::uint32_t version = kPackedVersion;
    std::uint32_t frames = 0, rows = 0;
    std::uint32_t block_frames = 0, block_rows = 0;
    std::uint32_t components = kComponents;
    struct Component {
        double step = 1.0;
        std::uint32_t before_entry = 0;  ///< BackFill
        std::uint32_t reserved = 0;
    };
    std::array<Component, kComponents> component{};
};

/// Bytes of each block, in the directory behind the head: those of the first frames first, then by rows. What
/// is in it, Zstandard's own checksum tells.
using BlockBytes = std::uint32_t;

static_assert(sizeof(PackedTail) == 32 && sizeof(PackedHead) == 72);
static_assert(static_cast<int>(BackFill::keep) == 0 && static_cast<int>(BackFill::first_alive) == 1 &&
              static_cast<int>(BackFill::zero) == 2);

/// Rows of a block, and its frames: fewer where the rows are so many that a writer had to hold too much.
inline constexpr std::uint32_t kBlockRows = 1024;
constexpr std::uint32_t blockFrames(std::uint32_t rows) {
    constexpr std::uint32_t kHeld = 1u << 22, kFewest = 8, kMost = 64;
    return std::clamp(kHeld / std::max(rows, 1u), kFewest, kMost);
}

constexpr std::uint64_t blocksOf(std::uint64_t things, std::uint64_t in_block) {
    return (things + in_block - 1) / in_block;
}

}  // namespace throng::io
