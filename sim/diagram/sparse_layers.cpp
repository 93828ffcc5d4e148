// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/sparse_layers.h"

#include <algorithm>

#include "sim/diagram/gather.h"

namespace throng::sim {
namespace {

constexpr std::uint32_t kInfinite = 0x7f800000u;  // the bits of a distance that is not below any
constexpr std::size_t kBytesOfTwo = 2 * gl::kWord;
constexpr std::size_t kBytesOfLayers = kBytesOfTwo * kPagePixels;

}  // namespace

SparseLayers::SparseLayers(const gl::ShaderLibrary& library, const DiagramOptions& options,
                           const FixedSquares& squares, const gl::Buffer* places,
                           std::span<const gpu::DiagramSite> fixed_sites)
    : per_line_(squares.per_line),
      own_places_(places ? gl::Buffer()
                         : gl::makeBuffer("squares with fixed sites", squares.places, "page of the window")),
      places_(places),
      layers_("diagram of fixed sites",
              {squares.squares.size() * kPagePixels, kBytesOfTwo, "pixel near a fixed site"},
              gl::Buffer::Use::in_ranges) {
    layers_.fill(kInfinite);
    texture_ = gl::WordTexture(layers_, gl::WordTexture::Texel::two_words);
    if (squares.squares.size() > 1) work(library, options, squares, fixed_sites);
}

void SparseLayers::work(const gl::ShaderLibrary& library, const DiagramOptions& options,
                        const FixedSquares& squares, std::span<const gpu::DiagramSite> fixed_sites) {
    const float radius = std::max(1.0f, options.largest_radius);
    const BinGrid grid(options.width, options.height, std::max(1.0f, options.gather.bin_radii * radius));
    const FixedBins bins(library, grid, fixed_sites);
    const auto pages = static_cast<std::uint32_t>(squares.squares.size());
    const gl::Buffer list = gl::makeBuffer("squares with fixed sites, by place", squares.squares, "page");
    const gl::Buffer count =
        gl::makeBuffer("squares with fixed sites, count", std::vector<std::uint32_t>{0, 1, 1, pages});
    const gl::Buffer no_strips = noStrips(grid);

    gl::ComputeProgram gather = gatherProgram(library, options, Gathering::layers, false);
    grid.describeTo(gather);
    gather.set("largest_radius", options.largest_radius);
    gather.set("pages_per_line", per_line_);
    gather.bind("StripStarts", no_strips);
    gather.bind("CellOffsets", bins.starts());
    gather.bind("binned_sites", bins.sites());
    gather.bind("PageList", list);
    gather.bind("PageCount", count);
    const std::uint32_t most = pagesPerRange(options.gather, kBytesOfLayers);
    for (std::uint32_t first = 0; first < pages; first += most) {
        const std::uint32_t shown = std::min(most, pages - first);
        gather.bindRange("Layers", layers_, first * kBytesOfLayers, shown * kBytesOfLayers);
        gather.set("first_page", first);
        gather.dispatch(std::uint64_t{shown} * blocksPerPage(options.gather));
    }
}

void SparseLayers::describeTo(gl::Program& gather) const {
    gather.bind("FixedPlaces", places_ ? *places_ : own_places_);
    gather.bind("fixed_layers", texture_);
    gather.set("pages_per_line", per_line_);
}

std::size_t SparseLayers::bytes(const FixedSquares& squares) {
    return squares.squares.size() * kBytesOfLayers + squares.places.size() * gl::kWord;
}

}  // namespace throng::sim
