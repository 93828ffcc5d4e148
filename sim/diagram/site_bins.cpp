// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/site_bins.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {
namespace {

const gl::Declaration kBinsCount = {"diagram",
                                    {"shaders/diagram/bins_count.comp"},
                                    {"LiveDispatch", "Sites", "Counts"},
                                    {"Counts", "SitePlaces"}};
const gl::Declaration kBinsSum = {"diagram", {"shaders/cells/counts_sum.comp"}, {"Counts"}, {"GroupSums"}};
const gl::Declaration kFindStarts = {
    "diagram", {"shaders/diagram/bins_starts.comp"}, {"Counts", "GroupSums"}, {"BinStarts"}};
const gl::Declaration kBinsScatter = {"diagram",
                                      {"shaders/diagram/bins_scatter.comp"},
                                      {"LiveDispatch", "Sites", "BinStarts", "SitePlaces"},
                                      {"BinnedSites"}};

std::uint32_t binsAcross(std::uint32_t pixels, float side) {
    return std::max(1u, static_cast<std::uint32_t>(std::ceil(static_cast<float>(pixels) / side)));
}

/// In huge windows, larger bins: more of them than that would cost more to add up than they save.
float leastSide(std::uint32_t width, std::uint32_t height) {
    constexpr double kMostBins = 8.0e6;
    return static_cast<float>(std::sqrt(static_cast<double>(width) * height / kMostBins));
}

std::uint64_t scanThreads(const BinGrid& grid) {
    return (grid.count() + gpu::COUNTS_PER_THREAD - 1) / gpu::COUNTS_PER_THREAD;
}

}  // namespace

BinGrid::BinGrid(std::uint32_t window_width, std::uint32_t window_height, float the_side)
    : side(std::max(the_side, leastSide(window_width, window_height))),
      width(binsAcross(window_width, side)),
      height(binsAcross(window_height, side)) {}

void BinGrid::describeTo(gl::Program& program) const {
    program.set("bin_count", glm::vec2(width, height));
    program.set("bins_per_pixel", 1.0f / side);
}

SiteBins::SiteBins(const gl::ShaderLibrary& library, const BinGrid& grid, std::uint32_t capacity)
    : grid_(grid),
      counts_("bin counts", {grid.count(), gl::kWord, "bin"}),
      group_sums_("bin group sums",
                  {scanThreads(grid) / gpu::SCAN_GROUP_SIZE + 1, gl::kWord, "group of bins"}),
      starts_("bin starts", {std::size_t{grid.count()} + 1, gl::kWord, "bin"}),
      places_("places in bins", {capacity, 2 * gl::kWord, kSite}),
      sites_("binned sites", {std::max<std::size_t>(1, capacity), sizeof(gpu::DiagramSite), kSite}),
      site_texture_(sites_, gl::WordTexture::Texel::four_words),
      count_(library, kBinsCount),
      sum_(library, kBinsSum),
      find_starts_(library, kFindStarts),
      scatter_(library, kBinsScatter) {
    count_.bind("Counts", counts_);
    count_.bind("SitePlaces", places_);
    grid.describeTo(count_);
    sum_.bind("Counts", counts_);
    sum_.bind("GroupSums", group_sums_);
    sum_.set("count_total", grid.count());
    find_starts_.bind("Counts", counts_);
    find_starts_.bind("GroupSums", group_sums_);
    find_starts_.bind("BinStarts", starts_);
    find_starts_.set("count_total", grid.count());
    scatter_.bind("BinStarts", starts_);
    scatter_.bind("SitePlaces", places_);
    scatter_.bind("BinnedSites", sites_);
}

void SiteBins::connect(const gl::Buffer& sites, const gl::Buffer& live_dispatch) {
    for (gl::ComputeProgram* program : {&count_, &scatter_}) {
        program->bind("Sites", sites);
        program->bind("LiveDispatch", live_dispatch);
    }
    live_dispatch_ = &live_dispatch;
}

void SiteBins::sort() {
    counts_.fill(0);
    count_.dispatchIndirect(*live_dispatch_);
    sum_.dispatch(scanThreads(grid_));
    find_starts_.dispatch(scanThreads(grid_));
    scatter_.dispatchIndirect(*live_dispatch_);
}

FixedBins::FixedBins(const gl::ShaderLibrary& library, const BinGrid& grid,
                     std::span<const gpu::DiagramSite> fixed_sites)
    : count_(fixed_sites.size()), bins_(library, grid, static_cast<std::uint32_t>(fixed_sites.size())) {
    const gl::Buffer sites =
        gl::makeBuffer("fixed sites", std::vector<gpu::DiagramSite>(fixed_sites.begin(), fixed_sites.end()));
    const gl::Buffer dispatch = gl::makeBuffer("fixed dispatch", dispatchOf(fixed_sites.size()));
    bins_.connect(sites, dispatch);
    bins_.sort();
}

std::vector<std::uint32_t> dispatchOf(std::size_t sites) {
    const auto count = static_cast<std::uint32_t>(sites);
    return {(count + gpu::AGENT_GROUP_SIZE - 1) / gpu::AGENT_GROUP_SIZE, 1, 1, count};
}

}  // namespace throng::sim
