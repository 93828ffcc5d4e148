// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "authoring/storeys/walkable.h"

namespace throng::authoring {

/// The ground of a chart that is cut from a terrain: at most one spot in a cell.
struct Surface {
    std::shared_ptr<const Walkable> ground;
    glm::ivec2 first{0}, size{0};
    std::vector<std::uint32_t> spots;  ///< by cell, kNoSpot where it has none

    std::uint32_t spotAt(glm::ivec2 cell) const;
    bool contains(glm::dvec2 home) const;
    /// m; beside it, that of a cell beside the place, or nothing that means anything
    double heightAt(glm::dvec2 home) const;
};

/// Whether one walks from a cell of one surface to the cell beside it of another.
bool areJoined(const Surface& a, glm::dvec2 in_a, const Surface& b, glm::dvec2 in_b);

}  // namespace throng::authoring
