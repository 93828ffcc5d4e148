// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "base/files/input_file.h"
#include "io/streams/packed_reader.h"
#include "io/streams/stream_format.h"

namespace throng::io {

/// Reads a stream in any form. The constructor checks the header and that the file holds exactly the
/// frames it announces; all members throw InputError.
class StreamReader {
  public:
    explicit StreamReader(const std::filesystem::path& path);

    StreamFormat format() const { return format_; }
    std::uint32_t frames() const { return frames_; }
    std::uint32_t rows() const { return rows_; }

    /// One frame: rows x 3 values.
    void readFrame(std::uint32_t frame, std::span<float> values) const { readRows(frame, 0, values); }
    /// values.size() / 3 rows of one frame, from `first_row` on. Of a packed stream, one thread at a time:
    /// what is unpacked is kept for the next call.
    void readRows(std::uint32_t frame, std::uint32_t first_row, std::span<float> values) const;

  private:
    void openPacked();
    void readPc2Header();
    void readNpyHeader();
    void setCounts(std::uint64_t frames, std::uint64_t rows);

    InputFile file_;
    StreamFormat format_ = StreamFormat::npy;
    std::uint64_t data_offset_ = 0;
    std::uint32_t frames_ = 0;
    std::uint32_t rows_ = 0;
    std::unique_ptr<PackedReader> packed_;  ///< where it is that form
};

}  // namespace throng::io
