// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "io/streams/packed_writer.h"
#include "io/streams/stream_writer.h"

namespace throng::io {

/// What there is of a stream that is gone on with.
struct StreamSoFar {
    std::uint32_t frames = 0;
    std::span<const std::byte> packed;  ///< PackedWriter::state()
};

/// One stream of a bake on its way to the disk, in every form that is asked for. All members throw
/// OutputError.
class StreamFiles {
  public:
    /// @param bake the folder, with a folder `streams` in it; @param formats in which it is written
    /// @param so_far of files that are gone on with; none where they begin
    StreamFiles(const std::filesystem::path& bake, const StreamInfo& info, const StreamFormats& formats,
                std::uint32_t rows, std::uint32_t expected_frames,
                const std::optional<StreamSoFar>& so_far = {});

    const StreamInfo& info() const { return info_; }
    const StreamFormats& formats() const { return formats_; }

    /// As in StreamWriter.
    /// @param first_alive as in PackedWriter
    void append(std::span<const float> frame, std::span<const std::uint32_t> first_alive = {});
    void flush();
    /// Fills in what rows hold before they enter, as the table says.
    void backFill(std::span<const std::uint32_t> first_alive_frame);
    void finish();

    /// To read back what was written, of the exact forms.
    const std::vector<StreamWriter>& writers() const { return writers_; }
    /// PackedWriter::state(); nothing where it is not packed.
    std::optional<std::vector<std::byte>> packedState();

  private:
    const StreamInfo& info_;
    StreamFormats formats_;
    std::vector<StreamWriter> writers_;
    std::optional<PackedWriter> packed_;
};

/// The files of some streams, relative to their bake.
std::vector<std::string> filesOf(std::span<const StreamFiles> streams);

}  // namespace throng::io
