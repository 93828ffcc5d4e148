// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/diagram/site_bins.h"
#include "sim/diagram/vehicle_cells.h"
#include "sim/gl/context.h"

namespace throng::sim {
namespace {

const gl::Declaration kPlacePages = {"diagram",
                                     {"shaders/diagram/pages.comp"},
                                     {"LiveDispatch", "Sites", "FixedTable", "PageTable", "PageCount"},
                                     {"PageTable", "PageCount", "PageList"}};
const gl::Declaration kForget = {
    "diagram", {"shaders/diagram/pages_forget.comp"}, {"PageCount", "PageList"}, {"PageTable"}};
const gl::Declaration kCoverVehicles = {
    "diagram", {"shaders/diagram/vehicle_tiles.comp"}, {"VehicleBoxes"}, {"VehicleTiles"}};
constexpr float kNobodyLooks = -1.0f;

}  // namespace

std::uint64_t Pages::pagesNeeded(std::uint32_t width, std::uint32_t height, float largest_radius,
                                 std::uint64_t sites) {
    // A span of L pixels that starts anywhere touches at most ceil((L - 1) / side) + 1 pages; a tile's box is
    // at most 2 r + 2 pixels wide.
    const double across = std::ceil((2.0 * largest_radius + 1.0) / gpu::PAGE_SIDE) + 1.0;
    const double by_sites = static_cast<double>(sites) * across * across;
    const double all = static_cast<double>(pagesAcross(width)) * pagesAcross(height);
    return static_cast<std::uint64_t>(std::min(by_sites, all)) + 1;
}

Pages::Pages(const gl::ShaderLibrary& library, std::uint32_t width, std::uint32_t height,
             float largest_radius, float look, std::uint32_t live_capacity,
             std::span<const gpu::DiagramSite> fixed_sites, const VehicleSites* vehicles)
    : fixed_(width, height, fixed_sites),
      look_(look),
      table_("diagram page table", {fixed_.places.size(), gl::kWord, "page of the window"}),
      fixed_table_(gl::makeBuffer("diagram page table, fixed sites", fixed_.places, "page of the window")),
      fixed_list_(gl::makeBuffer("diagram pages, fixed sites", fixed_.squares, "page")),
      count_("diagram page count", 4 * gl::kWord),
      fixed_count_(gl::makeBuffer("diagram page count, fixed sites", dispatchOf(fixed_.squares.size()))),
      // The empty page, and the group of a pass over all pages that it is in.
      empty_count_(gl::makeBuffer("no diagram pages", std::vector<std::uint32_t>{1, 1, 1, 1})),
      place_(library, kPlacePages),
      forget_(library, kForget) {
    place_.set("diagram_size", glm::vec2(width, height));
    place_.set("pages_per_line", fixed_.per_line);
    place_.bind("PageTable", table_);
    place_.bind("PageCount", count_);
    place_.bind("FixedTable", fixed_table_);
    forget_.bind("PageTable", table_);
    forget_.bind("PageCount", count_);
    table_.fill(0);
    count_.copyFrom(empty_count_);  // what a build forgets first

    const std::uint64_t all = fixed_.places.size() + 1;
    fixed_.places = {};  // the device has them
    const std::uint64_t under_vehicles = vehicles ? coverVehicles(library, *vehicles, width, height) : 0;
    const std::uint64_t needed =
        std::min(all, fixed_.squares.size() + pagesNeeded(width, height, largest_radius, live_capacity) +
                          under_vehicles);
    constexpr std::uint64_t kMostPages =
        (std::uint64_t{1} << 27) / kPagePixels;  // texels of a buffer texture
    if (needed > kMostPages)
        throw gl::GraphicsError(fmt::format(
            "the diagram of {} x {} pixels may need {:.0f} million of them where people or walls are, and "
            "the "
            "limit is {:.0f} million. Set simulation.pixels_per_metre lower, or split the layout.",
            width, height, static_cast<double>(needed * kPagePixels) / 1e6,
            static_cast<double>(kMostPages * kPagePixels) / 1e6));
    capacity_ = static_cast<std::uint32_t>(needed);
    list_ = gl::Buffer("diagram pages", {capacity_, gl::kWord, "page"});
    list_.copyFrom(fixed_list_);
    place_.set("page_capacity", capacity_);
    place_.bind("PageList", list_);
    forget_.bind("PageList", list_);
}

/// @returns how many pages that takes at most
std::uint64_t Pages::coverVehicles(const gl::ShaderLibrary& library, const VehicleSites& vehicles,
                                   std::uint32_t width, std::uint32_t height) {
    covers_ = Covers{};
    covers_->count = vehicles.count * vehicles.tilesOfOne();
    covers_->tiles =
        gl::Buffer("tiles over vehicles", {covers_->count, sizeof(gpu::DiagramSite), "tile over a vehicle"});
    covers_->dispatch = gl::makeBuffer("tiles over vehicles, dispatch", dispatchOf(covers_->count));
    covers_->make = gl::ComputeProgram(library, kCoverVehicles, vehicles.definitions);
    covers_->make.bind("VehicleTiles", covers_->tiles);
    covers_->make.set("tiles_per_vehicle", vehicles.tilesOfOne());
    vehicles.describeTo(covers_->make);
    return pagesNeeded(width, height, vehicles.largestTile(), covers_->count);
}

gl::Room Pages::store() const {
    return {kPagePixels * capacity_, gl::kWord, "pixel"};
}

void Pages::connect(const gl::Buffer& sites, const gl::Buffer& live_dispatch) {
    sites_ = &sites;
    live_dispatch_ = &live_dispatch;
}

void Pages::placeUnder(const gl::Buffer& sites, const gl::Buffer& dispatch, float look) {
    place_.bind("Sites", sites);
    place_.bind("LiveDispatch", dispatch);
    place_.set("look", look);
    place_.dispatchIndirect(dispatch);
}

void Pages::place(Extent extent) {
    const bool everywhere = extent == Extent::everywhere;
    if (everywhere) {
        table_.copyFrom(fixed_table_);
        count_.copyFrom(fixed_count_);
        list_.copyFrom(fixed_list_);
    } else {
        forget_.dispatchIndirect(count_);
        count_.copyFrom(empty_count_);
    }
    placeUnder(*sites_, *live_dispatch_, everywhere ? kNobodyLooks : look_);
    if (!covers_) return;
    covers_->make.dispatch(covers_->count);
    placeUnder(covers_->tiles, covers_->dispatch, kNobodyLooks);
}

}  // namespace throng::sim
