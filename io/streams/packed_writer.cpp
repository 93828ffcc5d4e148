// SPDX-License-Identifier: Apache-2.0
#include "io/streams/packed_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "io/streams/entered_hash.h"

namespace throng::io {
namespace {

constexpr std::uint32_t kNotHeld = std::numeric_limits<std::uint32_t>::max();

template <class T>
void add(std::vector<std::byte>& bytes, std::span<const T> items) {
    const auto raw = std::as_bytes(items);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

/// What a state begins with; entries and the blocks of what is held follow.
struct StateHead {
    std::uint64_t bytes = 0, xxh3 = 0;  // of the file
    std::uint32_t frames = 0, blocks = 0;
};

/// Takes a state apart.
class StateReader {
  public:
    explicit StateReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
    template <class T>
    void take(std::span<T> items) {
        const auto raw = piece(items.size_bytes());
        std::copy(raw.begin(), raw.end(), std::as_writable_bytes(items).begin());
    }
    std::span<const std::byte> piece(std::uint64_t count) {
        if (count > bytes_.size()) throw std::runtime_error("the checkpoint's packed streams end early");
        const auto taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }

  private:
    std::span<const std::byte> bytes_;
};

void hashAgain(const OutputFile& file, Hasher& hash) {
    std::vector<std::byte> piece(std::size_t{1} << 20);
    for (std::uint64_t at = 0; at < file.position(); at += piece.size()) {
        const auto some = std::span(piece).first(std::min<std::uint64_t>(piece.size(), file.position() - at));
        file.readAt(at, some);
        hash.add(some);
    }
}

StateHead headOf(std::span<const std::byte> state) {
    StateHead head;
    StateReader(state).take(std::span(&head, 1));
    return head;
}

}  // namespace

PackedWriter::PackedWriter(const std::filesystem::path& path, const StreamInfo& info, std::uint32_t rows)
    : info_(info),
      rows_(rows),
      block_frames_(blockFrames(rows)),
      file_(path),
      held_(std::size_t{block_frames_} * rows),
      entries_(rows),
      held_entries_(rows, kNotHeld) {
    write(std::as_bytes(std::span(kPackedMagic)));
}

PackedWriter::PackedWriter(const std::filesystem::path& path, const StreamInfo& info, std::uint32_t rows,
                           std::span<const std::byte> state)
    : info_(info),
      rows_(rows),
      block_frames_(blockFrames(rows)),
      file_(OutputFile::goOn(path, headOf(state).bytes)),
      held_(std::size_t{block_frames_} * rows),
      entries_(rows),
      held_entries_(rows, kNotHeld) {
    StateReader reader(state);
    StateHead head;
    reader.take(std::span(&head, 1));
    hashAgain(file_, hash_);
    if (hash_.digest() != head.xxh3) throw InputError(path, kDoesNotFitCheckpoint);
    frames_ = head.frames;
    held_frames_ = frames_ % block_frames_;
    const std::uint64_t groups = blocksOf(rows_, kBlockRows);
    if (head.blocks != frames_ / block_frames_ * groups)
        throw std::runtime_error("the checkpoint's packed streams are of other frames");
    for (std::uint64_t left = head.blocks; left > 0; --left)
        reader.take(std::span(&blocks_.emplace_back(), 1));
    reader.take(std::span(entries_));
    reader.take(std::span(held_entries_));
    if (std::ranges::any_of(held_entries_,
                            [this](std::uint32_t at) { return at != kNotHeld && at >= held_frames_; }))
        throw std::runtime_error("the checkpoint's packed streams tell of frames that are not there");
    BlockDecoder decoder;
    std::vector<Steps> steps;
    for (std::uint32_t first = 0; held_frames_ > 0 && first < rows_; first += kBlockRows) {
        const BlockSize size{held_frames_, std::min(kBlockRows, rows_ - first)};
        std::uint64_t bytes = 0;
        reader.take(std::span(&bytes, 1));
        steps.resize(size.cells());
        if (!decoder.decode(reader.piece(bytes), size, steps))
            throw std::runtime_error("the checkpoint's packed streams are damaged");
        for (std::uint32_t frame = 0; frame < size.frames; ++frame)
            std::copy_n(steps.begin() + static_cast<std::ptrdiff_t>(std::size_t{frame} * size.rows),
                        size.rows,
                        held_.begin() + static_cast<std::ptrdiff_t>(std::size_t{frame} * rows_ + first));
    }
}

void PackedWriter::write(std::span<const std::byte> bytes) {
    file_.write(bytes);
    hash_.add(bytes);
}

void PackedWriter::append(std::span<const float> frame, std::span<const std::uint32_t> first_alive) {
    if (frame.size() != std::size_t{rows_} * kComponents)
        throw std::invalid_argument("a frame has three values for each row");
    Steps* const held = held_.data() + std::size_t{held_frames_} * rows_;
    for (std::size_t i = 0; i < kComponents; ++i) {
        const StreamComponent& component = info_.components[i];
        for (std::uint32_t row = 0; row < rows_; ++row) {
            const float value = frame[row * kComponents + i];
            const auto steps = stepsOf(value, component.step);
            if (!steps || (component.is_whole && valueOf(*steps, component.step) != value))
                throw OutputError(
                    file_.path(),
                    fmt::format("`{}` of person {} in frame {} is {}, which has no packed form; "
                                "--streams npy holds anything",
                                component.name, row, frames_, value));
            held[row][i] = *steps;
        }
    }
    for (std::uint32_t row = 0; row < first_alive.size(); ++row)
        if (first_alive[row] == frames_ && frames_ > 0) {
            entries_[row] = held[row];
            held_entries_[row] = held_frames_;
        }
    ++frames_;
    if (++held_frames_ == block_frames_) writeBlocks();
}

/// Of who enters in one of the frames held, readers show nothing that is written before: what takes the least
/// may be there.
void PackedWriter::fillIn() {
    for (std::uint32_t row = 0; row < rows_; ++row) {
        if (held_entries_[row] == kNotHeld) continue;
        for (std::uint32_t frame = 0; frame < held_entries_[row]; ++frame)
            for (std::size_t i = 0; i < kComponents; ++i)
                if (info_.components[i].before_entry != BackFill::keep)
                    held_[std::size_t{frame} * rows_ + row][i] = entries_[row][i];
    }
}

template <class Take>
void PackedWriter::encodeHeld(Take take) {
    for (std::uint32_t first = 0; held_frames_ > 0 && first < rows_; first += kBlockRows)
        take(encoder_.encode(held_.data() + first, rows_,
                             {held_frames_, std::min(kBlockRows, rows_ - first)}));
}

void PackedWriter::writeBlocks() {
    fillIn();
    encodeHeld([this](std::span<const std::byte> bytes) {
        blocks_.push_back(static_cast<BlockBytes>(bytes.size()));
        write(bytes);
    });
    held_frames_ = 0;
    std::ranges::fill(held_entries_, kNotHeld);
}

std::vector<std::byte> PackedWriter::state() {
    const StateHead head{file_.position(), hash_.digest(), frames_,
                         static_cast<std::uint32_t>(blocks_.size())};
    std::vector<std::byte> bytes;
    add(bytes, std::span(&head, 1));
    add(bytes, std::span<const BlockBytes>(blocks_));
    add(bytes, std::span<const Steps>(entries_));
    add(bytes, std::span<const std::uint32_t>(held_entries_));
    encodeHeld([&](std::span<const std::byte> block) {
        const std::uint64_t size = block.size();
        add(bytes, std::span(&size, 1));
        add(bytes, block);
    });
    return bytes;
}

void PackedWriter::backFill(std::span<const std::uint32_t> first_alive_frame) {
    if (first_alive_frame.size() != rows_)
        throw std::invalid_argument("back-filling needs one frame for each row");
    first_alive_.assign(first_alive_frame.begin(), first_alive_frame.end());
}

std::vector<std::byte> PackedWriter::directory() const {
    PackedHead head;
    head.frames = frames_;
    head.rows = rows_;
    head.block_frames = block_frames_;
    head.block_rows = kBlockRows;
    for (std::size_t i = 0; i < kComponents; ++i)
        head.component[i] = {info_.components[i].step,
                             static_cast<std::uint32_t>(info_.components[i].before_entry), 0};
    std::vector<std::uint32_t> first(rows_, 0);
    std::vector<Steps> late;
    for (std::uint32_t row = 0; row < first_alive_.size(); ++row) {
        if (first_alive_[row] == 0 || first_alive_[row] >= frames_) continue;
        first[row] = first_alive_[row];
        late.push_back(entries_[row]);
    }
    std::vector<std::byte> bytes;
    add(bytes, std::span<const PackedHead>(&head, 1));
    add(bytes, std::span<const BlockBytes>(blocks_));
    add(bytes, std::span<const std::uint32_t>(first));
    add(bytes, std::span<const Steps>(late));
    return bytes;
}

void PackedWriter::finish() {
    if (held_frames_ > 0) writeBlocks();
    const std::vector<std::byte> bytes = directory();
    Hasher hash;
    hash.add(bytes);
    const PackedTail tail{file_.position(), bytes.size(), hash.digest(), kPackedEnd};
    file_.write(bytes);
    file_.write(std::as_bytes(std::span(&tail, 1)));
    file_.finish();
}

}  // namespace throng::io
