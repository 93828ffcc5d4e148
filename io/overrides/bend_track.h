// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "authoring/overrides/layers.h"
#include "io/overrides/layered_crowd.h"

namespace throng::io {

/// Somebody's way, bent.
struct BentTrack {
    std::vector<RowSample> samples{};  ///< frame by frame; empty where the bend does nothing
    double acceleration = 0.0;         ///< m/s^2, that it adds at most
    std::uint32_t frame = 0;           ///< of that
};

/// Bends the way of somebody as the crowd has it so far. Places are off by what the bend says, headings turn
/// with the way, speed, stride and phase follow the new one, and feet and trunk, where the bake tells them,
/// are worked out anew from there on.
BentTrack bendTrack(const LayeredCrowd& crowd, std::uint32_t row, const authoring::Bend& bend);

}  // namespace throng::io
