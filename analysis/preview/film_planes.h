// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace throng::analysis {

/// A picture as encoders of films take it: brightness in full, and two planes of colour at half the size
/// (4:2:0), in the numbers of ITU-R BT.601-7, 2.5.3 (brightness 16 to 235, colours 16 to 240).
///
/// An encoder that is given the pixels themselves works the same out, in three times the time, and has to be
/// given two and a half times as many bytes.
class FilmPlanes {
  public:
    /// @param width, height px, even
    FilmPlanes(int width, int height);
    /// @param pixels rows of 0xRRGGBB (the highest byte is ignored). @param stride pixels from row to row
    const std::vector<std::uint8_t>& of(const std::uint32_t* pixels, std::size_t stride);

  private:
    std::size_t width_, height_;
    std::vector<std::uint8_t> planes_;
};

}  // namespace throng::analysis
