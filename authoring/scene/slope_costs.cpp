// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/slope_costs.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "authoring/scene/chart_map.h"

namespace throng::authoring {
namespace {

constexpr float kFlatEnough = 0.02f;  // rise over run: costs nothing
constexpr float kSteepestKnown = 1.0f;
constexpr int kSlopeSteps = 50;  // in so many steps

}  // namespace

SlopeCosts::SlopeCosts(const MotionSettings& motion) {
    for (int stairs = 0; stairs < 2; ++stairs)
        for (int i = 0; i <= kSlopeSteps; ++i)
            slopes_[stairs].push_back(
                costOfLink(motion, stairs == 1, double{kSteepestKnown} * i / kSlopeSteps));
}

SlopeCosts::SlopeCosts(const MotionSettings& motion, const Terrain& terrain) : SlopeCosts(motion) {
    minimum_ = terrain.minimum();
    lattice_ = terrain.lattice();
    nodes_.reserve(std::size_t{lattice_.width} * lattice_.height);
    for (std::uint32_t y = 0; y < lattice_.height; ++y)
        for (std::uint32_t x = 0; x < lattice_.width; ++x) {
            const glm::vec2 place = minimum_ + glm::vec2(x, y) * lattice_.cell;
            nodes_.push_back(of(glm::length(terrain.slopeAt(place)), terrain.stepsAt(place) > 0.5f));
        }
}

float SlopeCosts::of(float slope, bool stairs) const {
    if (slope < kFlatEnough) return 1.0f;
    const auto step = std::lround(std::min(slope, kSteepestKnown) / kSteepestKnown * kSlopeSteps);
    return slopes_[stairs ? 1 : 0][static_cast<std::size_t>(step)];
}

float SlopeCosts::at(glm::vec2 place) const {
    if (nodes_.empty()) return 1.0f;
    const glm::vec2 last(lattice_.width - 1, lattice_.height - 1);
    const glm::uvec2 node(glm::clamp(glm::round((place - minimum_) / lattice_.cell), glm::vec2(0.0f), last));
    return nodes_[std::size_t{node.y} * lattice_.width + node.x];
}

bool SlopeCosts::meets(glm::vec2 a, glm::vec2 b) const {
    const int steps = 1 + static_cast<int>(glm::distance(a, b) / lattice_.cell);
    for (int i = 0; i <= steps; ++i)
        if (isWorthAWayRound(glm::mix(a, b, static_cast<float>(i) / static_cast<float>(steps)))) return true;
    return false;
}

bool SlopeCosts::isFlat() const {
    return std::ranges::all_of(nodes_, [](float cost) { return cost == 1.0f; });
}

}  // namespace throng::authoring
