// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/link_grounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "authoring/link_kinds.h"
#include "authoring/storeys/before_ends.h"
#include "authoring/storeys/chart_raster.h"
#include "authoring/storeys/cut.h"
#include "authoring/storeys/links_apart.h"
#include "base/polygon.h"

namespace throng::authoring {
namespace {

constexpr double kOnSlope = 0.21;     // m: treads are so far from the slope of their stairs at the most
constexpr double kOnFloor = 0.01;     // m
constexpr double kBesideIt = 0.05;    // m: an edge along the side of a link
constexpr double kOverIt = 0.3;       // m: an edge that is so far over a link is that of an opening
constexpr double kToCorner = 0.2;     // m: where edges end with the side of a link
constexpr double kHairInside = 0.13;  // m: half a cell
constexpr double kPiece = 0.025;      // m: edges are looked at in such pieces
constexpr double kShareOfWidth = 0.6;

/// The spots of the lattice on a link's part.
std::vector<std::uint32_t> spotsOn(const Walkable& ground, const Chart& part) {
    const double off = part.is_link && !part.is_cabin ? kOnSlope : kOnFloor;
    const auto [lower, upper] = part.bounds();
    const glm::ivec2 first = chartCellOf(lower), last = chartCellOf(upper);
    std::vector<std::uint32_t> spots;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const glm::dvec2 middle = chartCellMiddle({x, y});
            if (!part.is_link ? !isWithin(part.floor, middle) : !part.contains(middle)) continue;
            const double height = part.heightAt(middle);
            const std::uint32_t spot = ground.nearestSpot({x, y}, height);
            if (spot != kNoSpot && std::abs(double{ground.spots()[spot].height} - height) < off)
                spots.push_back(spot);
        }
    return spots;
}

std::vector<glm::dvec2> outlineOf(const Chart& part) {
    return part.is_link ? part.link.outline(0.0, part.link.length) : part.floor;
}

double distanceTo(const Chart& part, glm::dvec2 place) {
    const std::vector<glm::dvec2> outline = outlineOf(part);
    return distanceToPieces(outline, outline.size(), place);
}

/// The end of a link's side, or of what is beside its doors, if a place is near to it.
glm::dvec2 atCorner(glm::dvec2 place, const Chart& part) {
    std::vector<glm::dvec2> corners = outlineOf(part);
    if (part.is_cabin)
        for (const double side : {-1.0, 1.0})
            corners.push_back(part.link.at(0.0, side * part.half_door));
    const glm::dvec2 nearest = *std::ranges::min_element(
        corners, {}, [&](glm::dvec2 corner) { return glm::distance(place, corner); });
    return glm::distance(place, nearest) < kToCorner ? nearest : place;
}

/// Whether a place is within the opening before an end, where nothing stands any more, and ground is behind
/// it.
bool isBeforeEnd(const Chart& part, glm::dvec2 place, const Surface& ground) {
    constexpr double kBehind = kThrough + 0.15;  // m
    if (!part.is_link) return false;
    const double clear = part.is_cabin ? part.half_door : part.link.half_width - 0.5 * kRailing;
    const double along = part.link.alongOf(place), aside = part.link.asideOf(place);
    if (std::abs(aside) > clear) return false;
    const auto is_within = [](double beyond) { return beyond > -kHairInside && beyond < kThrough; };
    if (is_within(-along)) return ground.contains(part.link.at(-kBehind, aside));
    return !part.is_cabin && is_within(along - part.link.length) &&
           ground.contains(part.link.at(part.link.length + kBehind, aside));
}

/// How many cells of a link's end lead on to each chart.
struct Onward {
    std::map<std::size_t, int> charts;
    int count = 0;
};

Onward onwardFrom(const std::vector<Chart>& charts, std::size_t link, bool at_end) {
    const Chart& chart = charts[link];
    const Surface& surface = *chart.surface;
    Onward onward;
    for (const std::uint32_t spot : surface.spots) {
        if (spot == kNoSpot) continue;
        const glm::ivec2 cell = surface.ground->spots()[spot].cell;
        for (std::size_t side = 0; side < kSides.size(); ++side) {
            const double along = chart.link.alongOf(chartCellMiddle(cell + kSides[side]));
            if (at_end ? along <= chart.link.length : along >= 0.0) continue;
            const std::uint32_t next = surface.ground->spots()[spot].next[side];
            if (next == kNoSpot) continue;
            for (std::size_t other = 0; other < charts.size(); ++other)
                if (other != link && charts[other].surface->spotAt(cell + kSides[side]) == next) {
                    ++onward.charts[other];
                    ++onward.count;
                }
        }
    }
    return onward;
}

/// The same, if nothing were in the way.
int cellsAcross(const Chart& link, bool at_end) {
    int count = 0;
    const auto [lower, upper] = link.bounds();
    const glm::ivec2 first = chartCellOf(lower), last = chartCellOf(upper);
    const double wide = link.is_cabin ? link.half_door : link.link.half_width;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
            for (const glm::ivec2 side : kSides) {
                const glm::dvec2 middle = chartCellMiddle({x, y});
                const double along = link.link.alongOf(middle),
                             beyond = link.link.alongOf(chartCellMiddle(glm::ivec2(x, y) + side));
                if (along >= 0.0 && along <= link.link.length &&
                    std::abs(link.link.asideOf(middle)) <= wide &&
                    (at_end ? beyond > link.link.length : beyond < 0.0))
                    ++count;
            }
    return count;
}

void joinEnd(const Layout& layout, std::size_t link, bool at_end, std::vector<Chart>& charts,
             Diagnostics& diagnostics) {
    Chart& chart = charts[link];
    const Link& given = layout.links[chart.index];
    const std::size_t level = chart.is_cabin ? given.lift.levels[chart.stop] : at_end ? given.to : given.from;
    const glm::dvec2 at = chart.link.at(at_end ? chart.link.length : 0.0, 0.0);
    const Onward onward = onwardFrom(charts, link, at_end);
    const double share = static_cast<double>(onward.count) / std::max(cellsAcross(chart, at_end), 1);
    if (onward.count == 0) {
        const std::string what =
            chart.is_cabin ? fmt::format("the doors of lift `{}` open onto a wall or an edge", given.id)
                           : fmt::format("link `{}` ends at a wall or an edge", given.id);
        diagnostics.error(given.where,
                          fmt::format("{}: nobody gets from it to level `{}` at [{:.2f}, {:.2f}]", what,
                                      layout.levels[level].id, at.x, at.y),
                          "people step up or down 0.25 m at most, and need 2 m over their heads");
        return;
    }
    const auto most =
        std::ranges::max_element(onward.charts, {}, [](const auto& each) { return each.second; });
    (at_end ? chart.link_to : chart.link_from) = most->first;
    if (share < kShareOfWidth && !chart.is_cabin)
        diagnostics.warning(
            given.where,
            fmt::format("link `{}` meets level `{}` with {:.0f} % of its width, at [{:.2f}, {:.2f}]",
                        given.id, layout.levels[level].id, 100.0 * share, at.x, at.y),
            "move its end to where the ground is as wide");
}

/// Layouts' walls may not stand before an end.
void tellOfWallsBefore(const Layout& layout, const Chart& chart, Diagnostics& diagnostics) {
    const Link& link = layout.links[chart.index];
    const auto tell = [&](std::size_t level, bool at_end) {
        if (layout.levels[level].is_landing) return;
        for (const Wall& wall : layout.walls)
            if (wall.toggles.empty() && wall.level == level && standsBefore(wall, chart, at_end))
                diagnostics.error(
                    link.where,
                    fmt::format("{} `{}` {} wall `{}` at level `{}`",
                                chart.is_cabin ? "the doors of lift" : "link", link.id,
                                chart.is_cabin ? "open into" : "ends in", wall.id, layout.levels[level].id),
                    fmt::format("leave {:.1f} m before {} free", kBeforeDoors,
                                chart.is_cabin ? "them" : "it"));
    };
    tell(chart.is_cabin ? link.lift.levels[chart.stop] : link.from, false);
    if (!chart.is_cabin) tell(link.to, true);
}

}  // namespace

