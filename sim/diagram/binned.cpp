// SPDX-License-Identifier: Apache-2.0
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>

#include "sim/diagram/methods.h"

namespace throng::sim {
namespace {

constexpr std::size_t kPageBytes = std::size_t{4} * gpu::PAGE_SIDE * gpu::PAGE_SIDE;

const gl::Declaration kGather = {"diagram",
                                 {"shaders/diagram/binned.comp"},
                                 {"binned_sites", "StripStarts", "CellOffsets", "FixedBinStarts",
                                  "fixed_binned_sites", "PageList", "PageCount"},
                                 {"Owners"}};
const gl::Declaration kCountGroups = {
    "diagram", {"shaders/diagram/page_dispatch.comp"}, {"PageCount"}, {"PageDispatch"}};

gl::Definitions definitionsFor(const DiagramSetup& setup, const Pages* pages) {
    gl::Definitions definitions = {{"BLOCK_WIDTH", fmt::format("{}u", setup.options.gather.block_width)},
                                   {"BLOCK_HEIGHT", fmt::format("{}u", setup.options.gather.block_height)}};
    if (!setup.fixed_sites.empty()) definitions.emplace_back("FIXED_SITES", "1");
    if (pages) definitions.emplace_back("PAGED", "1");
    if (!pages) definitions.emplace_back("CLEARED_BEFORE", "1");
    const bool lines_of_fours = pages || setup.options.width % 4 == 0;
    if (lines_of_fours && setup.options.gather.block_width % 4 == 0)
        definitions.emplace_back("STORE_BY_FOUR", "1");
    return definitions;
}

std::uint64_t blocksAcross(std::uint32_t pixels, std::uint32_t block) {
    return (pixels + block - 1) / block;
}

/// Pages that one binding of a storage block can show.
std::uint32_t pagesPerRange(std::uint32_t blocks_per_page) {
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    const auto by_memory = static_cast<std::uint64_t>(bytes) / kPageBytes;
    const std::uint64_t by_groups = std::uint64_t{65535} * gpu::PIXEL_GROUP_SIZE / blocks_per_page;
    return static_cast<std::uint32_t>(std::min(by_memory, by_groups));
}

}  // namespace

/// Bins much larger than the tiles would offer every block too many that cannot reach it.
constexpr float kMostBinRadii = 3.0f;

BinnedDiagram::BinnedDiagram(const DiagramSetup& setup, Pages* pages)
    : library_(setup.library),
      options_(setup.options),
      fixed_sites_(setup.fixed_sites),
      blocks_(blocksAcross(setup.options.width, setup.options.gather.block_width) *
              blocksAcross(setup.options.height, setup.options.gather.block_height)),
      gather_(setup.library, kGather, definitionsFor(setup, pages)),
      pages_(pages),
      owners_(setup.owners) {
    gather_.set("largest_radius", setup.options.largest_radius);
    gather_.bind("Owners", owners_);
    if (!pages_) {
        gather_.set("diagram_size", glm::vec2(setup.options.width, setup.options.height));
        return;
    }
    const std::uint32_t blocks_per_page = (gpu::PAGE_SIDE / setup.options.gather.block_width) *
                                          (gpu::PAGE_SIDE / setup.options.gather.block_height);
    pages_per_range_ = pagesPerRange(blocks_per_page);
    ranges_ = (pages_->capacity() + pages_per_range_ - 1) / pages_per_range_;
    page_dispatch_ = gl::Buffer("diagram page dispatch", {ranges_, 12, "range of pages"});
    count_groups_ = gl::ComputeProgram(setup.library, kCountGroups);
    count_groups_.bind("PageCount", pages_->count());
    count_groups_.bind("PageDispatch", page_dispatch_);
    count_groups_.set("ranges", ranges_);
    count_groups_.set("pages_per_range", pages_per_range_);
    count_groups_.set("blocks_per_page", blocks_per_page);
    gather_.bind("PageList", pages_->list());
    gather_.bind("PageCount", pages_->count());
    gather_.set("pages_per_line", pages_->perLine());
}

void BinnedDiagram::connect(const DiagramInput& input) {
    if (pages_) pages_->connect(*input.sites, *input.live_dispatch);
    const float radius = std::max(1.0f, options_.largest_radius);
    const bool sorted = input.sorted && input.sorted->grid.side <= kMostBinRadii * radius;
    const BinGrid grid =
        sorted ? input.sorted->grid
               : BinGrid(options_.width, options_.height, std::max(1.0f, options_.gather.bin_radii * radius));
    grid.describeTo(gather_);
    bins_.reset();
    if (sorted) {
        sorted_sites_ = gl::WordTexture(*input.sites, gl::WordTexture::Texel::four_words);
        gather_.bind("StripStarts", *input.sorted->strip_starts);
        gather_.bind("CellOffsets", *input.sorted->starts);
        gather_.bind("binned_sites", sorted_sites_);
    } else {
        bins_.emplace(library_, grid, options_.live_capacity);
        bins_->connect(*input.sites, *input.live_dispatch);
        // All its bins start where they say, whatever the strip.
        no_strips_ = gl::makeBuffer(
            "no strips", std::vector<std::uint32_t>(grid.count() / gpu::CELLS_PER_STRIP + 1), "strip");
        gather_.bind("StripStarts", no_strips_);
        gather_.bind("CellOffsets", bins_->starts());
        gather_.bind("binned_sites", bins_->sites());
    }
    if (fixed_sites_.empty()) return;
    fixed_bins_.emplace(library_, grid, fixed_sites_);
    gather_.bind("FixedBinStarts", fixed_bins_->starts());
    gather_.bind("fixed_binned_sites", fixed_bins_->sites());
}

void BinnedDiagram::build() {
    if (bins_) bins_->sort();
    if (pages_) {
        buildPages();
    } else {
        owners_.fill(gpu::NO_INDEX);  // blocks out of reach are not even written
        gather_.dispatch(blocks_);
    }
}

void BinnedDiagram::buildPages() {
    pages_->place();
    count_groups_.dispatch(1);
    for (std::uint32_t range = 0; range < ranges_; ++range) {
        const std::size_t first = std::size_t{range} * pages_per_range_ * kPageBytes;
        const std::size_t bytes =
            std::min(owners_.bytes() - first, std::size_t{pages_per_range_} * kPageBytes);
        gather_.bindRange("Owners", owners_, first, bytes);
        gather_.set("first_page", range * pages_per_range_);
        gather_.dispatchIndirect(page_dispatch_, std::size_t{12} * range);
    }
}

}  // namespace throng::sim
