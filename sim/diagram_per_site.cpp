// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram_methods.h"

namespace throng::sim {
namespace {

/// The words of the LiveDispatch block for a fixed number of sites.
std::vector<std::uint32_t> dispatchFor(std::size_t sites, std::uint32_t group_size) {
    const auto count = static_cast<std::uint32_t>(sites);
    return {(count + group_size - 1) / group_size, 1, 1, count};
}

}  // namespace

PerSiteDiagram::PerSiteDiagram(const gl::ShaderLibrary& library, const DiagramWindow& the_window,
                               std::span<const gpu::DiagramSite> fixed_sites)
    : Implementation(the_window),
      distance_pass_(library, "shaders/diagram_distance.comp"),
      site_pass_(library, "shaders/diagram_site.comp"),
      fixed_owners_("diagram owners, fixed sites", owners.bytes()),
      fixed_distances_("diagram distances, fixed sites", distances.bytes()) {
    const glm::vec2 size(window.width, window.height);
    for (gl::ComputeProgram* program : {&distance_pass_, &site_pass_}) {
        program->bind("Distances", distances);
        program->set("diagram_size", size);
    }
    site_pass_.bind("Owners", owners);

    fixed_owners_.fill(gpu::NO_INDEX);
    fixed_distances_.fill(gpu::NO_INDEX);  // above the bits of every float
    const std::vector<gpu::DiagramSite> sites(fixed_sites.begin(), fixed_sites.end());
    const gl::Buffer site_buffer = gl::makeBuffer("fixed sites", sites);
    const gl::Buffer dispatch =
        gl::makeBuffer("fixed dispatch", dispatchFor(sites.size(), distance_pass_.groupSize()));
    connect({&site_buffer, &dispatch});
    build(true);
    fixed_owners_.copyFrom(owners);
    fixed_distances_.copyFrom(distances);
    live_dispatch_ = nullptr;
}

void PerSiteDiagram::connect(const Diagram::Input& input) {
    for (gl::ComputeProgram* program : {&distance_pass_, &site_pass_}) {
        program->bind("Sites", *input.sites);
        program->bind("LiveDispatch", *input.live_dispatch);
    }
    live_dispatch_ = input.live_dispatch;
}

void PerSiteDiagram::build(bool) {
    owners.copyFrom(fixed_owners_);
    distances.copyFrom(fixed_distances_);
    splat(*live_dispatch_);
}

// A pixel's owner may start as a wall tile and be taken over by an agent: its id is smaller, so the minimum
// does it.
void PerSiteDiagram::splat(const gl::Buffer& live_dispatch) {
    distance_pass_.dispatchIndirect(live_dispatch);
    site_pass_.dispatchIndirect(live_dispatch);
}

}  // namespace throng::sim
