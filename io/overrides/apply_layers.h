// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "authoring/overrides/layers.h"
#include "authoring/overrides/matching.h"
#include "io/overrides/layered_crowd.h"

namespace throng::io {

/// A bend that adds more acceleration than it may.
struct SharpBend {
    std::uint32_t row = 0;
    double acceleration = 0.0;  ///< m/s^2
    std::uint32_t frame = 0;
};

/// What came of a layer.
struct LayerResult {
    std::vector<std::uint32_t> rows{};   ///< whom it means
    std::uint32_t copies = 0;            ///< people that it made
    std::vector<std::string> remarks{};  ///< names that nobody has, and what could not be done
    std::vector<SharpBend> sharp{};      ///< the sharpest first
};

/// Does to a crowd what the layers say, one after the other; those that are not enabled mean nobody. Throws
/// InputError where there would be more than `most_people`.
/// @param entrants of the bake, as loadEntrants() has them
std::vector<LayerResult> applyLayers(LayeredCrowd& crowd, std::span<const authoring::Layer> layers,
                                     std::span<const authoring::Entrant> entrants,
                                     std::uint32_t most_people = 1u << 20);

}  // namespace throng::io