LinkGrounds::LinkGrounds(const std::shared_ptr<const Walkable>& ground, const BuiltLinks& built)
    : built_(built) {
    for (std::size_t part = 0; part < built.parts.size(); ++part) {
        taken_.resize(ground->spots().size(), false);
        const std::vector<std::uint32_t> spots = spotsOn(*ground, built.parts[part].chart);
        if (spots.empty()) continue;
        for (const std::uint32_t spot : spots)
            taken_[spot] = true;
        surfaces_.push_back(surfaceOf(ground, spots));
        parts_.push_back(part);
    }
}

void LinkGrounds::addCharts(std::vector<Chart>& charts) const {
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        charts.push_back(built_.parts[parts_[i]].chart);
        charts.back().surface = std::make_shared<const Surface>(surfaces_[i]);
        charts.back().openings.clear();
    }
}

bool LinkGrounds::hasRailing(std::size_t surface, glm::dvec2 place) const {
    return std::ranges::any_of(built_.parts[parts_[surface]].railings, [&](const Railing& railing) {
        return distanceToPieces(railing.points, 1, place) < kBesideIt;
    });
}

/// The part of a link on whose outline a piece of an edge lies.
const BuiltLink* LinkGrounds::partAlong(const SurfaceEdge& edge, glm::dvec2 a, glm::dvec2 b) const {
    const glm::dvec2 middle = 0.5 * (a + b);
    for (const BuiltLink& part : built_.parts) {
        const double over = edge.high - part.chart.heightAt(middle);
        const bool is_near =
            over > -kHeadroom && (!part.chart.is_cabin || part.chart.stop == 0 || over < kOverIt);
        if (is_near && distanceTo(part.chart, middle) < kBesideIt) return &part;
    }
    return nullptr;
}

