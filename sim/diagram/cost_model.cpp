// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/cost_model.h"

#include <stdexcept>

namespace throng::sim {

double MethodCost::milliseconds(const DiagramLoad& load) const {
    const double nanoseconds =
        pixel_ns * load.pixels + site_ns * load.sites + covered_ns * load.sites * load.radius * load.radius;
    return base_ms + nanoseconds * 1.0e-6;
}

const MethodCost& CostModel::choose(const DiagramLoad& load, const MethodCost* present) const {
    if (costs.empty()) throw std::logic_error("a cost model without methods");
    const MethodCost* best = &costs.front();
    for (const MethodCost& candidate : costs)
        if (candidate.milliseconds(load) < best->milliseconds(load)) best = &candidate;
    if (present && present->milliseconds(load) <= 1.1 * best->milliseconds(load)) return *present;
    return *best;
}

CostModel CostModel::builtIn() {
    return {"built in", {{DiagramMethod::binned, {8, 4, 1.5f}, 1.0, 1.0, 40.0, 1.0}}};
}

}  // namespace throng::sim
