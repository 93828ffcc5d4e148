// SPDX-License-Identifier: Apache-2.0
#include "io/streams/packed_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/files/hash.h"

namespace throng::io {
namespace {

constexpr std::uint64_t kMostHeldBytes = std::uint64_t{128} << 20;

std::uint64_t hashOf(std::span<const std::byte> bytes) {
    Hasher hash;
    hash.add(bytes);
    return hash.digest();
}

PackedTail tailOf(const InputFile& file) {
    PackedTail tail;
    if (file.size() < kPackedMagic.size() + sizeof(PackedHead) + sizeof tail)
        throw InputError(file.path(), "too short to be a packed stream");
    file.readAt(file.size() - sizeof tail, std::as_writable_bytes(std::span(&tail, 1)));
    if (tail.end != kPackedEnd)
        throw InputError(file.path(),
                         "a packed stream without its end: truncated, or not completely written");
    const std::uint64_t room = file.size() - sizeof tail - kPackedMagic.size();
    if (tail.bytes < sizeof(PackedHead) || tail.bytes > room ||
        tail.directory != file.size() - sizeof tail - tail.bytes)
        throw InputError(file.path(), "a packed stream whose directory is not where it says");
    return tail;
}

/// A power of two between the finest and the coarsest of any use.
bool isStep(double step) {
    int exponent = 0;
    return std::isfinite(step) && std::frexp(step, &exponent) == 0.5 && exponent >= -40 && exponent <= 40;
}

}  // namespace

PackedReader::PackedReader(const InputFile& file) {
    const PackedTail tail = tailOf(file);
    std::vector<std::byte> directory(tail.bytes);
    file.readAt(tail.directory, directory);
    if (hashOf(directory) != tail.xxh3)
        throw InputError(file.path(), "a packed stream whose directory does not fit its checksum");
    std::memcpy(&head_, directory.data(), sizeof head_);
    readDirectory(file, directory, tail.directory);
    const std::uint64_t block_bytes = std::uint64_t{head_.block_frames} * head_.block_rows * sizeof(Steps);
    const std::uint64_t groups = blocksOf(head_.rows, head_.block_rows);
    most_held_ = std::clamp<std::uint64_t>(kMostHeldBytes / block_bytes, 1, groups + 1);
}

void PackedReader::readDirectory(const InputFile& file, const std::vector<std::byte>& directory,
                                 std::uint64_t end) {
    if (head_.version != kPackedVersion || head_.components != kComponents)
        throw InputError(file.path(), "a packed stream of a version that is not known here");
    const std::uint64_t cells = std::uint64_t{head_.block_frames} * head_.block_rows;
    if (cells == 0 || cells > kMostCells || head_.block_frames > kMostBlockFrames)
        throw InputError(file.path(), "a packed stream with blocks of a size that there is not");
    for (const PackedHead::Component& component : head_.component)
        if (!isStep(component.step) || component.before_entry > static_cast<std::uint32_t>(BackFill::zero))
            throw InputError(file.path(), "a packed stream whose components are not understood");
    const std::uint64_t blocks =
        blocksOf(head_.frames, head_.block_frames) * blocksOf(head_.rows, head_.block_rows);
    std::uint64_t left = directory.size() - sizeof head_;
    // Divided rather than multiplied: what a file says may not fit 64 bits.
    if (blocks > left / sizeof(BlockBytes) ||
        head_.rows > (left - blocks * sizeof(BlockBytes)) / sizeof(std::uint32_t))
        throw InputError(file.path(),
                         fmt::format("a packed stream whose directory of {} bytes has no room for "
                                     "{} frames of {} people",
                                     directory.size(), head_.frames, head_.rows));
    std::uint64_t offset = kPackedMagic.size();
    blocks_.resize(blocks);
    for (std::uint64_t i = 0; i < blocks; ++i) {
        BlockBytes bytes = 0;
        std::memcpy(&bytes, directory.data() + sizeof head_ + i * sizeof bytes, sizeof bytes);
        if (bytes > end - offset)
            throw InputError(file.path(), "a packed stream whose blocks are longer than the file");
        blocks_[i] = {offset, bytes};
        offset += bytes;
    }
    if (offset != end) throw InputError(file.path(), "a packed stream with something between its blocks");
    readEntries(file, std::span(directory).subspan(sizeof head_ + blocks * sizeof(BlockBytes)));
}

void PackedReader::readEntries(const InputFile& file, std::span<const std::byte> bytes) {
    first_.resize(head_.rows);
    late_.resize(head_.rows);
    const std::span<std::byte> first = std::as_writable_bytes(std::span(first_));
    std::ranges::copy(bytes.first(first.size()), first.begin());
    std::uint32_t late = 0;
    for (std::uint32_t row = 0; row < head_.rows; ++row) {
        late_[row] = late;
        late += first_[row] > 0;
    }
    bytes = bytes.subspan(first.size());
    if (bytes.size() != std::uint64_t{late} * sizeof(Steps))
        throw InputError(file.path(), "a packed stream that does not tell how everybody enters");
    entries_.resize(late);
    std::ranges::copy(bytes, std::as_writable_bytes(std::span(entries_)).begin());
}

std::vector<Steps> PackedReader::decoded(const InputFile& file, std::uint64_t index, BlockSize size) {
    const Block& block = blocks_[index];
    // What does not compress is a little longer than it is.
    if (block.bytes > 2 * sizeof(Steps) * size.cells() + 1024)
        throw InputError(file.path(), fmt::format("block {} is longer than what is in it", index));
    std::vector<std::byte> bytes(block.bytes);
    file.readAt(block.offset, bytes);
    std::vector<Steps> steps(size.cells());
    if (!decoder_.decode(bytes, size, steps))
        throw InputError(file.path(), fmt::format("block {} is damaged", index));
    return steps;
}

const std::vector<Steps>& PackedReader::block(const InputFile& file, std::uint64_t index, BlockSize size) {
    const auto known = held_.find(index);
    if (known == held_.end()) {
        std::vector<Steps> steps = decoded(file, index, size);
        while (held_.size() >= most_held_)
            held_.erase(
                std::ranges::min_element(held_, {}, [](const auto& each) { return each.second.used; }));
        return held_.emplace(index, Held{++uses_, std::move(steps)}).first->second.steps;
    }
    known->second.used = ++uses_;
    return known->second.steps;
}

void PackedReader::readRows(const InputFile& file, std::uint32_t frame, std::uint32_t first_row,
                            std::span<float> values) {
    const auto count = static_cast<std::uint32_t>(values.size() / kComponents);
    const std::uint64_t groups = blocksOf(head_.rows, head_.block_rows);
    const std::uint32_t first_frame = frame / head_.block_frames * head_.block_frames;
    for (std::uint32_t row = first_row; row < first_row + count;) {
        const std::uint32_t group = row / head_.block_rows;
        const std::uint32_t begin = group * head_.block_rows;
        const BlockSize size{std::min(head_.block_frames, head_.frames - first_frame),
                             std::min(head_.block_rows, head_.rows - begin)};
        const std::vector<Steps>& steps = block(file, frame / head_.block_frames * groups + group, size);
        for (; row < std::min(begin + size.rows, first_row + count); ++row) {
            const Steps& written = steps[std::size_t{frame - first_frame} * size.rows + (row - begin)];
            const bool is_early = frame < first_[row];
            for (std::size_t i = 0; i < kComponents; ++i) {
                const auto rule = static_cast<BackFill>(head_.component[i].before_entry);
                std::int32_t shown = written[i];
                if (is_early && rule == BackFill::first_alive) shown = entries_[late_[row]][i];
                if (is_early && rule == BackFill::zero) shown = 0;
                values[std::size_t{row - first_row} * kComponents + i] =
                    valueOf(shown, head_.component[i].step);
            }
        }
    }
}

}  // namespace throng::io
