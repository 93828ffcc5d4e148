// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/rebase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "authoring/scene/random.h"
#include "shaders/shared/chart_types.h"

namespace throng::authoring {
namespace {

constexpr double kMargin = 3.0;  // m around everything: room to be pushed into
const double kQuantum = double{gpu::PLACES_PER_METRE};
constexpr double kNearTheOrigin = 2048.0;  // m: up to here float32 keeps a quarter of a millimetre

class Bounds {
  public:
    void add(glm::dvec2 point, const SourcePosition& where, double around = 0.0) {
        for (int axis = 0; axis < 2; ++axis) {
            if (point[axis] - around < lower[axis]) {
                lower[axis] = point[axis] - around;
                lowest_[axis] = &where;
            }
            if (point[axis] + around > upper[axis]) {
                upper[axis] = point[axis] + around;
                highest_[axis] = &where;
            }
        }
    }
    /// Of what reaches furthest along the longer side.
    SourcePosition outermost() const {
        const int axis = upper.x - lower.x > upper.y - lower.y ? 0 : 1;
        const SourcePosition* found =
            std::abs(upper[axis]) > std::abs(lower[axis]) ? highest_[axis] : lowest_[axis];
        return found ? *found : SourcePosition{};
    }
    glm::dvec2 lower{1.0e300};
    glm::dvec2 upper{-1.0e300};

