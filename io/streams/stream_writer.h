// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

#include "base/files/output_file.h"
#include "io/streams/stream_format.h"

namespace throng::io {

/// Writes one stream in one format. All members throw OutputError.
class StreamWriter {
  public:
    /// Creates the file with a header for `expected_frames`; finish() mends it if there came fewer or more.
    StreamWriter(const std::filesystem::path& path, StreamFormat format, std::uint32_t rows,
                 std::uint32_t expected_frames);

    /// Goes on with a file of which the first `frames` frames are to be kept.
    StreamWriter(const std::filesystem::path& path, StreamFormat format, std::uint32_t rows,
                 std::uint32_t expected_frames, std::uint32_t frames);

    /// Appends one frame: exactly rows x 3 values (std::invalid_argument otherwise).
    void append(std::span<const float> frame);

    /// Reads a frame that has been written.
    void readBack(std::uint32_t frame, std::span<float> values) const;

    /// Rewrites what rows hold in the frames before they are first alive. `first_alive_frame` has one frame
    /// number a row; 0 or a number that was never reached leaves the row as it is.
    void backFill(std::span<const std::uint32_t> first_alive_frame,
                  const std::array<BackFill, kComponents>& rule);

    /// Waits until all frames so far are on the disk.
    void flush() { file_.flush(); }

    /// Mends the header, waits for the disk and closes.
    void finish();

    std::uint32_t frames() const { return frames_; }
    const std::filesystem::path& path() const { return file_.path(); }

  private:
    std::uint64_t frameBytes() const { return std::uint64_t{rows_} * kComponents * sizeof(float); }

    OutputFile file_;
    StreamFormat format_;
    std::uint32_t rows_ = 0;
    std::uint32_t expected_frames_ = 0;
    std::uint32_t frames_ = 0;
};

}  // namespace throng::io
