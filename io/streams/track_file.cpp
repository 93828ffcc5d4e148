// SPDX-License-Identifier: Apache-2.0
#include "io/streams/track_file.h"

#include <fmt/format.h>

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
