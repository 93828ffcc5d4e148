// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "authoring/layout/json_document.h"

namespace throng::authoring {

struct Crossing {
    glm::dvec2 point{0.0};
    std::size_t first_edge = 0;  ///< edge i runs from point i to the next
    std::size_t second_edge = 0;
};

/// The first place where a polygon's outline crosses itself, or, if that counts, only touches itself. Sweeps
/// over the edges sorted by x.
std::optional<Crossing> selfCrossing(const std::vector<glm::dvec2>& polygon, bool touching_counts = true);

/// Takes points out that are there twice in a row, and those at which the outline runs back over itself: they
/// bound nothing. @returns how many
std::size_t removeSpikes(std::vector<glm::dvec2>& polygon);

/// Drops a point that closes it by hand, as many tools write it, and tells of outlines that cross themselves
/// or bound nothing. @param node where it stands; null, or of less than three points: nothing is told
void checkPolygon(std::vector<glm::dvec2>& polygon, const JsonNode* node, Diagnostics& diagnostics);

/// Positive for counter-clockwise polygons, m^2.
double signedArea(const std::vector<glm::dvec2>& polygon);

}  // namespace throng::authoring
