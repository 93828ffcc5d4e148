// SPDX-License-Identifier: Apache-2.0
#include "io/streams/stream_writer.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace throng::io {
namespace {

constexpr std::uint64_t kChunkBytes = std::uint64_t{4} << 20;

/// Walks one chunk of consecutive frames from its end to its beginning.
class ChunkFiller {
  public:
    ChunkFiller(std::span<const std::uint32_t> first_alive_frame,
                const std::array<BackFill, kComponents>& rule, std::uint32_t frames)
        : first_alive_frame_(first_alive_frame), rule_(rule), fill_(first_alive_frame.size() * kComponents) {
        for (std::uint32_t row = 0; row < first_alive_frame.size(); ++row)
            if (first_alive_frame[row] > 0 && first_alive_frame[row] < frames) late_rows_.push_back(row);
    }

    /// The frames from here on need no change; 0 when no row comes late.
    std::uint32_t lastFrame() const {
        std::uint32_t last = 0;
        for (const std::uint32_t row : late_rows_)
            last = std::max(last, first_alive_frame_[row]);
        return last;
    }

    void apply(std::uint32_t frame, std::span<float> values) {
        for (const std::uint32_t row : late_rows_) {
            const std::size_t at = std::size_t{row} * kComponents;
            if (frame == first_alive_frame_[row])
                std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(at), kComponents,
                            fill_.begin() + static_cast<std::ptrdiff_t>(at));
            else if (frame < first_alive_frame_[row])
                for (std::size_t component = 0; component < kComponents; ++component) {
                    if (rule_[component] == BackFill::first_alive)
                        values[at + component] = fill_[at + component];
                    if (rule_[component] == BackFill::zero) values[at + component] = 0.0f;
                }
        }
    }

  private:
    std::span<const std::uint32_t> first_alive_frame_;
    std::array<BackFill, kComponents> rule_;
    std::vector<std::uint32_t> late_rows_;
    std::vector<float> fill_;
};

}  // namespace

StreamWriter::StreamWriter(const std::filesystem::path& path, StreamFormat format, std::uint32_t rows,
                           std::uint32_t expected_frames)
    : file_(path), format_(format), rows_(rows), expected_frames_(expected_frames) {
    if (std::max(rows, expected_frames) > largestCount(format))
        throw OutputError(path, "the format cannot count this many frames or people");
    file_.write(streamHeader(format, expected_frames, rows));
}

StreamWriter::StreamWriter(const std::filesystem::path& path, StreamFormat format, std::uint32_t rows,
                           std::uint32_t expected_frames, std::uint32_t frames)
    : file_(OutputFile::goOn(
          path, headerSize(format) + std::uint64_t{rows} * kComponents * sizeof(float) * frames)),
      format_(format),
      rows_(rows),
      expected_frames_(expected_frames),
      frames_(frames) {}

void StreamWriter::append(std::span<const float> frame) {
    if (frame.size_bytes() != frameBytes())
        throw std::invalid_argument("a frame has three values for each row");
    file_.write(std::as_bytes(frame));
    ++frames_;
}

void StreamWriter::readBack(std::uint32_t frame, std::span<float> values) const {
    file_.readAt(headerSize(format_) + frame * frameBytes(), std::as_writable_bytes(values));
}

/// A row's spawn point is known only once it has entered, which may be minutes into the shot. Going through
/// the file backwards meets that frame before all the frames that need its values, so one pass and one
/// frame's worth of memory beside the chunk are enough, however long the bake.
void StreamWriter::backFill(std::span<const std::uint32_t> first_alive_frame,
                            const std::array<BackFill, kComponents>& rule) {
    if (first_alive_frame.size() != rows_)
        throw std::invalid_argument("back-filling needs one frame for each row");
    ChunkFiller filler(first_alive_frame, rule, frames_);
    const std::uint32_t last = filler.lastFrame();
    if (last == 0) return;

    const std::size_t frame_values = std::size_t{rows_} * kComponents;
    const auto chunk_frames = static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(kChunkBytes / frameBytes(), 1, std::uint64_t{last} + 1));
    std::vector<float> chunk(chunk_frames * frame_values);
    for (std::uint32_t end = last + 1; end > 0;) {
        const std::uint32_t begin = end - std::min(end, chunk_frames);
        const std::span<float> values = std::span(chunk).first((end - begin) * frame_values);
        const std::uint64_t offset = headerSize(format_) + begin * frameBytes();
        file_.readAt(offset, std::as_writable_bytes(values));
        for (std::uint32_t frame = end; frame-- > begin;)
            filler.apply(frame, values.subspan((frame - begin) * frame_values, frame_values));
        file_.writeAt(offset, std::as_bytes(values));
        end = begin;
    }
}

void StreamWriter::finish() {
    if (frames_ > largestCount(format_))
        throw OutputError(path(), "the format cannot count this many frames");
    if (frames_ != expected_frames_) {
        const std::string header = streamHeader(format_, frames_, rows_);
        file_.writeAt(0, std::as_bytes(std::span(header)));
    }
    file_.finish();
}

}  // namespace throng::io
