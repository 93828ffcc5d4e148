// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/built_links.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "authoring/storeys/cabin.h"
#include "authoring/storeys/chart_mesh.h"
#include "authoring/storeys/mesh_cut.h"
#include "authoring/storeys/railings.h"

namespace throng::authoring {
namespace {

constexpr double kRailingHigh = 1.1;  // m
constexpr double kShaftHigh = 2.3;    // m, of a lift's sides at each of its stops
constexpr double kOverShaft = 3.0;    // m, over the highest floor
constexpr double kTreadOver = 0.2;    // m: treads are so far over the slope of their stairs at the most
constexpr double kSunk = 0.05;        // m: ground that a link lies in gives way to it
constexpr double kBelow = 1.0;        // m: what is nearer below a link is never taken for its ground
constexpr double kOverGround = 0.02;  // m: what is upright before an end is open from so high
constexpr double kFoot = 0.3;         // m: railings reach so far below the ground beside them

HalfSpace sideOf(glm::dvec2 normal, glm::dvec2 through) {
    return {{normal, 0.0}, glm::dot(normal, through)};
}

/// Between two heights over a slope.
std::vector<HalfSpace> between(const Footprint& link, double low, double high) {
    const double rise = (link.high - link.low) / link.length;
    // z - rise * along(x, y) - link.low, which is how far over the slope a place is
    const glm::dvec3 over(-rise * link.along, 1.0);
    const double foot = link.low - rise * glm::dot(link.begin, link.along);
    return {{-over, -(foot + low)}, {over, foot + high}};
}

std::vector<HalfSpace> sidesOf(const Footprint& link, double from, double to, double half_width) {
    const glm::dvec2 left(-link.along.y, link.along.x);
    return {sideOf(-link.along, link.at(from, 0.0)), sideOf(link.along, link.at(to, 0.0)),
            sideOf(left, link.at(0.0, half_width)), sideOf(-left, link.at(0.0, -half_width))};
}

/// Solids of one link, all of which its walls are looked for in.
class Room {
  public:
    explicit Room(double below) : below_(below) {}

    void addChart(const Chart& chart, const Layout& layout) {
        if (chart.is_cabin)
            addCabin(chart, layout.links[chart.index].lift, layout);
        else if (chart.is_link)
            addFlight(chart, layout.links[chart.index], layout);
    }

    void addLanding(const Chart& landing, std::size_t link) {
        UprightSolid solid;
        const std::vector<glm::dvec2>& floor = landing.floor;  // convex, counter-clockwise
        for (std::size_t i = 0; i < floor.size(); ++i) {
            const glm::dvec2 along = glm::normalize(floor[(i + 1) % floor.size()] - floor[i]);
            solid.sides.push_back(sideOf({along.y, -along.x}, floor[i]));
        }
        solid.ends = level(landing.height - below_, landing.height + kHeadroom);
        add(std::move(solid), link);
    }

    std::vector<UprightSolid> solids;
    std::vector<std::size_t> links;  // by solid

  private:
    static std::vector<HalfSpace> level(double low, double high) {
        return {{{0.0, 0.0, -1.0}, -low}, {{0.0, 0.0, 1.0}, high}};
    }

    void add(UprightSolid solid, std::size_t link) {
        solids.push_back(std::move(solid));
        links.push_back(link);
    }

    void addFlight(const Chart& chart, const Link& link, const Layout& layout) {
        const Footprint& flight = chart.link;
        add({sidesOf(flight, 0.0, flight.length, flight.half_width),
             between(flight, -below_, kHeadroom + kTreadOver)},
            chart.index);
        const double clear = flight.half_width - 0.5 * kRailing;
        if (!layout.levels[link.from].is_landing)
            openBefore(sidesOf(flight, -kThrough, 0.0, clear), flight.low, chart.index);
        if (!layout.levels[link.to].is_landing)
            openBefore(sidesOf(flight, flight.length, flight.length + kThrough, clear), flight.high,
                       chart.index);
    }

    /// Parapets give way, and steps do not.
    void openBefore(const std::vector<HalfSpace>& sides, double ground, std::size_t link) {
        add({sides, level(ground + kOverGround, ground + kMostStep), false}, link);
        add({sides, level(ground + kMostStep, ground + kHeadroom)}, link);
    }

