// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "base/files/hash.h"
#include "base/files/output_file.h"
#include "io/streams/packed_block.h"
#include "io/streams/packed_layout.h"

namespace throng::io {

/// Writes one stream in the form `packed`. Frames are held until a block of them is full; nothing that has
/// been written is touched again. All members throw OutputError.
class PackedWriter {
  public:
    PackedWriter(const std::filesystem::path& path, const StreamInfo& info, std::uint32_t rows);
    /// Goes on from what state() gave. Throws InputError where the file is not what it was then, and
    /// std::runtime_error where the state is none of this stream.
    PackedWriter(const std::filesystem::path& path, const StreamInfo& info, std::uint32_t rows,
                 std::span<const std::byte> state);

    /// Appends one frame: rows x 3 values.
    /// @param first_alive per row, the first frame it is alive in, as far as is known up to this frame; none
    /// where nothing is to be filled in
    void append(std::span<const float> frame, std::span<const std::uint32_t> first_alive);
    /// All that a later run needs to go on from here, beside the file.
    std::vector<std::byte> state();
    void flush() { file_.flush(); }

    /// Tells readers what rows hold before they enter. As in StreamWriter.
    void backFill(std::span<const std::uint32_t> first_alive_frame);
    void finish();

  private:
    void writeBlocks();
    void fillIn();
    /// Calls take(bytes) for each block of the frames that are held.
    template <class Take>
    void encodeHeld(Take take);
    void write(std::span<const std::byte> bytes);
    std::vector<std::byte> directory() const;

    const StreamInfo& info_;
    std::uint32_t rows_, block_frames_;
    OutputFile file_;
    Hasher hash_;  ///< of the file so far
    BlockEncoder encoder_;
    std::uint32_t frames_ = 0;
    std::uint32_t held_frames_ = 0;
    std::vector<Steps> held_;                  ///< the last of the frames, not yet written
    std::vector<Steps> entries_;               ///< per row, in the first frame it is alive in
    std::vector<std::uint32_t> held_entries_;  ///< per row, which of the frames held that is; or none
    std::vector<BlockBytes> blocks_;
    std::vector<std::uint32_t> first_alive_;  ///< once it is told
};

}  // namespace throng::io
