// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace throng::authoring {

/// The ways to build the truncated Voronoi diagram; `automatic` picks one for the device and the crowd.
enum class DiagramMethod {
    automatic,
    cones,             ///< a cone per site and the depth test (Hoff et al. 1999)
    gradient1,         ///< point sprites that write their squared distance as depth (Denny 2003)
    gradient2,         ///< point sprites blended by minimum (Strzodka and Telea 2004): distance, then id
    gradient2_packed,  ///< the same in one pass, with the distance quantised to make room for the id
    per_pixel,         ///< every pixel compares all sites
    per_site,          ///< every site offers itself to the pixels under its tile, atomically
    jfa,               ///< jump flooding (Rong and Tan 2006), over the whole window, then truncated
    jfa_one_before,    ///< 1+JFA (Rong and Tan 2007): a round of step 1 first
    jfa_one_after,     ///< JFA+1 (Rong and Tan 2007): a round of step 1 more at the end
    jfa_from_radius,   ///< jump flooding whose first step is the largest tile radius
    binned,            ///< sites sorted into bins, every block of pixels looks through the bins near it
};

struct DiagramMethodEntry {
    DiagramMethod method;
    std::string_view word;  ///< in layouts, on the command line and in reports
    bool exact;             ///< equals comparing all sites at every pixel, ties to the smallest id
};

inline constexpr std::array kDiagramMethods = {
    DiagramMethodEntry{DiagramMethod::cones, "cones", false},
    DiagramMethodEntry{DiagramMethod::gradient1, "gradient1", true},
    DiagramMethodEntry{DiagramMethod::gradient2, "gradient2", true},
    DiagramMethodEntry{DiagramMethod::gradient2_packed, "gradient2-packed", false},
    DiagramMethodEntry{DiagramMethod::per_pixel, "per-pixel", true},
    DiagramMethodEntry{DiagramMethod::per_site, "per-site", true},
    DiagramMethodEntry{DiagramMethod::jfa, "jfa", false},
    DiagramMethodEntry{DiagramMethod::jfa_one_before, "1+jfa", false},
    DiagramMethodEntry{DiagramMethod::jfa_one_after, "jfa+1", false},
    DiagramMethodEntry{DiagramMethod::jfa_from_radius, "jfa-r", false},
    DiagramMethodEntry{DiagramMethod::binned, "binned", true},
};

constexpr std::string_view wordFor(DiagramMethod method) {
    for (const DiagramMethodEntry& entry : kDiagramMethods)
        if (entry.method == method) return entry.word;
    return "auto";
}

constexpr std::optional<DiagramMethod> diagramMethodNamed(std::string_view word) {
    if (word == "auto") return DiagramMethod::automatic;
    for (const DiagramMethodEntry& entry : kDiagramMethods)
        if (entry.word == word) return entry.method;
    return std::nullopt;
}

constexpr bool isExact(DiagramMethod method) {
    for (const DiagramMethodEntry& entry : kDiagramMethods)
        if (entry.method == method) return entry.exact;
    return true;  // automatic picks among the exact ones
}

}  // namespace throng::authoring
