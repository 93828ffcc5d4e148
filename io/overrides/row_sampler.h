// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "authoring/overrides/overrides.h"
#include "io/streams/stream_reader.h"

namespace throng::io {

/// One person in one frame, as the streams have it.
struct RowSample {
    std::array<float, kComponents> position{};
    std::array<float, kComponents> direction{};
    std::array<float, kComponents> state{};
    std::array<float, kComponents> density{};
};

/// The bake's frame that somebody who entered at `first` shows in a frame of the shot.
inline double sourceFrame(double frame, double first, const authoring::PersonChange& change) {
    return first + (frame - first - change.delay) * change.speed;
}

/// Turns and moves what a person does about `pivot`, and takes away whoever hides.
void changeSample(RowSample& sample, const std::array<float, kComponents>& pivot,
                  const authoring::PersonChange& change);

/// People at times between the frames.
class RowSampler {
  public:
    /// `density` may be null.
    RowSampler(const StreamReader& positions, const StreamReader& directions, const StreamReader& states,
               const StreamReader* densities)
        : positions_(positions), directions_(directions), states_(states), densities_(densities) {}

    /// Positions, speed and phase are interpolated linearly, the heading by its angle; activity and variation
    /// are the nearest frame's. Beyond the bake's ends people stand as they did there.
    /// @param pace how fast time goes: speeds are scaled by it
    RowSample at(std::uint32_t row, double frame, double pace) const;

  private:
    RowSample whole(std::uint32_t row, std::uint32_t frame) const;

    const StreamReader& positions_;
    const StreamReader& directions_;
    const StreamReader& states_;
    const StreamReader* densities_;
};

}  // namespace throng::io
