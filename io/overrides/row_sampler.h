// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "authoring/overrides/overrides.h"
#include "io/streams/stream_set.h"

namespace throng::io {

/// One person in one frame, as the streams have it: of those that the bake has not, zeros.
using RowSample = PerStream<std::array<float, kComponents>>;

/// The bake's frame that somebody who entered at `first` shows in a frame of the shot.
inline double sourceFrame(double frame, double first, const authoring::PersonChange& change) {
    return first + (frame - first - change.delay) * change.speed;
}

/// Turns and moves what a person does about `pivot`, and takes away whoever hides.
void changeSample(RowSample& sample, const std::array<float, kComponents>& pivot,
                  const authoring::PersonChange& change);

/// As if nobody were there.
void hideSample(RowSample& sample);

/// Between frames as the table of streams says. Beyond the bake's ends people stand as they did there.
/// @param whole the row in one of so many frames; @param pace how fast time goes: speeds and other rates are
/// scaled by it
RowSample sampleBetween(const std::function<RowSample(std::uint32_t)>& whole, std::uint32_t frames,
                        double frame, double pace);

/// Single people of a bake.
class RowSampler {
  public:
    explicit RowSampler(const StreamSet& streams) : streams_(streams) {}

    RowSample whole(std::uint32_t row, std::uint32_t frame) const;

  private:
    const StreamSet& streams_;
};

}  // namespace throng::io