    void addCabin(const Chart& chart, const Lift& lift, const Layout& layout) {
        const Footprint& cabin = chart.link;
        if (chart.stop == 0) {
            const double top = heightOfStop(layout, lift, lift.levels.size() - 1);
            add({sidesOf(cabin, 0.0, cabin.length, cabin.half_width),
                 level(cabin.low - below_, top + kOverShaft)},
                chart.index);
        }
        openBefore(sidesOf(cabin, -kThrough, 0.0, chart.half_door), cabin.low, chart.index);
    }

    double below_;
};

/// Beside the doors of a cabin its front is closed.
void closeFront(const Chart& cabin, std::vector<Railing>& railings) {
    constexpr double kHair = 1.0e-3;  // m
    std::erase_if(railings, [&](const Railing& railing) {
        return std::ranges::all_of(railing.points,
                                   [&](glm::dvec2 point) { return cabin.link.alongOf(point) < kHair; });
    });
    for (const double side : {-1.0, 1.0})
        railings.push_back(
            {{cabin.link.at(0.0, side * cabin.half_door), cabin.link.at(0.0, side * cabin.link.half_width)},
             cabin.link.low,
             cabin.link.high});
}

/// Where a flight meets the terrain, its end is open.
void openEnds(const Chart& flight, const Link& link, const Layout& layout, std::vector<Railing>& railings) {
    constexpr double kHair = 1.0e-3;  // m
    std::erase_if(railings, [&](const Railing& railing) {
        const auto all_at = [&](double forward) {
            return std::ranges::all_of(railing.points, [&](glm::dvec2 point) {
                return std::abs(flight.link.alongOf(point) - forward) < kHair;
            });
        };
        return (!layout.levels[link.from].is_landing && all_at(0.0)) ||
               (!layout.levels[link.to].is_landing && all_at(flight.link.length));
    });
}

void addSheets(const BuiltLink& part, TerrainMesh& mesh) {
    for (const Railing& railing : part.railings) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const glm::dvec2 a = railing.points.front(), b = railing.points.back();
        const double low_a = part.chart.heightAt(a), low_b = part.chart.heightAt(b),
                     high = railingHeight(part.chart);
        mesh.positions.insert(mesh.positions.end(),
                              {{a, low_a - kFoot}, {b, low_b - kFoot}, {b, low_b + high}, {a, low_a + high}});
        const glm::dvec2 along = glm::normalize(b - a);
        mesh.normals.insert(mesh.normals.end(), 4, glm::vec3(along.y, -along.x, 0.0));
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
            mesh.indices.push_back(first + corner);
    }
}

std::vector<BuiltLink> partsOf(const Layout& layout) {
    const std::vector<Chart> charts = chartsOf(layout);
    std::vector<BuiltLink> parts;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        if (i < layout.levels.size() && !layout.levels[i].is_landing) continue;
        BuiltLink part{charts[i], railingsOf(charts, i)};
        if (part.chart.is_cabin)
            closeFront(part.chart, part.railings);
        else if (part.chart.is_link)
            openEnds(part.chart, layout.links[part.chart.index], layout, part.railings);
        parts.push_back(std::move(part));
    }
    return parts;
}

Room roomOf(const std::vector<BuiltLink>& parts, const Layout& layout, double below) {
    Room room(below);
    for (const BuiltLink& part : parts)
        if (part.chart.is_link)
            room.addChart(part.chart, layout);
        else
            room.addLanding(part.chart, linkOfLanding(part.chart, layout));
    return room;
}

}  // namespace

BuiltLinks buildLinks(const TerrainMesh& terrain, const Layout& layout) {
    BuiltLinks built;
    built.parts = partsOf(layout);
    std::vector<Chart> charts;
    for (const BuiltLink& part : built.parts)
        charts.push_back(part.chart);
    const TerrainMesh links = homeMesh(charts, layout);
    const Room room = roomOf(built.parts, layout, kSunk);
    CutMesh seen = cutOut(terrain, room.solids, true);
    for (std::size_t solid = 0; solid < room.solids.size(); ++solid)
        if (seen.walls[solid]) built.walls.push_back({room.links[solid], *seen.walls[solid]});
    built.seen = std::move(seen.mesh);
    built.walked = cutOut(terrain, roomOf(built.parts, layout, kBelow).solids, false).mesh;
    for (TerrainMesh* mesh : {&built.seen, &built.walked})
        addMesh(*mesh, links);
    for (const BuiltLink& part : built.parts)
        addSheets(part, built.walked);
    return built;
}

double railingHeight(const Chart& chart) {
    return chart.is_cabin ? kShaftHigh : kRailingHigh;
}

}  // namespace throng::authoring
