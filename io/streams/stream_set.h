// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "io/streams/stream_reader.h"

namespace throng::io {

/// The streams of one bake, of one size, for reading. A stream is opened when it is first asked for.
class StreamSet {
  public:
    /// @param bake the folder; @param streams that it has; @param formats in which it has them
    StreamSet(std::filesystem::path bake, const StreamChoice& streams, const StreamFormats& formats,
              std::uint32_t frames, std::uint32_t rows);

    std::uint32_t frames() const { return frames_; }
    std::uint32_t rows() const { return rows_; }
    bool has(Stream stream) const { return streams_[stream]; }

    /// Throws InputError when the bake has no such stream, or one of another size than the others.
    const StreamReader& operator[](Stream stream) const;

  private:
    std::filesystem::path bake_;
    StreamChoice streams_;
    StreamFormat format_;  ///< in which they are read
    std::uint32_t frames_ = 0, rows_ = 0;
    mutable PerStream<std::optional<StreamReader>> readers_;
};

}  // namespace throng::io
