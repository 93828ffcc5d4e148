// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "authoring/source_position.h"

namespace throng::authoring {

/// A place that people come from or go to: an area, or one end of a road.
struct Place {
    enum class Kind { area, road_start, road_end, aisle };
    Kind kind = Kind::area;
    std::size_t index = 0;  ///< into Layout::areas, roads or, of aisles, seats
    SourcePosition where;
    std::size_t number = 0;  ///< of the block's aisles
};

/// Where somebody goes: one place, whichever of several is nearest by the present routes, or one drawn by
/// weight.
struct Destination {
    enum class Kind { one, nearest, choose };
    Kind kind = Kind::one;
    std::vector<Place> places;
    std::vector<double> weights;  ///< choose: one per place
    SourcePosition where;
};

}  // namespace throng::authoring
