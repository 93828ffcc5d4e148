// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "base/files/input_file.h"
#include "io/streams/packed_layout.h"

namespace throng::io {

/// Reads a stream in the form `packed`: of a frame, the blocks that have it, which are kept for the next
/// ones. What a file says is checked before anything is made of its size. All members throw InputError.
class PackedReader {
  public:
    /// @param file has to live as long as the reader
    explicit PackedReader(const InputFile& file);

    std::uint32_t frames() const { return head_.frames; }
    std::uint32_t rows() const { return head_.rows; }

    /// values.size() / 3 rows of one frame, from `first_row` on; there have to be so many.
    void readRows(const InputFile& file, std::uint32_t frame, std::uint32_t first_row,
                  std::span<float> values);

  private:
    struct Block {
        std::uint64_t offset = 0;
        BlockBytes bytes = 0;
    };
    struct Held {
        std::uint64_t used = 0;  ///< when, by a count of uses
        std::vector<Steps> steps;
    };
    void readDirectory(const InputFile& file, const std::vector<std::byte>& directory, std::uint64_t end);
    void readEntries(const InputFile& file, std::span<const std::byte> bytes);
    const std::vector<Steps>& block(const InputFile& file, std::uint64_t index, BlockSize size);
    std::vector<Steps> decoded(const InputFile& file, std::uint64_t index, BlockSize size);

    PackedHead head_;
    std::vector<Block> blocks_;
    std::vector<std::uint32_t> first_;  ///< per row, the frame it enters in; 0: it is as it is written
    std::vector<std::uint32_t> late_;   ///< per row, which of the entries is its
    std::vector<Steps> entries_;
    BlockDecoder decoder_;
    std::map<std::uint64_t, Held> held_;
    std::size_t most_held_ = 1;
    std::uint64_t uses_ = 0;
};

}  // namespace throng::io
