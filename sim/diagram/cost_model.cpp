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
    CostModel model;
    model.device = "built in";
    model.costs = {{DiagramMethod::gradient1, {}, 0.372, 2.217, 323.0, 8.194},
                   {DiagramMethod::gradient2, {}, 1.301, 4.917, 582.7, 17.61},
                   {DiagramMethod::per_site, {}, 0.265, 1.501, 58.02, 31.73},
                   {DiagramMethod::binned, {8, 4, 1.5f}, 1.018, 1.547, 54.08, 2.575},
                   {DiagramMethod::binned, {4, 4, 2.0f}, 0.977, 1.678, 39.14, 3.853}};
    return model;
}

}  // namespace throng::sim
