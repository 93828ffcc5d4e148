// SPDX-License-Identifier: Apache-2.0
#include "base/streams.h"

#include <algorithm>

#include "base/tables.h"

namespace throng {
namespace {

static_assert(isInOrder(kStreams), "kStreams has a row for each stream, in their order");

constexpr bool isPowerOfTwo(double step) {
    while (step > 0.0 && step < 1.0)
        step *= 2.0;
    return step == 1.0;
}
static_assert(std::ranges::all_of(kStreams,
                                  [](const StreamInfo& info) {
                                      return std::ranges::all_of(info.components, isPowerOfTwo,
                                                                 &StreamComponent::step);
                                  }),
              "a step of the form `packed` is a power of two, up to 1");

}  // namespace

StreamChoice streamsOf(bool has_terrain, const StreamChoice& asked) {
    StreamChoice streams;
    for (const StreamInfo& info : kStreams)
        streams[info.id] = info.source == StreamSource::motion ||
                           (info.source == StreamSource::terrain && has_terrain) ||
                           (isAskedFor(info) && asked[info.id]);
    return streams;
}

StreamChoice fromDevice(const StreamChoice& streams) {
    StreamChoice found;
    for (const StreamInfo& info : kStreams)
        found[info.id] = info.source == StreamSource::device && streams[info.id];
    return found;
}

std::size_t countOf(const StreamChoice& streams) {
    return static_cast<std::size_t>(
        std::ranges::count_if(kStreams, [&](const StreamInfo& info) { return streams[info.id]; }));
}

std::string identityOf(const StreamChoice& asked) {
    std::string names;
    for (const StreamInfo& info : kStreams)
        if (asked[info.id]) names.append(names.empty() ? "" : "+").append(info.name);
    return names.empty() ? "false" : names == infoOf(Stream::density).name ? "true" : names;
}

}  // namespace throng
