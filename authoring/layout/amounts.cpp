// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/amounts.h"

#include <algorithm>
#include <cmath>

namespace throng::authoring {
namespace {

/// s in which those of a flow come; who comes from the first moment on does so in the warm-up, too.
double secondsOf(const auto& flow, const Layout& layout) {
    return flow.end - flow.start + (flow.start == 0.0 ? layout.simulation.warmup : 0.0);
}

/// How often `count` of them come: once, or with each vehicle that they get off.
double callsOf(const Flow& flow, const Layout& layout) {
    if (!flow.alights) return 1.0;
    double calls = 0.0;
    for (const std::size_t line : flow.alights->lines) {
        const VehicleFlow& vehicles = layout.traffic.vehicles[line];
        calls += vehicles.rate ? *vehicles.rate * secondsOf(vehicles, layout)
                               : static_cast<double>(vehicles.times.size());
    }
    return calls;
}

}  // namespace

double meanOf(const Distribution& drawn) {
    if (drawn.kind == Distribution::Kind::uniform) return 0.5 * (drawn.minimum + drawn.maximum);
    const double mean = drawn.kind == Distribution::Kind::log_normal
                            ? std::exp(drawn.mean + 0.5 * drawn.standard_deviation * drawn.standard_deviation)
                            : drawn.mean;
    return std::clamp(mean, drawn.minimum, drawn.maximum);
}

double peopleIn(const Flow& flow, const Layout& layout) {
    if (flow.count) return callsOf(flow, layout) * static_cast<double>(*flow.count);
    if (!flow.times.empty()) return static_cast<double>(flow.times.size());
    const double seconds = std::max(0.0, secondsOf(flow, layout));
    if (flow.gaps) return seconds / std::max(meanOf(*flow.gaps), kLeastGap);
    return flow.rate.value_or(0.0) * seconds;
}

double peopleIn(const Formation& formation) {
    if (const auto* circle = std::get_if<CircleFormation>(&formation.shape))
        return static_cast<double>(circle->count);
    if (const auto* grid = std::get_if<GridFormation>(&formation.shape))
        return grid->count ? static_cast<double>(grid->count)
                           : static_cast<double>(grid->rows) * static_cast<double>(grid->columns);
    return static_cast<double>(std::get<ListFormation>(formation.shape).agents.size());
}

}  // namespace throng::authoring
