// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/methods.h"

namespace throng::sim {

PerSiteDiagram::PerSiteDiagram(const DiagramSetup& setup)
    : owners_(setup.owners),
      distances_("diagram distances", setup.picture()),
      fixed_(setup.fixed_sites.empty() ? nullptr : &setup.fixed()),
      splat_(setup, owners_, distances_) {}

void PerSiteDiagram::connect(const DiagramInput& input) {
    splat_.bindSites(*input.sites, *input.live_dispatch);
}

// A pixel's owner may start as a wall tile and be taken over by an agent: its id is smaller, so the minimum
// does it.
void PerSiteDiagram::build(Extent) {
    if (fixed_) {
        owners_.copyFrom(fixed_->owners());
        distances_.copyFrom(fixed_->distances());
    } else {
        owners_.fill(gpu::NO_INDEX);
        distances_.fill(gpu::NO_INDEX);  // above the bits of every float
    }
    splat_.run();
}

}  // namespace throng::sim
