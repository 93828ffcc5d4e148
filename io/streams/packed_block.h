// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/streams.h"

/// The numbers of the form `packed` (docs/bake.md): whole steps, told by what they are off from what the
/// frames before let expect, byte by byte, compressed with Zstandard.
namespace throng::io {

/// Whole steps of the three components of a row.
using Steps = std::array<std::int32_t, kComponents>;

/// The nearest number of steps; nothing where 32 bits do not hold it.
std::optional<std::int32_t> stepsOf(float value, double step);
/// A step is a power of two, so this is exact, and packing it again gives the same.
inline float valueOf(std::int32_t steps, double step) {
    return static_cast<float>(steps * step);
}

/// Some rows in some frames.
struct BlockSize {
    std::uint32_t frames = 0, rows = 0;
    std::size_t cells() const { return std::size_t{frames} * rows; }
    bool operator==(const BlockSize&) const = default;
};

/// Blocks of more cells or frames there are not: what a reader has to hold of one does not depend on what a
/// file says.
inline constexpr std::size_t kMostCells = std::size_t{1} << 18;
inline constexpr std::uint32_t kMostBlockFrames = 256;

/// Compresses blocks. What is kept between them is memory only.
class BlockEncoder {
  public:
    BlockEncoder();
    ~BlockEncoder();
    BlockEncoder(BlockEncoder&&) noexcept;

    /// @param steps of the first row in the first frame on; a frame further, they are `stride` further
    /// @returns the block's bytes, until the next call
    std::span<const std::byte> encode(const Steps* steps, std::size_t stride, BlockSize size);

  private:
    struct Context;
    std::unique_ptr<Context> context_;
    std::vector<std::byte> content_, packed_;
};

/// Reads them.
class BlockDecoder {
  public:
    BlockDecoder();
    ~BlockDecoder();
    BlockDecoder(BlockDecoder&&) noexcept;
    BlockDecoder& operator=(BlockDecoder&&) noexcept;

    /// @param steps filled frame after frame; @returns false where the bytes are no block of this size
    bool decode(std::span<const std::byte> bytes, BlockSize size, std::span<Steps> steps);

  private:
    struct Context;
    std::unique_ptr<Context> context_;
    std::vector<std::byte> content_;
};

}  // namespace throng::io
