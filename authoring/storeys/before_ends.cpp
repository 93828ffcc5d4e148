// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/before_ends.h"

#include <fmt/format.h>

#include <cmath>

#include "authoring/link_kinds.h"
#include "authoring/storeys/cabin.h"
#include "base/polygon.h"

namespace throng::authoring {

bool standsBefore(const Wall& wall, const Chart& link, bool at_end) {
    constexpr double kStep = 0.1;  // m
    const int steps = static_cast<int>(std::lround(kBeforeDoors / kStep));
    const double half = link.is_cabin ? link.half_door : link.link.half_width - 0.5 * kRailing;
    for (int step = 1; step <= steps; ++step)
        for (const double aside : {-0.9, -0.5, 0.0, 0.5, 0.9}) {
            const double along = at_end ? link.link.length + kStep * step : -kStep * step;
            const glm::dvec2 at = link.link.at(along, aside * half);
            const double away = wall.closed ? distanceToPolygon(wall.points, at)
                                            : distanceToPieces(wall.points, wall.points.size() - 1, at);
            if (away < 0.5 * (kStep + (wall.closed ? 0.0 : wall.thickness))) return true;
        }
    return false;
}

void checkRoomInCabin(const Layout& layout, const Link& lift, Diagnostics& diagnostics) {
    const std::uint32_t fit = spotsIn(layout, lift.lift).count();
    if (fit == 0 || lift.lift.capacity.value_or(1) > fit)
        diagnostics.error(
            lift.where,
            fmt::format("the cabin of lift `{}`, {:.2f} x {:.2f} m, has room for {} of the layout's "
                        "people, not for {}",
                        lift.id, lift.lift.size.x, lift.lift.size.y, fit, lift.lift.capacity.value_or(1)),
            "enlarge its `size`, or ask for less `capacity`");
}

}  // namespace throng::authoring
