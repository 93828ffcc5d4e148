// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace throng {

/// A colour in sRGB, each part from 0 to 1.
struct Colour {
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
};

constexpr Colour colourFromHex(std::uint32_t hex) {
    return {static_cast<double>((hex >> 16) & 255u) / 255.0, static_cast<double>((hex >> 8) & 255u) / 255.0,
            static_cast<double>(hex & 255u) / 255.0};
}

/// Colours of the groups, in the preview and in crowd.glb alike: the group's index, round and round. Cool and
/// dark enough to stand out from the warm heat of the density layer, and apart for eyes that tell red from
/// green badly.
inline constexpr std::array<Colour, 8> kGroupColours{
    colourFromHex(0x1f5fa8), colourFromHex(0x0c8a72), colourFromHex(0x7b3fa0), colourFromHex(0x3aa5d8),
    colourFromHex(0xa8326e), colourFromHex(0x5d7a1f), colourFromHex(0x44506b), colourFromHex(0x8a5a2b)};

constexpr Colour groupColour(std::size_t group) {
    return kGroupColours[group % kGroupColours.size()];
}

}  // namespace throng
