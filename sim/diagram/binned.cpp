// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "sim/diagram/bands.h"
#include "sim/diagram/gather.h"
#include "sim/diagram/methods.h"

namespace throng::sim {
namespace {

constexpr std::size_t kPageBytes = gl::kWord * kPagePixels;

const gl::Declaration kCountGroups = {
    "diagram", {"shaders/diagram/page_dispatch.comp"}, {"PageCount"}, {"PageDispatch"}};
const gl::Declaration kListPages = {"diagram",
                                    {"shaders/diagram/pages_near.comp"},
                                    {"LiveDispatch", "Bands", "Sites", "PageStamps", "PageCount"},
                                    {"PageStamps", "PageCount", "PageList"}};

/// Whose blocks one group of a pass works on.
std::uint32_t pagesPerGroup(const GatherShape& shape) {
    return std::max(1u, gpu::PIXEL_GROUP_SIZE / blocksPerPage(shape));
}

}  // namespace

/// Bins much larger than the tiles would offer every block too many that cannot reach it.
constexpr float kMostBinRadii = 3.5f;

BinnedDiagram::BinnedDiagram(const DiagramSetup& setup, Pages* pages)
    : library_(setup.library),
      options_(setup.options),
      gather_(gatherProgram(setup.library, setup.options, pages ? Gathering::pages : Gathering::whole,
                            !setup.fixed_sites.empty())),
      fixed_(setup.fixed_sites.empty() ? nullptr : &setup.sparse()),
      pages_(pages),
      owners_(setup.owners) {
    if (pages_) setUpPages(setup);
}

void BinnedDiagram::setUpPages(const DiagramSetup& setup) {
    const std::uint32_t blocks_per_page = blocksPerPage(options_.gather);
    pages_per_range_ = pagesPerRange(options_.gather, kPageBytes);
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

/// At most, in the window or in one band of it.
std::size_t BinnedDiagram::pagesListed() const {
    const bool in_bands = options_.bands.areUsed();
    const std::uint32_t lines = in_bands ? options_.bands.lines(options_.look) : options_.height;
    return std::size_t{pagesAcross(options_.width)} * (pagesAcross(lines) + 1);
}

bool BinnedDiagram::canBuildNear() const {
    constexpr std::uint64_t kMostGroups = 65535;  // on one axis
    return options_.look > 0.0f && pagesListed() <= kMostGroups * pagesPerGroup(options_.gather);
}

void BinnedDiagram::setUpNear() {
    const std::uint32_t across = pagesAcross(options_.width);
    const std::size_t pages = std::size_t{across} * pagesAcross(options_.height);
    near_.emplace();
    near_->stamps = gl::Buffer("diagram pages, last listed", {pages, 4, "page of the window"});
    near_->stamps.fill(0);
    near_->list = gl::Buffer("diagram pages looked at", {pagesListed(), 4, "page of the window"});
    near_->count = gl::Buffer("diagram pages looked at, count", 16);
    near_->none = gl::makeBuffer("no diagram pages", std::vector<std::uint32_t>{0, 1, 1, 0});
    near_->list_pages =
        gl::ComputeProgram(library_, kListPages,
                           options_.bands.areUsed() ? gl::Definitions{{"BANDED", "1"}} : gl::Definitions{});
    near_->list_pages.bind("PageStamps", near_->stamps);
    near_->list_pages.set("diagram_size", glm::vec2(options_.width, options_.height));
    near_->list_pages.set("look", options_.look);
    near_->list_pages.set("pages_per_group", pagesPerGroup(options_.gather));
    near_->gather = gatherProgram(library_, options_, Gathering::near_people, fixed_ != nullptr);
    for (gl::ComputeProgram* program : {&near_->list_pages, &near_->gather}) {
        program->bind("PageList", near_->list);
        program->bind("PageCount", near_->count);
        program->set("pages_per_line", across);
    }
    connectNear();
}

void BinnedDiagram::connect(const DiagramInput& input) {
    input_ = input;
    if (pages_) pages_->connect(*input.sites, *input.live_dispatch);
    const float radius = std::max(1.0f, options_.largest_radius);
    const bool sorted = input.sorted && input.sorted->grid.side <= kMostBinRadii * radius;
    grid_ =
        sorted ? input.sorted->grid
               : BinGrid(options_.width, options_.height, std::max(1.0f, options_.gather.bin_radii * radius));
    bins_.reset();
    if (sorted) {
        sorted_sites_ = gl::WordTexture(*input.sites, gl::WordTexture::Texel::four_words);
    } else {
        bins_.emplace(library_, *grid_, options_.live_capacity);
        bins_->connect(*input.sites, *input.live_dispatch);
        no_strips_ = noStrips(*grid_);
    }
    connectGather(gather_);
    if (near_) connectNear();
}

void BinnedDiagram::connectNear() {
    connectGather(near_->gather);
    near_->list_pages.bind("Sites", *input_.sites);
    if (!options_.bands.areUsed()) near_->list_pages.bind("LiveDispatch", *input_.live_dispatch);
}

void BinnedDiagram::connectGather(gl::ComputeProgram& gather) {
    gather.set("largest_radius", options_.largest_radius);
    gather.bind("Owners", owners_);
    if (!pages_) {
        gather.set("diagram_width", options_.width);
        gather.set("lines", glm::uvec2(0, options_.height));
    }
    grid_->describeTo(gather);
    gather.bind("StripStarts", bins_ ? no_strips_ : *input_.sorted->strip_starts);
    gather.bind("CellOffsets", bins_ ? bins_->starts() : *input_.sorted->starts);
    gather.bind("binned_sites", bins_ ? bins_->sites() : sorted_sites_);
    if (fixed_) fixed_->describeTo(gather);
}

std::uint64_t BinnedDiagram::blocks(std::uint32_t lines) const {
    return blocksAcross(options_.width, options_.gather.block_width) *
           blocksAcross(lines, options_.gather.block_height);
}

void BinnedDiagram::build(Extent extent) {
    if (bins_) bins_->sort();
    if (options_.bands.areUsed()) return;  // until one is asked for
    if (pages_) {
        buildPages(extent);
    } else if (extent == Extent::near_people && canBuildNear()) {
        beginNear();
        near_->list_pages.dispatchIndirect(*input_.live_dispatch);
        near_->gather.dispatchIndirect(near_->count);
    } else {
        gather_.dispatch(blocks(options_.height));
    }
}

void BinnedDiagram::buildBand(const Bands& bands, std::uint32_t band, Extent extent) {
    const glm::uvec2 lines = bands.lines(band);
    if (extent == Extent::near_people && canBuildNear()) {
        beginNear();
        bands.dispatch(near_->list_pages, band);
        near_->gather.set("lines", lines);
        near_->gather.dispatchIndirect(near_->count);
    } else {
        gather_.set("lines", lines);
        gather_.dispatch(blocks(lines.y - lines.x));
    }
}

/// The list of pages is empty then.
void BinnedDiagram::beginNear() {
    if (!near_) setUpNear();
    near_->count.copyFrom(near_->none);
    near_->list_pages.set("stamp", ++near_->stamp);
}

void BinnedDiagram::buildPages(Extent extent) {
    pages_->place(extent);
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
