// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/fixed_layers.h"

#include "sim/diagram/methods.h"

namespace throng::sim {
namespace {

const gl::Declaration kDistances = {
    "diagram", {"shaders/diagram/distance.comp"}, {"LiveDispatch", "Sites", "Distances"}, {"Distances"}};
const gl::Declaration kSites = {
    "diagram", {"shaders/diagram/site.comp"}, {"LiveDispatch", "Sites", "Distances", "Owners"}, {"Owners"}};

}  // namespace

Splat::Splat(const DiagramSetup& setup, const gl::Buffer& owners, const gl::Buffer& distances)
    : distance_pass_(setup.library, kDistances), site_pass_(setup.library, kSites) {
    for (gl::ComputeProgram* program : {&distance_pass_, &site_pass_}) {
        program->bind("Distances", distances);
        program->set("diagram_size", glm::vec2(setup.options.width, setup.options.height));
    }
    site_pass_.bind("Owners", owners);
}

void Splat::bindSites(const gl::Buffer& sites, const gl::Buffer& live_dispatch) {
    for (gl::ComputeProgram* program : {&distance_pass_, &site_pass_}) {
        program->bind("Sites", sites);
        program->bind("LiveDispatch", live_dispatch);
    }
    live_dispatch_ = &live_dispatch;
}

void Splat::run() const {
    distance_pass_.dispatchIndirect(*live_dispatch_);
    site_pass_.dispatchIndirect(*live_dispatch_);
}

FixedLayers::FixedLayers(const DiagramSetup& setup)
    : owners_("diagram owners, fixed sites", setup.picture()),
      distances_("diagram distances, fixed sites", setup.picture()) {
    owners_.fill(gpu::NO_INDEX);
    distances_.fill(gpu::NO_INDEX);  // above the bits of every float
    const gl::Buffer sites = gl::makeBuffer(
        "fixed sites", std::vector<gpu::DiagramSite>(setup.fixed_sites.begin(), setup.fixed_sites.end()));
    const gl::Buffer dispatch = gl::makeBuffer("fixed dispatch", dispatchOf(setup.fixed_sites.size()));
    Splat splat(setup, owners_, distances_);
    splat.bindSites(sites, dispatch);
    splat.run();
}

}  // namespace throng::sim
