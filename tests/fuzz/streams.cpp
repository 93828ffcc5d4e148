// SPDX-License-Identifier: Apache-2.0
// Streams, PC2 and NPY: the header, and every frame.
#include <algorithm>
#include <vector>

#include "io/streams/stream_reader.h"
#include "support/harness.h"

using namespace throng;

void fuzz::readOne(std::string_view input) {
    const io::StreamReader stream(put("stream", input));
    if (stream.frames() == 0) return;  // of as many people as the header says
    const std::size_t values = std::size_t{stream.rows()} * kComponents;
    if (values > input.size()) finding("frames that the file has no bytes for");
    constexpr std::uint32_t kMostFrames = 1000;  // those of nobody are as many as the header says
    std::vector<float> frame(values);
    for (std::uint32_t i = 0; i < std::min(stream.frames(), kMostFrames); ++i)
        stream.readFrame(i, frame);
}
