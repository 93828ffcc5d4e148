// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "base/files/descriptor.h"
#include "base/files/output_file.h"

namespace throng::io {

/// Frames, things in each of them, and numbers of each thing.
using TrackShape = std::array<std::size_t, 3>;

/// Writes so many numbers as an .npy file; what is not known is zero. Throws OutputError.
void writeTrack(const std::filesystem::path& path, std::span<const float> track, const TrackShape& shape);

/// The same file while it grows: as long as all of it will be, in its header; as long as what is known, on
/// the disk.
class TrackWriter {
  public:
    /// @param shape with as many frames as are expected. Throws OutputError.
    TrackWriter(const std::filesystem::path& path, const TrackShape& shape);
    /// Whole frames.
    void add(std::span<const float> frames);
    std::size_t framesWritten() const { return frames_; }

  private:
    OutputFile file_;
    std::size_t values_;  // of one frame
    std::size_t frames_ = 0;
};

/// Reads a file while it is being written, as far as it has come. Members throw InputError.
class GrowingTrack {
  public:
    GrowingTrack(const std::filesystem::path& path, const TrackShape& shape);
    /// Whole frames that are there now.
    std::uint32_t frames() const;
    void readFrame(std::uint32_t frame, std::span<float> values) const;

  private:
    std::filesystem::path path_;
    Descriptor file_;
    std::size_t begin_ = 0, values_;
    std::uint32_t expected_;
};

/// Reads them again. @param things what they are of, for messages. Throws InputError.
std::vector<float> readTrack(const std::filesystem::path& path, const TrackShape& shape, const char* things);

}  // namespace throng::io