  private:
    std::array<const SourcePosition*, 2> lowest_{}, highest_{};
};

Bounds boundsOf(const Layout& layout) {
    Bounds bounds;
    for (const Road& road : layout.roads)
        for (const glm::dvec2 point : road.centreline)
            bounds.add(point, road.where, 0.5 * road.width);
    for (const Area& area : layout.areas)
        for (const glm::dvec2 point : area.polygon)
            bounds.add(point, area.where);
    for (const Zebra& crossing : layout.traffic.crossings)
        for (const glm::dvec2 point : crossing.polygon)
            bounds.add(point, crossing.where);
    for (const Patch& patch : layout.patches)
        for (const glm::dvec2 point : patch.polygon)
            bounds.add(point, patch.where);
    for (const GivenPeople& given : layout.given)
        for (const std::vector<GivenPoint>& way : given.ways)
            for (const GivenPoint& point : way)
                bounds.add(point.place, given.where, 1.0);
    for (const Wall& wall : layout.walls)
        for (const glm::dvec2 point : wall.points)
            bounds.add(point, wall.where, wall.closed ? 0.0 : 0.5 * wall.thickness);
    for (const Flow& flow : layout.flows)
        for (const BehaviourState& stop : flow.via)
            for (const glm::dvec2 point : stop.line)
                bounds.add(point, stop.where);
    for (const Formation& formation : layout.formations) {
        const FormationPlaces places = formationPlaces(formation, layout.simulation.seed);
        for (const glm::dvec2 point : places.positions)
            bounds.add(point, formation.where, 1.0);
        for (const glm::dvec2 point : places.goals)
            bounds.add(point, formation.where, 1.0);
        if (const auto* list = std::get_if<ListFormation>(&formation.shape))
            for (const ListedAgent& agent : list->agents)
                for (const Waypoint& waypoint : agent.via)
                    bounds.add(waypoint.point, waypoint.where, 1.0);
    }
    static const SourcePosition nowhere;
    if (bounds.lower.x > bounds.upper.x) bounds.add({0.0, 0.0}, nowhere, 1.0);
    return bounds;
}

void placeCircle(const CircleFormation& circle, FormationPlaces& places) {
    double radius = circle.radius;
    for (std::uint64_t placed = 0; placed < circle.count; radius += circle.ring_spacing) {
        std::uint64_t on_ring = circle.count;
        if (circle.ring_spacing > 0.0)
            on_ring = static_cast<std::uint64_t>(std::clamp(2.0 * std::numbers::pi * radius / circle.along,
                                                            1.0, static_cast<double>(circle.count)));
        for (std::uint64_t i = 0; i < on_ring && placed < circle.count; ++i, ++placed) {
            const double angle =
                2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(on_ring);
            const glm::dvec2 arm = radius * glm::dvec2(std::cos(angle), std::sin(angle));
            places.positions.push_back(circle.centre + arm);
            places.goals.push_back(circle.centre - arm);
        }
    }
}

glm::dvec2 mirrored(glm::dvec2 point, const Line& line) {
    const glm::dvec2 axis = line.b - line.a;
    const glm::dvec2 foot = line.a + axis * (glm::dot(point - line.a, axis) / glm::dot(axis, axis));
    return 2.0 * foot - point;
}

void placeGrid(const GridFormation& grid, const GroupRandom& random, FormationPlaces& places) {
    const double angle = grid.rotation * std::numbers::pi / 180.0;
    const glm::dvec2 across(std::cos(angle), std::sin(angle));
    const glm::dvec2 up(-across.y, across.x);
    const std::uint64_t count = grid.count ? grid.count : grid.rows * grid.columns;
    places.positions.reserve(count);
    for (std::uint64_t person = 0; person < count; ++person) {
        // A count fills column by column, so that the last column is the one that is not full.
        const std::uint64_t column = grid.count ? person / grid.rows : person % grid.columns;
        const std::uint64_t row = grid.count ? person % grid.rows : person / grid.columns;
        const glm::dvec2 jitter(random.unit(person, Purpose::jitter_x) * 2.0 - 1.0,
                                random.unit(person, Purpose::jitter_y) * 2.0 - 1.0);
        places.positions.push_back(grid.origin + across * (static_cast<double>(column) * grid.spacing) +
                                   up * (static_cast<double>(row) * grid.spacing) + jitter * grid.jitter);
        if (const auto* offset = std::get_if<glm::dvec2>(&grid.goal))
            places.goals.push_back(places.positions.back() + *offset);
        if (const auto* line = std::get_if<Line>(&grid.goal))
            places.goals.push_back(mirrored(places.positions.back(), *line));
        if (const auto* box = std::get_if<Extent>(&grid.goal))
            places.goals.push_back(box->a +
                                   (box->b - box->a) * glm::dvec2(random.unit(person, Purpose::goal_x),
                                                                  random.unit(person, Purpose::goal_y)));
    }
}

}  // namespace

FormationPlaces formationPlaces(const Formation& formation, std::uint64_t seed) {
    FormationPlaces places;
    if (const auto* circle = std::get_if<CircleFormation>(&formation.shape)) placeCircle(*circle, places);
    if (const auto* grid = std::get_if<GridFormation>(&formation.shape))
        placeGrid(*grid, GroupRandom(seed, formation.id), places);
    if (const auto* list = std::get_if<ListFormation>(&formation.shape))
        for (const ListedAgent& agent : list->agents) {
            places.positions.push_back(agent.position);
            places.goals.push_back(agent.goal);
        }
    return places;
}

// A layout moved by whole metres has bounds moved by whole metres (up to double rounding, far below the
// quantum), the same fraction in its middle, and so the same local coordinates.
Rebase::Rebase(const Layout& layout) {
    const Bounds bounds = boundsOf(layout);
    const glm::dvec2 middle = 0.5 * (bounds.lower + bounds.upper);
    origin_ = {std::floor(middle.x + 0.25),
               std::floor(middle.y + 0.25)};  // a quarter: halves are common and must not flicker
    const double furthest = std::max({std::abs(bounds.lower.x), std::abs(bounds.lower.y),
                                      std::abs(bounds.upper.x), std::abs(bounds.upper.y)});
    output_origin_ = furthest < kNearTheOrigin ? glm::dvec2(0.0) : origin_;
    const glm::dvec2 size = bounds.upper - bounds.lower;
    extent_ = std::max(size.x, size.y);
    outermost_ = bounds.outermost();
    minimum_ = local(bounds.lower - kMargin);
    maximum_ = local(bounds.upper + kMargin);
}

glm::vec2 Rebase::local(glm::dvec2 world) const {
    const glm::dvec2 offset = (world - origin_) * kQuantum;
    return {static_cast<float>(std::round(offset.x) / kQuantum),
            static_cast<float>(std::round(offset.y) / kQuantum)};
}

std::vector<glm::vec2> Rebase::local(const std::vector<glm::dvec2>& world) const {
    std::vector<glm::vec2> points;
    points.reserve(world.size());
    for (const glm::dvec2 point : world)
        points.push_back(local(point));
    return points;
}

}  // namespace throng::authoring
