// SPDX-License-Identifier: Apache-2.0
#include <epoxy/gl.h>

#include <algorithm>

#include "sim/diagram/methods.h"

namespace throng::sim {
namespace {

const gl::Declaration kCompareAll = {
    "diagram", {"shaders/diagram/per_pixel.comp"}, {"LiveDispatch", "sites"}, {"Owners"}};

/// So many that a piece takes a second at most: a slow device compares some 300 million pairs in one.
std::uint64_t pixelsAtATime(std::uint64_t sites) {
    constexpr std::uint64_t kPairs = 1 << 28;
    const std::uint64_t pixels = kPairs / std::max<std::uint64_t>(sites, 1);
    return std::max<std::uint64_t>(pixels / gpu::PIXEL_GROUP_SIZE, 1) * gpu::PIXEL_GROUP_SIZE;
}

}  // namespace

PerPixelDiagram::PerPixelDiagram(const DiagramSetup& setup)
    : pixels_(std::uint64_t{setup.options.width} * setup.options.height),
      pixels_at_a_time_(pixelsAtATime(setup.siteCount())),
      long_work_(setup.long_work),
      program_(setup.library, kCompareAll) {
    long_work_.in_pieces = pixels_ > pixels_at_a_time_;
    program_.bind("Owners", setup.owners);
    program_.set("diagram_size", glm::uvec2(setup.options.width, setup.options.height));
    program_.set("fixed_first", setup.options.live_capacity);
    program_.set("fixed_end", setup.siteCount());
}

void PerPixelDiagram::connect(const DiagramInput& input) {
    sites_ = gl::WordTexture(*input.sites, gl::WordTexture::Texel::four_words);
    program_.bind("sites", sites_);
    program_.bind("LiveDispatch", *input.live_dispatch);
}

void PerPixelDiagram::build(Extent) {
    for (std::uint64_t first = 0; first < pixels_; first += pixels_at_a_time_) {
        if (first > 0 && long_work_.stop) {
            glFinish();  // or the device would be given all pieces before anybody asks
            long_work_.stopped = long_work_.stop();
            if (long_work_.stopped) return;
        }
        program_.set("first_pixel", static_cast<std::uint32_t>(first));
        program_.dispatch(std::min(pixels_at_a_time_, pixels_ - first));
    }
}

}  // namespace throng::sim
