// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/cost_model.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "sim/diagram/page_size.h"

namespace throng::sim {

namespace {

// What listing a page that somebody looks at takes, on two cores of a CPU.
constexpr double kListedPageNs = 10.0;
// Of what the gathering method takes at least: the rest is sorting, and people come sorted.
constexpr double kGatheringShare = 0.25;

/// Walls are worked out once, but for the methods that draw every site in every build.
bool drawsFixedSites(DiagramMethod method) {
    return method != DiagramMethod::binned && method != DiagramMethod::per_site;
}

double pagesLookedAt(double look) {
    const double across = 2.0 * look / gpu::PAGE_SIDE + 1.0;
    return across * across;
}

}  // namespace

DiagramLoad DiagramLoad::nearPeople(double look) const {
    DiagramLoad near = *this;
    near.pixels = std::min(pixels, sites * pagesLookedAt(look) * kPagePixels);
    if (looked_at > 0.0) near.pixels = std::min(near.pixels, looked_at);
    return near;
}

bool isWorthListing(const DiagramLoad& load, double look) {
    return load.nearPeople(look).pixels < 0.5 * load.pixels;
}

double MethodCost::milliseconds(const DiagramLoad& load) const {
    const double sites = load.sites + (drawsFixedSites(method) ? load.fixed_sites : 0.0);
    const double nanoseconds =
        pixel_ns * load.pixels + site_ns * sites + covered_ns * sites * load.radius * load.radius;
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

DiagramPlan CostModel::plan(const DiagramLoad& load, double look, const DiagramPlan& present) const {
    const DiagramLoad near = load.nearPeople(look);
    const double listing = 1.0e-6 * kListedPageNs * load.sites * pagesLookedAt(look);
    const auto milliseconds = [&](const DiagramPlan& plan) {
        if (plan.extent == Extent::everywhere) return plan.cost->milliseconds(load);
        return plan.cost->milliseconds(near) - (1.0 - kGatheringShare) * plan.cost->base_ms + listing;
    };
    DiagramPlan best{&choose(load), Extent::everywhere};
    for (const MethodCost& candidate : costs) {
        const DiagramPlan listed{&candidate, Extent::near_people};
        const bool possible = candidate.method == DiagramMethod::binned && isWorthListing(load, look);
        if (possible && milliseconds(listed) < milliseconds(best)) best = listed;
    }
    if (present.cost && milliseconds(present) <= 1.1 * milliseconds(best)) return present;
    return best;
}

CostModel CostModel::only(DiagramMethod method) const {
    CostModel found{device, {}};
    std::ranges::copy_if(costs, std::back_inserter(found.costs),
                         [&](const MethodCost& cost) { return cost.method == method; });
    return found;
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

CostModel CostModel::builtInOfGpu() {
    CostModel model;
    model.device = "built in, of an NVIDIA H100";
    model.costs = {{DiagramMethod::gradient1, {}, 0.0515, 0.2906, 3.350, 0.5053},
                   {DiagramMethod::gradient2, {}, 0.0608, 0.2996, 3.615, 1.106},
                   {DiagramMethod::per_site, {}, 0.0580, 0.1137, 0.0, 0.0993},
                   {DiagramMethod::binned, {8, 4, 1.5f}, 0.0458, 0.00224, 0.2738, 0.01277},
                   {DiagramMethod::binned, {4, 4, 2.0f}, 0.0441, 0.00080, 0.1705, 0.01813}};
    return model;
}

}  // namespace throng::sim
