// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/looked_at.h"

#include <algorithm>

#include "sim/diagram/page_size.h"

namespace throng::sim {

LookedAtCount::LookedAtCount(const gpu::Parameters& parameters, double look)
    : parameters_(parameters),
      look_(look),
      per_line_(pagesAcross(parameters.diagram_width)),
      stamps_(std::size_t{per_line_} * pagesAcross(parameters.diagram_height)) {}

void LookedAtCount::begin() {
    ++stamp_;
    pages_ = 0;
}

void LookedAtCount::add(glm::vec2 place) {
    const glm::vec2 pixel = (place - parameters_.diagram_minimum) * parameters_.pixels_per_metre;
    const auto page = [&](double at, std::uint32_t size) {
        return static_cast<std::uint32_t>(std::clamp(at, 0.0, size - 1.0)) / gpu::PAGE_SIDE;
    };
    const std::uint32_t left = page(pixel.x - look_ - 1.0, parameters_.diagram_width);
    const std::uint32_t right = page(pixel.x + look_ + 1.0, parameters_.diagram_width);
    const std::uint32_t bottom = page(pixel.y - look_ - 1.0, parameters_.diagram_height);
    const std::uint32_t top = page(pixel.y + look_ + 1.0, parameters_.diagram_height);
    for (std::uint32_t y = bottom; y <= top; ++y)
        for (std::uint32_t x = left; x <= right; ++x) {
            std::uint32_t& stamp = stamps_[std::size_t{y} * per_line_ + x];
            pages_ += stamp != stamp_;
            stamp = stamp_;
        }
}

double LookedAtCount::pixels() const {
    return static_cast<double>(pages_) * kPagePixels;
}

}  // namespace throng::sim
