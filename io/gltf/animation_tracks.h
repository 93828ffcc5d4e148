// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/files/output_file.h"
#include "io/gltf/crowd_glb.h"

namespace throng::io {

/// A row of the bake that goes into the glTF file.
struct TrackRow {
    std::uint32_t row = 0;
    float width_scale = 1.0f;   ///< of the body mesh, horizontally
    float height_scale = 1.0f;  ///< likewise, vertically
    bool has_scales = false;    ///< a track of them: 0 while it is not alive, less high while it sits
    bool stays = false;         ///< in a seat all the time: it has no tracks of places and turns, but
    std::array<float, kComponents> place{}, direction{};  ///< as the streams have them
};

inline constexpr std::uint32_t kTranslationBytes = 3 * sizeof(float);
inline constexpr std::uint32_t kRotationBytes =
    4 * sizeof(std::int16_t);  // normalised: half the size of floats
inline constexpr std::uint32_t kScaleBytes = 3 * sizeof(float);
inline constexpr std::uint32_t kLargestKeyBytes = kTranslationBytes + kRotationBytes + kScaleBytes;

/// Marks the rows that are not alive in some frame, or have a seat, and those that stay in it.
void findScaledRows(const StreamSet& streams, std::vector<TrackRow>& rows);

/// Writes for each row in turn: its translations and rotations, if it does not stay, and its scales, if it
/// has any; Y up.
void writeTracks(OutputFile& file, const StreamSet& streams, const std::vector<TrackRow>& rows);

}  // namespace throng::io
