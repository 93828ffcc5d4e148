// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/vehicle_cells.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "sim/diagram/page_size.h"

namespace throng::sim {
namespace {

const gl::Declaration kVehicleCells = {"diagram",
                                       {"shaders/diagram/vehicles.comp"},
                                       {"Sites", "SiteSlots", "VehicleBoxes", "Owners", "page_table"},
                                       {"Owners"}};

constexpr std::size_t kBytesOfPage = gl::kWord * kPagePixels;

std::size_t mostPagesShown() {
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    return static_cast<std::size_t>(bytes) / kBytesOfPage;
}

}  // namespace

void VehicleSites::describeTo(gl::Program& program) const {
    program.bind("VehicleBoxes", *boxes);
    program.setIfUsed("first_vehicle", first_id);
    program.setIfUsed("vehicle_reach", reach);
    program.set("diagram_minimum", minimum);
    program.set("pixels_per_metre", pixels_per_metre);
}

std::uint32_t VehicleSites::tilesOfOne() const {
    return 2 + static_cast<std::uint32_t>(std::ceil(longest / (widest + reach + 1.0f)));
}

float VehicleSites::largestTile() const {
    return 1.2f * (widest + reach + 1.0f);  // gaps between tiles are no longer than that is without the 1.2
}

VehicleCells::VehicleCells(const gl::ShaderLibrary& library, const VehicleSites& vehicles, glm::uvec2 size,
                           const gl::Buffer& owners, const Pages* pages)
    : vehicles_(vehicles), owners_(&owners), pages_(pages) {
    gl::Definitions definitions = vehicles.definitions;
    if (pages_) definitions.emplace_back("PAGED", "1");
    program_ = gl::ComputeProgram(library, kVehicleCells, definitions);
    program_.set("diagram_size", glm::vec2(size));
    vehicles_.describeTo(program_);
    if (!pages_) {
        program_.bind("Owners", *owners_);
        return;
    }
    table_ = gl::WordTexture(pages_->table());
    program_.bind("page_table", table_);
    program_.set("pages_per_line", pages_->perLine());
}

void VehicleCells::connect(const gl::Buffer& sites, const gl::Buffer& site_slots) {
    program_.bind("Sites", sites);
    program_.bind("SiteSlots", site_slots);
}

void VehicleCells::run() {
    const std::uint64_t invocations = std::uint64_t{vehicles_.count} * program_.groupSize();
    if (!pages_) {
        program_.dispatch(invocations);
        return;
    }
    const std::size_t shown = mostPagesShown();
    for (std::size_t first = 0; first < pages_->capacity(); first += shown) {
        const std::size_t count = std::min(shown, pages_->capacity() - first);
        program_.bindRange("Owners", *owners_, first * kBytesOfPage, count * kBytesOfPage);
        program_.set("first_page", static_cast<std::uint32_t>(first));
        program_.set("page_count", static_cast<std::uint32_t>(count));
        program_.dispatch(invocations);
    }
}

}  // namespace throng::sim
