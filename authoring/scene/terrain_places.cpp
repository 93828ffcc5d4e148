// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/terrain_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "authoring/storeys/chart_raster.h"
#include "base/polygon.h"

namespace throng::authoring {
namespace {

constexpr std::size_t kLeastSpots = 16;  // of ground that counts where nobody says which: a square metre
constexpr int kBeside = 4;               // cells: so far from a place there may be its ground
constexpr double kOffLevel = 0.5;        // m, in height
constexpr double kLandingOff = 0.01;     // m, in height: the ground of a landing

void visitAll(Destination& destination, const std::function<void(Place&)>& visit) {
    for (Place& place : destination.places)
        visit(place);
}

}  // namespace

TerrainPlaces::TerrainPlaces(const Layout& layout, const Walkable& ground, const Pieces& pieces)
    : layout_(layout), ground_(ground), pieces_(pieces) {}

bool TerrainPlaces::findLevels(Diagnostics& diagnostics) {
    for (const Level& level : layout_.levels) {
        if (level.is_landing) {
            level_spots_.push_back(spotOnLanding(level));
            continue;
        }
        const glm::dvec3 at = level.at.value_or(glm::dvec3(0.0));
        const auto [begin, end] = ground_.spotsOf(chartCellOf(glm::dvec2(at)));
        const std::uint32_t spot = ground_.nearestSpot(chartCellOf(glm::dvec2(at)), at.z);
        level_spots_.push_back(spot);
        if (spot != kNoSpot && std::abs(double{ground_.spots()[spot].height} - at.z) <= kOffLevel) continue;
        std::string heights;
        for (std::uint32_t each = begin; each < end; ++each)
            heights += fmt::format("{}{:.2f}", each == begin ? "" : ", ", ground_.spots()[each].height);
        diagnostics.error(
            level.where,
            fmt::format("level `{}`: nobody can stand at [{:.2f}, {:.2f}, {:.2f}]", level.id, at.x, at.y,
                        at.z),
            heights.empty()
                ? std::string(
                      "there is no ground there with 2 m of headroom that slopes less than 45 degrees")
                : fmt::format("there is ground at z = {}: name one of these", heights));
    }
    if (diagnostics.hasErrors()) return false;
    // Nothing of a layout names a landing.
    for (std::size_t level = 0; level < layout_.levels.size(); ++level)
        steps_.push_back(layout_.levels[level].is_landing ? std::vector<std::uint32_t>()
                                                          : stepsFrom(level_spots_[level]));
    return true;
}

/// Of a landing that is built already, in its middle.
std::uint32_t TerrainPlaces::spotOnLanding(const Level& landing) const {
    glm::dvec2 middle(0.0);
    for (const glm::dvec2 corner : landing.floor)
        middle += corner / static_cast<double>(landing.floor.size());
    const std::uint32_t spot = ground_.nearestSpot(chartCellOf(middle), landing.height);
    const bool is_there =
        spot != kNoSpot && std::abs(double{ground_.spots()[spot].height} - landing.height) < kLandingOff;
    return is_there ? spot : kNoSpot;
}

std::uint32_t TerrainPlaces::onFootAt(glm::ivec2 cell, std::size_t level) const {
    const std::uint32_t spot = spotOf(cell, level);
    return spot != kNoSpot && steps_[level][spot] != kNoSpot ? spot : kNoSpot;
}

bool TerrainPlaces::counts(std::uint32_t spot) const {
    if (!chart_of_.empty()) return chart_of_[spot] != kNoSpot;
    return !layout_.levels.empty() || pieces_.spots[pieces_.piece_of[spot]] >= kLeastSpots;
}

std::vector<std::uint32_t> TerrainPlaces::stepsFrom(std::uint32_t spot) const {
    std::vector<std::uint32_t> steps(ground_.spots().size(), kNoSpot), reached = {spot};
    steps[spot] = 0;
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (const std::uint32_t next : ground_.spots()[reached[i]].next)
            if (next != kNoSpot && steps[next] == kNoSpot) {
                steps[next] = steps[reached[i]] + 1;
                reached.push_back(next);
            }
    return steps;
}

std::uint32_t TerrainPlaces::spotOf(glm::ivec2 cell, std::size_t level) const {
    const auto [begin, end] = ground_.spotsOf(cell);
    std::uint32_t best = kNoSpot;
    if (layout_.levels.empty()) {
        for (std::uint32_t spot = begin; spot < end && best == kNoSpot; ++spot)
            if (counts(spot)) best = spot;
        return best;
    }
    const std::uint32_t wanted = level_spots_[level];
    const auto apart = [&](std::uint32_t spot) {
        return std::abs(ground_.spots()[spot].height - ground_.spots()[wanted].height);
    };
    const std::vector<std::uint32_t>& steps = steps_[level];
    for (std::uint32_t spot = begin; spot < end; ++spot)
        if (counts(spot) &&
            (best == kNoSpot || std::pair(steps[spot], apart(spot)) < std::pair(steps[best], apart(best))))
            best = spot;
    return best;
}

std::uint32_t TerrainPlaces::spotAt(glm::dvec2 place, std::size_t level) const {
    const glm::ivec2 cell = chartCellOf(place);
    if (const std::uint32_t spot = spotOf(cell, level); spot != kNoSpot) return spot;
    std::uint32_t nearest = kNoSpot;
    double least = 1.0e9;
    for (int dy = -kBeside; dy <= kBeside; ++dy)
        for (int dx = -kBeside; dx <= kBeside; ++dx) {
            const glm::ivec2 beside = cell + glm::ivec2(dx, dy);
            const double away = glm::distance(chartCellMiddle(beside), place);
            if (away >= least) continue;
            if (const std::uint32_t spot = spotOf(beside, level); spot != kNoSpot) {
                nearest = spot;
                least = away;
            }
        }
    return nearest;
}

std::uint32_t TerrainPlaces::spotIn(const std::vector<glm::dvec2>& outline, std::size_t level) const {
    glm::dvec2 middle(0.0);
    for (const glm::dvec2 point : outline)
        middle += point / static_cast<double>(outline.size());
    std::uint32_t nearest = kNoSpot;
    double least = 1.0e9;
    const auto [lowest, highest] = cellsRound(outline);
    const glm::ivec2 first = glm::max(lowest, ground_.first()),
                     last = glm::min(highest, ground_.first() + ground_.size() - 1);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const glm::dvec2 at = chartCellMiddle({x, y});
            const double away = glm::distance(at, middle);
            if (away >= least || !isWithin(outline, at)) continue;
            if (const std::uint32_t spot = spotOf({x, y}, level); spot != kNoSpot) {
                nearest = spot;
                least = away;
            }
        }
    return nearest != kNoSpot ? nearest : spotAt(middle, level);
}

