// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "io/streams/stream_writer.h"

namespace throng::io {

/// One stream of a bake on its way to the disk, in every form that is asked for. All members throw
/// OutputError.
class StreamFiles {
  public:
    /// @param bake the folder, with a folder `streams` in it; @param formats in which it is written
    /// @param frames_there of files that are gone on with; none where they begin
    StreamFiles(const std::filesystem::path& bake, const StreamInfo& info, const StreamFormats& formats,
                std::uint32_t rows, std::uint32_t expected_frames,
                std::optional<std::uint32_t> frames_there = {});

    const StreamInfo& info() const { return info_; }
    const StreamFormats& formats() const { return formats_; }

    /// As in StreamWriter.
    void append(std::span<const float> frame);
    void flush();
    /// Fills in what rows hold before they enter, as the table says.
    void backFill(std::span<const std::uint32_t> first_alive_frame);
    void finish();

    /// To read back what was written.
    const std::vector<StreamWriter>& writers() const { return writers_; }

  private:
    const StreamInfo& info_;
    StreamFormats formats_;
    std::vector<StreamWriter> writers_;
};

/// The files of some streams, relative to their bake.
std::vector<std::string> filesOf(std::span<const StreamFiles> streams);

}  // namespace throng::io
