// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/methods.h"

namespace throng::sim {
namespace {

const gl::Declaration kDistances = {
    "diagram", {"shaders/diagram/distance.comp"}, {"LiveDispatch", "Sites", "Distances"}, {"Distances"}};
const gl::Declaration kSites = {
    "diagram", {"shaders/diagram/site.comp"}, {"LiveDispatch", "Sites", "Distances", "Owners"}, {"Owners"}};

}  // namespace

PerSiteDiagram::PerSiteDiagram(const DiagramSetup& setup)
    : owners_(setup.owners),
      distance_pass_(setup.library, kDistances),
      site_pass_(setup.library, kSites),
      distances_("diagram distances", setup.picture()),
      fixed_owners_("diagram owners, fixed sites", setup.picture()),
      fixed_distances_("diagram distances, fixed sites", setup.picture()) {
    const glm::vec2 size(setup.options.width, setup.options.height);
    for (gl::ComputeProgram* program : {&distance_pass_, &site_pass_}) {
        program->bind("Distances", distances_);
        program->set("diagram_size", size);
    }
    site_pass_.bind("Owners", owners_);

    fixed_owners_.fill(gpu::NO_INDEX);
    fixed_distances_.fill(gpu::NO_INDEX);  // above the bits of every float
    const gl::Buffer sites = gl::makeBuffer(
        "fixed sites", std::vector<gpu::DiagramSite>(setup.fixed_sites.begin(), setup.fixed_sites.end()));
    const gl::Buffer dispatch = gl::makeBuffer("fixed dispatch", dispatchOf(setup.fixed_sites.size()));
    bindSites(sites, dispatch);
    build();
    fixed_owners_.copyFrom(owners_);
    fixed_distances_.copyFrom(distances_);
    live_dispatch_ = nullptr;
}

void PerSiteDiagram::connect(const DiagramInput& input) {
    bindSites(*input.sites, *input.live_dispatch);
}

void PerSiteDiagram::bindSites(const gl::Buffer& sites, const gl::Buffer& live_dispatch) {
    for (gl::ComputeProgram* program : {&distance_pass_, &site_pass_}) {
        program->bind("Sites", sites);
        program->bind("LiveDispatch", live_dispatch);
    }
    live_dispatch_ = &live_dispatch;
}

// A pixel's owner may start as a wall tile and be taken over by an agent: its id is smaller, so the minimum
// does it.
void PerSiteDiagram::build() {
    owners_.copyFrom(fixed_owners_);
    distances_.copyFrom(fixed_distances_);
    distance_pass_.dispatchIndirect(*live_dispatch_);
    site_pass_.dispatchIndirect(*live_dispatch_);
}

}  // namespace throng::sim