std::pair<glm::ivec2, glm::ivec2> cellsRound(const std::vector<glm::dvec2>& outline) {
    constexpr double kFarthest = 1.0e8;  // m, which whole numbers of cells hold
    glm::dvec2 lower = outline.front(), upper = lower;
    for (const glm::dvec2 point : outline) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    return {chartCellOf(glm::clamp(lower, -kFarthest, kFarthest)),
            chartCellOf(glm::clamp(upper, -kFarthest, kFarthest))};
}

void TerrainPlaces::keepTo(const std::vector<Surface>& surfaces) {
    chart_of_.assign(ground_.spots().size(), kNoSpot);
    for (std::uint32_t chart = 0; chart < surfaces.size(); ++chart)
        for (const std::uint32_t spot : surfaces[chart].spots)
            if (spot != kNoSpot) chart_of_[spot] = chart;
}

void visitPlaces(Layout& layout, const std::function<void(Place&)>& visit) {
    for (Flow& flow : layout.flows) {
        visit(flow.from);
        visitAll(flow.to, visit);
        for (BehaviourState& stop : flow.via)
            visitAll(stop.to, visit);
    }
    for (Formation& formation : layout.formations) {
        if (auto* grid = std::get_if<GridFormation>(&formation.shape))
            if (auto* goal = std::get_if<Destination>(&grid->goal)) visitAll(*goal, visit);
        if (auto* list = std::get_if<ListFormation>(&formation.shape))
            for (ListedAgent& agent : list->agents)
                if (agent.to) visitAll(*agent.to, visit);
    }
    for (Event& event : layout.events)
        visitAll(event.then.to, visit);
    for (Behaviour& behaviour : layout.behaviours)
        for (BehaviourState& state : behaviour.states) {
            visitAll(state.to, visit);
            for (Transition& transition : state.until)
                for (Condition& condition : transition.conditions)
                    visit(condition.place);
        }
}

}  // namespace throng::authoring
