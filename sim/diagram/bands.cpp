// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/bands.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace throng::sim {
namespace {

const gl::Declaration kFindSlots = {
    "diagram", {"shaders/diagram/bands.comp"}, {"StripStarts", "CellOffsets"}, {"Bands"}};

/// px beyond what somebody looks at: makes up for rounding.
constexpr float kSpare = 2.0f;

const BinGrid& gridOf(const DiagramInput& input) {
    if (!input.sorted) throw std::logic_error("a diagram in bands needs sites that come sorted");
    return input.sorted->grid;
}

}  // namespace

std::uint32_t BandShape::lines(float look) const {
    const float beyond = 2.0f * (std::ceil(look) + kSpare) + 1.0f;
    return static_cast<std::uint32_t>(std::ceil(static_cast<float>(bin_lines) * bin_side + beyond)) +
           gpu::PAGE_SIDE;
}

Bands::Bands(const gl::ShaderLibrary& library, const DiagramOptions& options, const DiagramInput& input)
    : shape_(options.bands),
      height_(options.height),
      look_(options.look),
      count_((gridOf(input).height + options.bands.bin_lines - 1) / options.bands.bin_lines),
      bands_("bands of the diagram", {count_, sizeof(gpu::Band), "band"}),
      find_(library, kFindSlots) {
    if (shape_.bin_side != gridOf(input).side)
        throw std::logic_error("bands are lines of other bins than sites are sorted by");
    find_.bind("StripStarts", *input.sorted->strip_starts);
    find_.bind("CellOffsets", *input.sorted->starts);
    find_.bind("Bands", bands_);
    find_.set("cells_across", glm::uvec2(input.sorted->grid.width, input.sorted->grid.height));
    find_.set("lines_per_band", options.bands.bin_lines);
}

glm::uvec2 Bands::lines(std::uint32_t band) const {
    const auto height = static_cast<float>(height_);
    const float beyond = std::ceil(look_) + kSpare;
    const float side = static_cast<float>(shape_.bin_lines) * shape_.bin_side;
    const auto at = [&](std::uint32_t end) { return static_cast<float>(end) * side; };
    const auto first = static_cast<std::uint32_t>(std::clamp(at(band) - beyond, 0.0f, height - 1.0f));
    // Who stands beyond the last line looks at it all the same.
    const float end = band + 1 == count_ ? height : std::ceil(at(band + 1) + beyond);
    return {first / gpu::PAGE_SIDE * gpu::PAGE_SIDE,
            static_cast<std::uint32_t>(std::clamp(end, 1.0f, height))};
}

void Bands::dispatch(gl::ComputeProgram& program, std::uint32_t band) const {
    program.bind("Bands", bands_);
    program.set("band", band);
    program.dispatchIndirect(bands_, std::size_t{band} * sizeof(gpu::Band));
}

}  // namespace throng::sim
