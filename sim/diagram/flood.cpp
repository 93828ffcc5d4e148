// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>

#include "sim/diagram/methods.h"

namespace throng::sim {
namespace {

const gl::Declaration kSeed = {
    "diagram", {"shaders/diagram/flood_seed.comp"}, {"LiveDispatch", "Sites", "Seeds"}, {"Seeds"}};
const gl::Declaration kJump = {
    "diagram", {"shaders/diagram/flood_jump.comp"}, {"Seeds", "sites"}, {"SeedsAfter"}};
const gl::Declaration kFinish = {
    "diagram", {"shaders/diagram/flood_finish.comp"}, {"Seeds", "sites"}, {"Owners"}};

std::vector<std::uint32_t> floodSteps(const DiagramOptions& options, const FloodVariant& variant) {
    const std::uint32_t longest = std::bit_ceil(std::max({options.width, options.height, 2u})) / 2;
    const auto radius = static_cast<std::uint32_t>(std::ceil(options.largest_radius));
    const std::uint32_t first = variant.from_radius ? std::min(longest, std::bit_ceil(radius)) : longest;
    std::vector<std::uint32_t> steps;
    if (variant.one_before) steps.push_back(1);
    for (std::uint32_t step = first; step >= 1; step /= 2)
        steps.push_back(step);
    if (variant.one_after) steps.push_back(1);
    return steps;
}

}  // namespace

FloodDiagram::FloodDiagram(const DiagramSetup& setup, const FloodVariant& variant)
    : steps_(floodSteps(setup.options, variant)),
      pixels_(std::uint64_t{setup.options.width} * setup.options.height),
      site_count_(setup.siteCount()),
      seeds_("flood seeds", {pixels_, 4, "pixel"}),
      other_seeds_("flood seeds, other", {pixels_, 4, "pixel"}),
      seed_(setup.library, kSeed),
      forth_(setup.library, kJump),
      back_(setup.library, kJump),
      finish_(setup.library, kFinish) {
    for (gl::ComputeProgram* program : {&seed_, &forth_, &back_, &finish_})
        program->set("diagram_size", glm::uvec2(setup.options.width, setup.options.height));
    seed_.set("fixed_first", setup.options.live_capacity);
    seed_.set("fixed_end", site_count_);
    seed_.bind("Seeds", seeds_);
    forth_.bind("Seeds", seeds_);
    forth_.bind("SeedsAfter", other_seeds_);
    back_.bind("Seeds", other_seeds_);
    back_.bind("SeedsAfter", seeds_);
    finish_.bind("Seeds", steps_.size() % 2 ? other_seeds_ : seeds_);
    finish_.bind("Owners", setup.owners);
}

void FloodDiagram::connect(const DiagramInput& input) {
    site_texture_ = gl::WordTexture(*input.sites, gl::WordTexture::Texel::four_words);
    seed_.bind("Sites", *input.sites);
    seed_.bind("LiveDispatch", *input.live_dispatch);
    for (gl::ComputeProgram* program : {&forth_, &back_, &finish_})
        program->bind("sites", site_texture_);
}

void FloodDiagram::build(Extent) {
    seeds_.fill(gpu::NO_INDEX);
    seed_.dispatch(site_count_);
    for (std::size_t round = 0; round < steps_.size(); ++round) {
        gl::ComputeProgram& jump = round % 2 ? back_ : forth_;
        jump.set("jump", steps_[round]);
        jump.dispatch(pixels_);
    }
    finish_.dispatch(pixels_);
}

}  // namespace throng::sim
