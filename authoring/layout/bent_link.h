// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "authoring/layout.h"

/// Links that turn, as stairwells do: flights that are straight, and landings between them.
///
/// A landing lies at each corner of the path, square to both flights; where two corners are so near to each
/// other that no flight fits between, one landing takes both in, and the way turns half round. All else is as
/// if somebody had written flights and landings as links and levels of their own.
namespace throng::authoring {

struct BentLink {
    std::vector<Level> landings;
    std::vector<Link>
        flights;  ///< flight i leads from landing i - 1 to landing i, the first and last from and to floors
};

struct BentLinkFault {
    std::string message, hint;
};

/// @param link its id, kind, width and the heights that it leads between; @param path three points or more
/// @param riser m: about as high are steps of what has any; 0: it has none
/// @returns without landings where there is a fault
BentLink bend(const Link& link, const std::vector<glm::dvec2>& path, double low, double high, double riser,
              std::optional<BentLinkFault>& fault);

/// Heights of landings, by the lengths of the flights; where there are steps, all of them are as high.
void raiseLandings(const std::vector<Link>& flights, const std::vector<Level*>& landings, double low,
                   double high, double riser);

}  // namespace throng::authoring
