// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/methods.h"

namespace throng::sim {
namespace {

const gl::Declaration kCompareAll = {
    "diagram", {"shaders/diagram/per_pixel.comp"}, {"LiveDispatch", "sites"}, {"Owners"}};

}  // namespace

PerPixelDiagram::PerPixelDiagram(const DiagramSetup& setup)
    : pixels_(std::uint64_t{setup.options.width} * setup.options.height),
      program_(setup.library, kCompareAll) {
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

void PerPixelDiagram::build() {
    program_.dispatch(pixels_);
}

}  // namespace throng::sim