/// Round a cabin there are its own sides, where it stops.
SurfaceEdge::Beside LinkGrounds::besideWhat(const SurfaceEdge& edge, const BuiltLink& part,
                                            glm::dvec2 place) const {
    using enum SurfaceEdge::Beside;
    if (edge.high - part.chart.heightAt(place) < kOverIt) return railing;
    const bool stops = part.chart.is_cabin && std::ranges::any_of(built_.parts, [&](const BuiltLink& stop) {
                           return stop.chart.is_cabin && stop.chart.index == part.chart.index &&
                                  std::abs(stop.chart.link.low - edge.high) < kOverIt;
                       });
    return stops ? railing : opening;
}

void LinkGrounds::addPiece(const SurfaceEdge& edge, glm::dvec2 a, glm::dvec2 b,
                           std::vector<SurfaceEdge>& kept) const {
    using enum SurfaceEdge::Beside;
    const BuiltLink* part = partAlong(edge, a, b);
    const SurfaceEdge::Beside beside = part ? besideWhat(edge, *part, 0.5 * (a + b)) : nothing;
    // Ground is known in cells, and railings end where they end.
    if (part)
        for (glm::dvec2* end : {&a, &b})
            *end = atCorner(*end, part->chart);
    if (!kept.empty() && kept.back().surface == edge.surface && kept.back().beside == beside &&
        kept.back().points.back() == a && kept.back().low == edge.low)
        kept.back().points.push_back(b);
    else if (glm::distance(a, b) > 1.0e-3)
        kept.push_back({edge.surface, {a, b}, edge.low, edge.high, beside});
}

/// Edges lie where cells say, and the ground before an end is open as far as it is wide.
void LinkGrounds::addWithoutOpenings(const SurfaceEdge& edge, const Surface& ground, glm::dvec2 a,
                                     glm::dvec2 b, std::vector<SurfaceEdge>& kept) const {
    const auto is_open = [&](glm::dvec2 place) {
        return std::ranges::any_of(built_.parts, [&](const BuiltLink& part) {
            return isBeforeEnd(part.chart, place, ground) &&
                   std::abs(part.chart.heightAt(place) - edge.high) < kOverIt;
        });
    };
    const int pieces = std::max(1, static_cast<int>(std::ceil(glm::distance(a, b) / kPiece)));
    const auto at = [&](int piece) { return glm::mix(a, b, static_cast<double>(piece) / pieces); };
    int begin = 0;
    for (int piece = 0; piece <= pieces; ++piece) {
        const bool ends = piece == pieces || is_open(0.5 * (at(piece) + at(piece + 1)));
        if (!ends) continue;
        if (piece > begin) addPiece(edge, at(begin), at(piece), kept);
        begin = piece + 1;
    }
}

