// SPDX-License-Identifier: Apache-2.0
#include "io/streams/track_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "base/files/input_file.h"
#include "base/files/output_file.h"
#include "io/streams/npy_header.h"

namespace throng::io {

void writeTrack(const std::filesystem::path& path, std::span<const float> track, const TrackShape& shape) {
    const std::size_t count = shape[0] * shape[1] * shape[2];
    const std::span<const float> known = track.first(std::min(track.size(), count));
    std::vector<float> values(known.begin(), known.end());
    values.resize(count);
    OutputFile file(path);
    file.write(npyHeader({shape[0], shape[1], shape[2]}));
    file.write(std::as_bytes(std::span<const float>(values)));
    file.finish();
}

TrackWriter::TrackWriter(const std::filesystem::path& path, const TrackShape& shape)
    : file_(path), values_(shape[1] * shape[2]) {
    file_.write(npyHeader({shape[0], shape[1], shape[2]}));
}

void TrackWriter::add(std::span<const float> frames) {
    file_.write(std::as_bytes(frames));
    frames_ += frames.size() / values_;
}

GrowingTrack::GrowingTrack(const std::filesystem::path& path, const TrackShape& shape)
    : path_(path),
      file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)),
      values_(shape[1] * shape[2]),
      expected_(static_cast<std::uint32_t>(shape[0])) {
    const std::string header = npyHeader({shape[0], shape[1], shape[2]});
    begin_ = header.size();
    std::string there(begin_, '\0');
    if (!file_.isOpen() || ::pread(file_.get(), there.data(), begin_, 0) != static_cast<ssize_t>(begin_) ||
        there != header)
        throw InputError(path_, fmt::format("expected {} frames of {} things", shape[0], shape[1]));
}

std::uint32_t GrowingTrack::frames() const {
    struct stat about {};
    if (::fstat(file_.get(), &about) != 0) throw InputError(path_, "cannot be asked for its size");
    const auto bytes = static_cast<std::size_t>(about.st_size);
    if (bytes < begin_) return 0;
    const std::size_t whole = (bytes - begin_) / (values_ * sizeof(float));
    return static_cast<std::uint32_t>(std::min<std::size_t>(whole, expected_));
}

void GrowingTrack::readFrame(std::uint32_t frame, std::span<float> values) const {
    const std::size_t bytes = values_ * sizeof(float);
    const auto at = static_cast<off_t>(begin_ + frame * bytes);
    if (values.size() != values_ ||
        ::pread(file_.get(), values.data(), bytes, at) != static_cast<ssize_t>(bytes))
        throw InputError(path_, fmt::format("frame {} cannot be read", frame + 1));
}

std::vector<float> readTrack(const std::filesystem::path& path, const TrackShape& shape, const char* things) {
    const std::size_t count = shape[0] * shape[1] * shape[2];
    const std::string header = npyHeader({shape[0], shape[1], shape[2]});
    const std::string content = readFile(path, header.size() + count * sizeof(float));
    if (content.size() != header.size() + count * sizeof(float) || !content.starts_with(header))
        throw InputError(path, fmt::format("expected {} frames of {} {}", shape[0], shape[1], things));
    std::vector<float> values(count);
    std::memcpy(values.data(), content.data() + header.size(), count * sizeof(float));
    return values;
}

}  // namespace throng::io
