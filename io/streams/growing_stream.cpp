// SPDX-License-Identifier: Apache-2.0
#include "io/streams/growing_stream.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "base/files/errors.h"
#include "io/streams/packed_layout.h"

namespace throng::io {
namespace {

constexpr std::uint32_t kNoGroup = std::numeric_limits<std::uint32_t>::max();

/// More bytes a block does not take: what does not compress is a little longer than it is.
std::uint64_t mostBytes(BlockSize size) {
    return 2 * sizeof(Steps) * size.cells() + 1024;
}

}  // namespace

GrowingStream::GrowingStream(const std::filesystem::path& path, const StreamInfo& info, StreamFormat format,
                             std::uint32_t frames, std::uint32_t rows)
    : path_(path),
      info_(info),
      format_(format),
      expected_(frames),
      rows_(rows),
      file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)),
      block_frames_(blockFrames(rows)),
      searched_(kPackedMagic.size()),
      unpacked_(kNoGroup) {
    if (!file_.isOpen()) throw InputError(path_, "cannot open: " + std::generic_category().message(errno));
}

std::uint64_t GrowingStream::size() const {
    struct stat facts {};
    if (::fstat(file_.get(), &facts) != 0 || !S_ISREG(facts.st_mode))
        throw InputError(path_, "not a regular file");
    return static_cast<std::uint64_t>(facts.st_size);
}

void GrowingStream::readAt(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t got = ::pread(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw InputError(path_, "cannot read: " + std::generic_category().message(errno));
        if (got == 0) throw InputError(path_, "has become shorter");
        bytes = bytes.subspan(static_cast<std::size_t>(got));
        offset += static_cast<std::uint64_t>(got);
    }
}

std::uint32_t GrowingStream::frames() {
    if (rows_ == 0) return expected_;
    std::uint64_t there = 0;
    if (format_ == StreamFormat::packed) {
        while (found_.size() * block_frames_ < expected_ && findBlocks()) {
        }
        there = found_.size() * block_frames_;
    } else if (const std::uint64_t bytes = size(); bytes > headerSize(format_)) {
        there = (bytes - headerSize(format_)) / (std::uint64_t{rows_} * kComponents * sizeof(float));
    }
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(there, expected_));
}

/// The last group has what is left.
std::uint32_t GrowingStream::framesIn(std::size_t group) const {
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(block_frames_, expected_ - std::uint64_t{group} * block_frames_));
}

/// The blocks behind those that are known. How long one is says its own header; the directory comes last.
bool GrowingStream::findBlocks() {
    const std::uint64_t end = size();
    std::uint64_t at = searched_;
    std::vector<std::byte> piece;
    for (std::uint32_t first = 0; first < rows_; first += kBlockRows) {
        const BlockSize block{framesIn(found_.size()), std::min(kBlockRows, rows_ - first)};
        if (at >= end) return false;
        piece.resize(std::min(mostBytes(block), end - at));
        readAt(at, piece);
        const std::size_t bytes = ZSTD_findFrameCompressedSize(piece.data(), piece.size());
        if (ZSTD_isError(bytes)) return false;  // not all of it is there yet, or it is the directory
        at += bytes;
    }
    found_.push_back({searched_, at - searched_});
    searched_ = at;
    return true;
}

void GrowingStream::unpack(std::uint32_t group) {
    const Blocks& blocks = found_.at(group);
    std::vector<std::byte> bytes(blocks.bytes);
    readAt(blocks.offset, bytes);
    steps_.resize(std::size_t{block_frames_} * rows_);
    std::vector<Steps> steps;
    std::span<const std::byte> left = bytes;
    for (std::uint32_t first = 0; first < rows_; first += kBlockRows) {
        const BlockSize block{framesIn(group), std::min(kBlockRows, rows_ - first)};
        const std::size_t length = ZSTD_findFrameCompressedSize(left.data(), left.size());
        steps.resize(block.cells());
        if (ZSTD_isError(length) || !decoder_.decode(left.first(length), block, steps))
            throw InputError(path_, fmt::format("frames from {} on are damaged", group * block_frames_));
        left = left.subspan(length);
        for (std::uint32_t frame = 0; frame < block.frames; ++frame)
            std::copy_n(steps.begin() + static_cast<std::ptrdiff_t>(std::size_t{frame} * block.rows),
                        block.rows,
                        steps_.begin() + static_cast<std::ptrdiff_t>(std::size_t{frame} * rows_ + first));
    }
    unpacked_ = group;
}

void GrowingStream::readFrame(std::uint32_t frame, std::span<float> values) {
    if (values.size() != std::size_t{rows_} * kComponents || frame >= frames())
        throw std::out_of_range("no such frame in the stream so far");
    if (format_ != StreamFormat::packed) {
        readAt(headerSize(format_) + std::uint64_t{frame} * values.size_bytes(),
               std::as_writable_bytes(values));
        return;
    }
    if (unpacked_ != frame / block_frames_) unpack(frame / block_frames_);
    const Steps* const row = steps_.data() + std::size_t{frame % block_frames_} * rows_;
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = valueOf(row[i / kComponents][i % kComponents], info_.components[i % kComponents].step);
}

}  // namespace throng::io