/// Of two cells on either side of an end that are not joined, others beside them are: there is a way.
bool LinkGrounds::isInDoorway(const SurfaceEdge& edge, const std::vector<Surface>& surfaces,
                              glm::dvec2 place) const {
    const std::size_t first_link = surfaces.size() - surfaces_.size();
    const Chart& own = built_.parts[parts_[edge.surface - first_link]].chart;
    const double height = own.heightAt(place);
    for (std::size_t ground = 0; ground < first_link; ++ground)
        if (isBeforeEnd(own, place, surfaces[ground]) &&
            std::abs(surfaces[ground].heightAt(place) - height) < kOverIt)
            return true;
    return false;
}

std::vector<SurfaceEdge> LinkGrounds::sorted(const std::vector<SurfaceEdge>& edges,
                                             const std::vector<Surface>& surfaces) const {
    if (surfaces_.empty()) return edges;
    const std::size_t first_link = surfaces.size() - surfaces_.size();
    std::vector<SurfaceEdge> kept;
    for (const SurfaceEdge& edge : edges)
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
            const glm::dvec2 a = edge.points[i], b = edge.points[i + 1];
            if (edge.surface < first_link)
                addWithoutOpenings(edge, surfaces[edge.surface], a, b, kept);
            else if (!hasRailing(edge.surface - first_link, 0.5 * (a + b)) &&
                     !isInDoorway(edge, surfaces, 0.5 * (a + b)))
                kept.push_back({edge.surface, {a, b}, edge.low, edge.high});
        }
    return kept;
}

void joinLinks(const Layout& layout, std::size_t first_link, std::vector<Chart>& charts,
               Diagnostics& diagnostics) {
    for (std::size_t i = first_link; i < charts.size(); ++i) {
        if (!charts[i].is_link) continue;
        joinEnd(layout, i, false, charts, diagnostics);
        if (!charts[i].is_cabin) joinEnd(layout, i, true, charts, diagnostics);
        if (charts[i].is_cabin && charts[i].stop == 0)
            checkRoomInCabin(layout, layout.links[charts[i].index], diagnostics);
        tellOfWallsBefore(layout, charts[i], diagnostics);
    }
    checkLinksApart(charts, layout, diagnostics);
}

void tellOfWalls(const BuiltLinks& built, const Layout& layout, Diagnostics& diagnostics) {
    for (const WallInTheWay& wall : built.walls) {
        const Link& link = layout.links[wall.link];
        diagnostics.error(
            link.where,
            fmt::format("{} `{}` is in a wall of the terrain at [{:.2f}, {:.2f}, {:.2f}]",
                        link.isLift() ? "lift" : "link", link.id, wall.at.x, wall.at.y, wall.at.z),
            "move it, or leave room for it in the terrain");
    }
}

std::vector<PlacedRailing> railingsOf(const LinkGrounds& links, const BuiltLinks& built, const Layout& layout,
                                      std::size_t first_link) {
    std::vector<PlacedRailing> placed;
    for (std::size_t i = 0; i < links.parts().size(); ++i) {
        const BuiltLink& part = built.parts[links.parts()[i]];
        for (std::size_t count = 0; count < part.railings.size(); ++count) {
            const Railing& railing = part.railings[count];
            PlacedRailing one;
            one.chart = first_link + i;
            one.wall.id = fmt::format("railing:{}:{}", part.chart.name, count);
            one.wall.points = railing.points;
            one.wall.thickness = kRailing;
            one.wall.height = railingHeight(part.chart);
            one.wall.where = part.chart.is_link ? layout.links[part.chart.index].where
                                                : layout.levels[part.chart.index].where;
            one.wall.level = one.chart;
            one.ground = {railing.low, railing.high};
            placed.push_back(std::move(one));
        }
    }
    return placed;
}

}  // namespace throng::authoring
