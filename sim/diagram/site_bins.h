// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "shaders/shared/simulation_types.h"
#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// What buffers have an element for that hold something of every site: of all people, and of wall tiles where
/// they are sites, too.
inline constexpr const char* kSite = "site";

/// Squares over a window that sites are sorted into, one line of bins after the other.
struct BinGrid {
    /// @param side px; the last bins of a line or column may reach beyond the window
    BinGrid(std::uint32_t window_width, std::uint32_t window_height, float side);

    /// Bins that somebody else has made.
    BinGrid(float the_side, glm::uvec2 bins) : side(the_side), width(bins.x), height(bins.y) {}

    float side;
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t count() const { return width * height; }
    /// Sets what shaders/diagram/bins.glsl asks for.
    void describeTo(gl::Program& program) const;
};

/// Sites sorted by bin (a counting sort on the device).
class SiteBins {
  public:
    SiteBins(const gl::ShaderLibrary& library, const BinGrid& grid, std::uint32_t capacity);
    /// The blocks Sites and LiveDispatch of the shaders.
    void connect(const gl::Buffer& sites, const gl::Buffer& live_dispatch);
    void sort();

    /// Per bin, where its sites start; one more at the end.
    const gl::Buffer& starts() const { return starts_; }
    const gl::WordTexture& sites() const { return site_texture_; }

  private:
    BinGrid grid_;
    gl::Buffer counts_, group_sums_, starts_, places_, sites_;
    gl::WordTexture site_texture_;
    gl::ComputeProgram count_, sum_, find_starts_, scatter_;
    const gl::Buffer* live_dispatch_ = nullptr;
};

/// Bins of sites that never move.
class FixedBins {
  public:
    FixedBins(const gl::ShaderLibrary& library, const BinGrid& grid,
              std::span<const gpu::DiagramSite> fixed_sites);
    bool empty() const { return count_ == 0; }
    const gl::Buffer& starts() const { return bins_.starts(); }
    const gl::WordTexture& sites() const { return bins_.sites(); }

  private:
    std::size_t count_;
    SiteBins bins_;
};

/// What the block LiveDispatch holds for a fixed number of sites.
std::vector<std::uint32_t> dispatchOf(std::size_t sites);

}  // namespace throng::sim
