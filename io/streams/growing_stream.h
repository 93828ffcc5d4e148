// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "base/files/descriptor.h"
#include "base/streams.h"
#include "io/streams/packed_block.h"
#include "io/streams/stream_format.h"

namespace throng::io {

/// Reads a stream while it is being written, as far as it has come. What a bake fills in at its end, of rows
/// before they enter, is not there yet. The file may be renamed meanwhile. Members throw InputError.
class GrowingStream {
  public:
    /// @param frames that it will have
    GrowingStream(const std::filesystem::path& path, const StreamInfo& info, StreamFormat format,
                  std::uint32_t frames, std::uint32_t rows);

    /// Whole frames that are there now.
    std::uint32_t frames();
    /// One of them: rows x 3 values.
    void readFrame(std::uint32_t frame, std::span<float> values);

  private:
    /// Blocks of some frames, one for each group of rows.
    struct Blocks {
        std::uint64_t offset = 0, bytes = 0;
    };
    std::uint64_t size() const;
    void readAt(std::uint64_t offset, std::span<std::byte> bytes) const;
    bool findBlocks();
    std::uint32_t framesIn(std::size_t group) const;
    void unpack(std::uint32_t group);

    std::filesystem::path path_;
    const StreamInfo& info_;
    StreamFormat format_;
    std::uint32_t expected_, rows_;
    Descriptor file_;
    // Of a packed one:
    std::uint32_t block_frames_;
    std::vector<Blocks> found_;   ///< by group of frames
    std::uint64_t searched_ = 0;  ///< bytes in which everything has been found
    BlockDecoder decoder_;
    std::vector<Steps> steps_;  ///< of the group unpacked last, frame after frame
    std::uint32_t unpacked_;
};

}  // namespace throng::io
