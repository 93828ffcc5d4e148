// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/terrain_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "authoring/link_kinds.h"
#include "authoring/scene/lane_grounds.h"
#include "authoring/scene/link_ends.h"
#include "authoring/scene/link_grounds.h"
#include "authoring/scene/rebase.h"
#include "authoring/scene/terrain_places.h"
#include "authoring/storeys/given_ways.h"
#include "authoring/storeys/plane.h"
#include "authoring/storeys/surface_edges.h"
#include "base/polygon.h"

namespace throng::authoring {
namespace {

constexpr double kAround = 50.0;                  // m: so far from all that the layout has, ground counts
constexpr double kMostLatticeCells = 4.0e6;       // of the lattice
constexpr double kMostPlaneCells = 2.0e7;         // of the plane
constexpr double kMostFaces = 2.0e9;              // to look at
constexpr double kStoreysApart = 2.0;             // m
constexpr double kMostLooks = 400'000.0;          // at the mesh, for storeys
constexpr double kMostFacesOfAQuickLook = 2.0e8;  // a second: 500 above each other at every look
constexpr double kEdgeHeight = 1.1;               // m: people see over the ends of ground
constexpr double kEdge = 0.02;                    // m
constexpr double kUnreachedWorthTelling = 4.0;    // m^2 of ground that nobody gets to
constexpr std::size_t kMostTold = 10;
constexpr double kAlong = 0.25;  // m between looks at what a line lies on

using Bounds = std::pair<glm::dvec2, glm::dvec2>;

double areaOfSpots(std::size_t count) {
    return static_cast<double>(count) * kChartCell * kChartCell;
}

/// Of the mesh, as far as the layout could have to do with it.
Bounds boundsOf(const Layout& layout, const Rebase& rebase, const TerrainMesh& mesh) {
    glm::dvec2 lower(std::numeric_limits<double>::max()), upper = -lower;
    for (const glm::dvec3& point : mesh.positions) {
        lower = glm::min(lower, glm::dvec2(point));
        upper = glm::max(upper, glm::dvec2(point));
    }
    glm::dvec2 least = rebase.origin() + glm::dvec2(rebase.minimum()),
               most = rebase.origin() + glm::dvec2(rebase.maximum());
    const auto include = [&](glm::dvec2 at) {
        least = glm::min(least, at);
        most = glm::max(most, at);
    };
    for (const Level& level : layout.levels)
        include(glm::dvec2(level.at.value_or(glm::dvec3(least, 0.0))));
    for (const Link& link : layout.links) {
        include(link.isLift() ? link.lift.at : link.begin);
        include(link.isLift() ? link.lift.at : link.end);
    }
    return {glm::max(lower, least - kAround), glm::min(upper, most + kAround)};
}

/// A quick look, for the many terrains that have one storey.
bool mayHaveStoreys(const TerrainMesh& mesh, const Bounds& bounds) {
    const auto [lower, upper] = bounds;
    const glm::dvec2 size = upper - lower;
    const double step = std::max(0.5, std::sqrt(size.x * size.y / kMostLooks));
    const FaceGrid faces(mesh, lower, glm::vec2(0.0f), glm::vec2(size), FaceGrid::Keep::looking_up);
    if (faces.layers() * size.x * size.y > kMostFacesOfAQuickLook * step * step) return false;
    const glm::ivec2 looks(glm::ceil(size / step - 0.5));
    for (int y = 0; y < looks.y; ++y)
        for (int x = 0; x < looks.x; ++x) {
            float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
            faces.visitHits(glm::vec2(step * (glm::dvec2(x, y) + 0.5)),
                            [&](const TerrainTriangle&, float height) {
                                low = std::min(low, height);
                                high = std::max(high, height);
                            });
            if (double{high} - double{low} > kStoreysApart) return true;
        }
    return false;
}

/// A part of a line that lies on one chart.
struct Stretch {
    std::size_t chart;
    std::vector<glm::dvec2> points;
    double low, high;  // m, of the ground along it
};

class TerrainLayingOut {
  public:
    /// @param built the layout's links, of which the mesh has the faces already
    TerrainLayingOut(const Layout& layout, const TerrainMesh& mesh, const BuiltLinks& built, Bounds bounds,
                     Diagnostics& diagnostics)
        : layout_(layout),
          built_(built),
          diagnostics_(diagnostics),
          ground_(std::make_shared<const Walkable>(mesh, bounds.first, bounds.second)),
          pieces_(piecesOf(*ground_)),
          places_(layout, *ground_, pieces_) {}

    std::shared_ptr<const Charts> run() {
        if (!places_.findLevels(diagnostics_)) return nullptr;
        const std::vector<bool> used = usedPieces();
        if (layout_.levels.empty() && !lieAboveEachOther(*ground_, pieces_, used)) return nullptr;
        const LinkGrounds links(ground_, built_);
        std::vector<Surface> surfaces =
            cutIntoSurfaces(ground_, pieces_, used, reachOf(layout_), links.taken());
        if (surfaces.empty()) return nullptr;
        surfaces.insert(surfaces.end(), links.surfaces().begin(), links.surfaces().end());
        if (surfaces.size() >= kMostCharts) {
            diagnostics_.error(
                layout_.terrain->where,
                fmt::format("the terrain is {} grounds above each other, more than the {} that "
                            "can be",
                            surfaces.size(), kMostCharts - 1),
                "export the ground alone (`node`), or name the `surface` that people walk on");
            return nullptr;
        }
        places_.keepTo(surfaces);
        const std::size_t first_link = surfaces.size() - links.surfaces().size();
        for (std::size_t i = 0; i < first_link; ++i)
            addChart(surfaces[i]);
        links.addCharts(result_->charts);
        result_->reach = reachOf(layout_);
        joinLinks(layout_, first_link, result_->charts, diagnostics_);
        if (diagnostics_.hasErrors()) return nullptr;
        nameGrounds(used);
        Layout placed = layout_;
        layLanes(placed, places_, result_->charts, diagnostics_);
        if (!diagnostics_.hasErrors())
            for (Zebra& crossing : placed.traffic.crossings)
                keepToGround(crossing.polygon, crossing.level);
        if (diagnostics_.hasErrors()) return nullptr;
        layInPlane(*result_);
        grounds_->home = layout_;
        placeAll(placed);
        checkLanes(placed, *result_, diagnostics_);
        if (diagnostics_.hasErrors()) return nullptr;
        standWalls(placed, links.sorted(edgesOf(surfaces), surfaces));
        standRailings(links, first_link);
        copyWallsIntoMargins(*result_, standing_);
        result_->grounds = grounds_;
        return result_;
    }

    /// The terrain with its links, once it is cut.
    void keepMeshes(BuiltLinks& built) const {
        grounds_->seen = std::make_shared<const TerrainMesh>(std::move(built.seen));
        grounds_->walked = std::make_shared<const TerrainMesh>(std::move(built.walked));
    }

  private:
    std::vector<bool> usedPieces() const {
        std::vector<bool> used(pieces_.spots.size(), false);
        const auto use = [&](std::uint32_t spot) {
            if (spot != kNoSpot) used[pieces_.piece_of[spot]] = true;
        };
        for (const std::uint32_t spot : places_.levelSpots())
            use(spot);
        for (const Area& area : layout_.areas)
            use(places_.spotIn(area.polygon, area.level));
        for (const Road& road : layout_.roads)
            for (const glm::dvec2 point : road.centreline)
                use(places_.spotAt(point, road.level));
        for (const Lane& lane : layout_.traffic.lanes)
            for (const glm::dvec2 point : lane.points)
                use(places_.spotAt(point, lane.level));
        for (const Zebra& crossing : layout_.traffic.crossings)
            use(places_.spotIn(crossing.polygon, crossing.level));
        for (const Formation& formation : layout_.formations)
            for (const glm::dvec2 place : formationPlaces(formation, layout_.simulation.seed).positions)
                use(places_.spotAt(place, formation.level));
        for (const GivenPeople& given : layout_.given)
            for (const std::vector<GivenPoint>& way : given.ways)
                use(way.front().height
                        ? ground_->nearestSpot(chartCellOf(way.front().place), *way.front().height)
                        : places_.spotAt(way.front().place, given.level));
        return used;
    }

    void addChart(const Surface& surface) {
        Chart chart;
        chart.index = result_->charts.size();
        chart.surface = std::make_shared<const Surface>(surface);
        chart.name = fmt::format("surface-{}", chart.index + 1);
        result_->charts.push_back(std::move(chart));
    }

    void nameGrounds(const std::vector<bool>& used) {
        for (std::size_t level = layout_.levels.size(); level-- > 0;)
            if (!layout_.levels[level].is_landing)
                result_->charts[chartOf(places_.levelSpots()[level])].name = layout_.levels[level].id;
        if (layout_.levels.empty())
            for (const Chart& chart : result_->charts)
                grounds_->levels.push_back({chart.name,
                                            meanHeightOf(*chart.surface),
                                            outlineOf(*chart.surface),
                                            layout_.terrain->where,
                                            {}});
        for (std::size_t level = 0; level < layout_.levels.size(); ++level) {
            grounds_->levels.push_back(layout_.levels[level]);
            if (layout_.levels[level].is_landing) continue;
            grounds_->levels.back().height = ground_->spots()[places_.levelSpots()[level]].height;
            grounds_->levels.back().floor =
                outlineOf(*result_->charts[chartOf(places_.levelSpots()[level])].surface);
        }
        tellUnreached(used);
    }

    void tellUnreached(const std::vector<bool>& used) {
        TerrainFindings& findings = grounds_->findings;
        std::vector<bool> seen(pieces_.spots.size(), false);
        for (std::uint32_t spot = 0; spot < ground_->spots().size(); ++spot) {
            const std::uint32_t piece = pieces_.piece_of[spot];
            const double area = areaOfSpots(pieces_.spots[piece]);
            if (used[piece] || seen[piece] || area < kUnreachedWorthTelling) continue;
            seen[piece] = true;
            const Walkable::Spot& there = ground_->spots()[spot];
            findings.unreached.push_back({area, {chartCellMiddle(there.cell), there.height}});
        }
        findings.unreached_count = findings.unreached.size();
        std::stable_sort(findings.unreached.begin(), findings.unreached.end(),
                         [](const auto& a, const auto& b) { return a.area > b.area; });
        if (findings.unreached.size() > kMostTold) findings.unreached.resize(kMostTold);
    }

    std::size_t chartOf(std::uint32_t spot) const { return places_.chartOf()[spot]; }

    double meanHeightOf(const Surface& surface) const {
        double sum = 0.0, count = 0.0;
        for (const std::uint32_t spot : surface.spots)
            if (spot != kNoSpot) {
                sum += ground_->spots()[spot].height;
                count += 1.0;
            }
        return sum / count;
    }

    /// What of an outline lies beyond its ground would lie on other grounds in the plane.
    void keepToGround(std::vector<glm::dvec2>& outline, std::size_t chart) const {
        constexpr double kBeyond = 0.5;  // m: less than there is between charts
        const auto [lower, upper] = result_->charts[chart].bounds();
        for (const int axis : {0, 1})
            for (const bool is_upper : {false, true}) {
                const double edge = is_upper ? upper[axis] + kBeyond : lower[axis] - kBeyond;
                outline = clipped(outline, axis, edge, is_upper);
            }
    }

    /// The part of an outline on one side of a line across an axis (Sutherland and Hodgman 1974).
    static std::vector<glm::dvec2> clipped(const std::vector<glm::dvec2>& outline, int axis, double edge,
                                           bool is_upper) {
        const auto within = [&](glm::dvec2 point) {
            return is_upper ? point[axis] <= edge : point[axis] >= edge;
        };
        std::vector<glm::dvec2> found;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const glm::dvec2 from = outline[i], to = outline[(i + 1) % outline.size()];
            if (within(from)) found.push_back(from);
            if (within(from) == within(to)) continue;
            glm::dvec2 crossing = glm::mix(from, to, (edge - from[axis]) / (to[axis] - from[axis]));
            crossing[axis] = edge;
            found.push_back(crossing);
        }
        return found;
    }

    /// Sets an object's level to its chart, and where the layout names none, at home as well.
    template <class Thing>
    void setChart(Thing& thing, Thing& home, std::uint32_t spot) const {
        thing.level = chartOf(spot);
        if (layout_.levels.empty()) home.level = thing.level;
    }

    void complain(const SourcePosition& where, const std::string& what, glm::dvec2 at) {
        diagnostics_.error(
            where, fmt::format("{}: there is no ground of the terrain at ({:.2f}, {:.2f})", what, at.x, at.y),
            "people need 2 m over their heads, and less than 45 degrees; move the one or the other");
    }

    void placeAll(Layout& placed) {
        Layout& home = grounds_->home;
        for (std::size_t i = 0; i < placed.areas.size(); ++i)
            placeArea(placed.areas[i], home.areas[i]);
        for (std::size_t i = 0; i < placed.patches.size(); ++i) {
            const std::uint32_t spot = places_.spotIn(placed.patches[i].polygon, placed.patches[i].level);
            if (spot == kNoSpot)
                complain(placed.patches[i].where, fmt::format("patch `{}`", placed.patches[i].id),
                         placed.patches[i].polygon.front());
            else {
                setChart(placed.patches[i], home.patches[i], spot);
                keepToGround(placed.patches[i].polygon, placed.patches[i].level);
            }
        }
        for (std::size_t i = 0; i < placed.formations.size(); ++i)
            placeFormation(placed.formations[i], home.formations[i]);
        for (const Attraction& attraction : layout_.attractions) {
            const std::uint32_t spot = places_.spotAt(attraction.at, attraction.level);
            // Where nobody can stand, it is as high as its ground elsewhere.
            grounds_->attraction_heights.push_back(spot == kNoSpot ? grounds_->levels[attraction.level].height
                                                                   : heightOf(spot));
        }
        placeRoads(placed);
        placeGiven();
    }

    /// Where they begin; from there on they go where the ground leads.
    void placeGiven() {
        const auto begins = [&](const GivenPeople& given, glm::dvec2 place) {
            const std::uint32_t spot = places_.spotAt(place, given.level);
            return spot == kNoSpot ? std::optional<std::uint32_t>()
                                   : static_cast<std::uint32_t>(chartOf(spot));
        };
        result_->given = chartsOfWays(layout_, *result_, begins, diagnostics_);
    }

    void placeArea(Area& area, Area& home) {
        const std::uint32_t spot = places_.spotIn(area.polygon, area.level);
        if (spot == kNoSpot) {
            complain(area.where, fmt::format("area `{}`", area.id), area.polygon.front());
            return;
        }
        setChart(area, home, spot);
        const Surface& surface = *result_->charts[area.level].surface;
        std::size_t within = 0, on_others = 0;
        const auto [lowest, highest] = cellsRound(area.polygon);
        for (const Chart& chart : result_->charts) {
            const glm::ivec2 from = glm::max(lowest, chart.surface->first);
            const glm::ivec2 to = glm::min(highest, chart.surface->first + chart.surface->size - 1);
            for (glm::ivec2 cell(0, from.y); cell.y <= to.y; ++cell.y)
                for (cell.x = from.x; cell.x <= to.x; ++cell.x) {
                    if (chart.surface->spotAt(cell) == kNoSpot ||
                        !isWithin(area.polygon, chartCellMiddle(cell)))
                        continue;
                    within += chart.surface.get() == &surface ? 1 : 0;
                    on_others += chart.surface.get() != &surface && surface.spotAt(cell) == kNoSpot ? 1 : 0;
                }
        }
        if (on_others > within)
            diagnostics_.warning(
                area.where,
                fmt::format(
                    "area `{}` lies for the most part beyond its ground, `{}`: {:.1f} of {:.1f} m^2 are "
                    "on it",
                    area.id, result_->charts[area.level].name, areaOfSpots(within),
                    areaOfSpots(within + on_others)),
                "people come and go on that part of it alone");
        keepToGround(area.polygon, area.level);
    }

    /// Everybody on one chart, or where it shows the next.
    void placeFormation(Formation& formation, Formation& home) {
        const FormationPlaces places = formationPlaces(formation, layout_.simulation.seed);
        if (places.positions.empty()) return;
        const auto* list = std::get_if<ListFormation>(&formation.shape);
        const std::uint32_t first = places_.spotAt(places.positions.front(), formation.level);
        if (first == kNoSpot) {
            complain(formation.where, fmt::format("formation `{}`: person 0", formation.id),
                     places.positions.front());
            return;
        }
        setChart(formation, home, first);
        const ChartRaster& raster = result_->rasters[formation.level];
        for (const auto& [points, what] : {std::pair{&places.positions, "person {} stands"},
                                           {&places.goals, "the goal of person {} lies"}})
            for (std::size_t i = 0; i < points->size(); ++i) {
                if (raster.ownerOf((*points)[i]) != gpu::NO_CHART) continue;
                diagnostics_.error(
                    list ? list->agents[i].where : formation.where,
                    fmt::format("formation `{}`: {} off the ground of person 0, `{}`, at ({:.2f}, {:.2f})",
                                formation.id, fmt::format(fmt::runtime(what), i),
                                result_->charts[formation.level].name, (*points)[i].x, (*points)[i].y),
                    "write a formation for each ground, and areas as goals on another one");
                return;
            }
    }

    double heightOf(std::uint32_t spot) const { return ground_->spots()[spot].height; }

    /// A line, cut where it goes on on another chart. Where there is no ground, it goes on as before.
    std::vector<Stretch> stretchesOf(const std::vector<glm::dvec2>& line, std::size_t level) const {
        std::vector<Stretch> stretches;
        const auto add = [&](glm::dvec2 point, bool is_corner) {
            const std::uint32_t spot = places_.spotAt(point, level);
            if (spot == kNoSpot && stretches.empty()) return;
            const std::size_t chart = spot == kNoSpot ? stretches.back().chart : chartOf(spot);
            const double height = spot == kNoSpot ? stretches.back().low : heightOf(spot);
            if (stretches.empty() || stretches.back().chart != chart) {
                if (!stretches.empty()) stretches.back().points.push_back(point);
                stretches.push_back({chart, {point}, height, height});
            } else if (is_corner) {
                stretches.back().points.push_back(point);
            }
            stretches.back().low = std::min(stretches.back().low, height);
            stretches.back().high = std::max(stretches.back().high, height);
        };
        add(line.front(), true);
        for (std::size_t i = 1; i < line.size(); ++i) {
            const int looks =
                std::max(1, static_cast<int>(std::ceil(glm::distance(line[i - 1], line[i]) / kAlong)));
            for (int look = 1; look <= looks; ++look)
                add(glm::mix(line[i - 1], line[i], static_cast<double>(look) / looks), look == looks);
        }
        if (!stretches.empty() && stretches.front().points.front() != line.front())
            stretches.front().points.insert(stretches.front().points.begin(), line.front());
        std::erase_if(stretches, [](const Stretch& stretch) { return stretch.points.size() < 2; });
        return stretches;
    }

    /// A road that leads from one chart to another is one on each.
    void placeRoads(Layout& placed) {
        std::vector<std::size_t> ends(placed.roads.size());
        for (std::size_t i = 0; i < layout_.roads.size(); ++i) {
            ends[i] = i;
            const std::vector<Stretch> stretches =
                stretchesOf(layout_.roads[i].centreline, layout_.roads[i].level);
            if (stretches.empty()) {
                complain(layout_.roads[i].where, fmt::format("road `{}`", layout_.roads[i].id),
                         layout_.roads[i].centreline.front());
                continue;
            }
            if (layout_.levels.empty()) grounds_->home.roads[i].level = stretches.front().chart;
            for (std::size_t part = 0; part < stretches.size(); ++part) {
                if (part > 0) {
                    ends[i] = placed.roads.size();
                    placed.roads.push_back(placed.roads[i]);
                }
                placed.roads[ends[i]].level = stretches[part].chart;
                placed.roads[ends[i]].centreline = stretches[part].points;
            }
        }
        visitPlaces(placed, [&](Place& place) {
            if (place.kind == Place::Kind::road_end && place.index < ends.size())
                place.index = ends[place.index];
        });
    }

    /// The layout's walls on their grounds, and where these end.
    void standWalls(Layout& placed, const std::vector<SurfaceEdge>& edges) {
        std::vector<Wall> plane;
        for (const Wall& wall : layout_.walls)
            standWall(wall, plane);
        for (auto& [part, ground] : further_) {
            addWall(part.level, part, ground);
            plane.push_back(std::move(part));
        }
        placed.walls = std::move(plane);
        std::size_t count = 0;
        result_->plane = moved(placed, result_->charts, result_->given);
        for (const SurfaceEdge& edge : edges) {
            Wall wall;
            const bool is_opening = edge.beside == SurfaceEdge::Beside::opening;
            wall.id = fmt::format("{}:{}:{}", is_opening ? "railing" : "edge",
                                  result_->charts[edge.surface].name, count++);
            wall.points = edge.points;
            wall.thickness = edge.beside == SurfaceEdge::Beside::nothing ? kEdge : kRailing;
            wall.height = kEdgeHeight;
            wall.where = layout_.terrain->where;
            wall.is_edge = !is_opening;
            addWall(edge.surface, wall, {edge.low, edge.high});
            movePoints(wall.points, result_->charts[edge.surface].shift);
            result_->plane.walls.push_back(std::move(wall));
        }
    }

    void standRailings(const LinkGrounds& links, std::size_t first_link) {
        for (const PlacedRailing& railing : railingsOf(links, built_, layout_, first_link)) {
            addWall(railing.chart, railing.wall, railing.ground);
            result_->plane.walls.push_back(railing.wall);
            movePoints(result_->plane.walls.back().points, result_->charts[railing.chart].shift);
        }
    }

    void addWall(std::size_t chart, Wall wall, glm::dvec2 ground) {
        wall.level = chart;
        standing_.push_back({result_->walls.size(), chart});
        result_->walls.push_back(std::move(wall));
        result_->ground_along_walls.push_back(ground);
    }

    /// Walls keep their number, as gates do: what goes on on another chart is a wall of its own behind them.
    void standWall(const Wall& wall, std::vector<Wall>& plane) {
        std::vector<glm::dvec2> line = wall.points;
        if (wall.closed) line.push_back(line.front());
        std::vector<Stretch> stretches = stretchesOf(line, wall.level);
        if (stretches.empty()) {
            diagnostics_.warning(wall.where, fmt::format("wall `{}` does not stand on the terrain", wall.id));
            stretches.push_back({0, line, 0.0, 0.0});
        }
        for (std::size_t i = 0; i < stretches.size(); ++i) {
            Wall part = wall;
            part.level = stretches[i].chart;
            if (stretches.size() > 1) {
                part.closed = false;
                part.points = stretches[i].points;
            }
            if (i > 0) {
                part.id = fmt::format("{}:{}", wall.id, i + 1);
                further_.push_back({part, {stretches[i].low, stretches[i].high}});
                continue;
            }
            addWall(part.level, part, {stretches[i].low, stretches[i].high});
            plane.push_back(std::move(part));
        }
    }

    const Layout& layout_;
    const BuiltLinks& built_;
    Diagnostics& diagnostics_;
    std::shared_ptr<const Walkable> ground_;
    Pieces pieces_;
    TerrainPlaces places_;
    std::shared_ptr<Charts> result_ = std::make_shared<Charts>();
    std::shared_ptr<TerrainGrounds> grounds_ = std::make_shared<TerrainGrounds>();
    std::vector<StandingWall> standing_;
    std::vector<std::pair<Wall, glm::dvec2>> further_;
};

/// With links, the ground is looked at twice: for where these begin and end, and with them.
std::shared_ptr<const Charts> layOutWithLinks(const Layout& layout, const TerrainMesh& mesh,
                                              const Bounds& bounds, Diagnostics& diagnostics) {
    const Walkable ground(mesh, bounds.first, bounds.second);
    const Pieces pieces = piecesOf(ground);
    TerrainPlaces places(layout, ground, pieces);
    if (!places.findLevels(diagnostics)) return nullptr;
    const std::optional<Layout> raised = withLinkEnds(layout, ground, places, diagnostics);
    if (!raised) return nullptr;
    BuiltLinks built = buildLinks(mesh, *raised);
    tellOfWalls(built, *raised, diagnostics);
    if (diagnostics.hasErrors()) return nullptr;
    TerrainLayingOut laying_out(*raised, built.walked, built, bounds, diagnostics);
    std::shared_ptr<const Charts> charts = laying_out.run();
    if (charts) laying_out.keepMeshes(built);
    return charts;
}

}  // namespace

std::shared_ptr<const Charts> layOutTerrain(const Layout& layout, const TerrainMesh& mesh,
                                            Diagnostics& diagnostics) {
    if (layout.terrain->is_single) return nullptr;
    const Rebase rebase(layout);
    const Bounds bounds = boundsOf(layout, rebase, mesh);
    const glm::dvec2 size = bounds.second - bounds.first;
    const bool has_names = !layout.levels.empty();
    if (!(size.x > 0.0 && size.y > 0.0)) {
        if (has_names)
            diagnostics.error(layout.terrain->file_where, "no face of the terrain lies where this layout is",
                              "set its `offset` or `scale`");
        return nullptr;
    }
    if (!has_names && !mayHaveStoreys(mesh, bounds)) return nullptr;
    constexpr double kLooksPerCell = 10.0;
    const double cells = size.x * size.y / (kChartCell * kChartCell);
    // The plane of charts has cells wherever the layout is.
    const glm::dvec2 whole = rebase.maximum() - rebase.minimum();
    const bool is_too_wide = whole.x * whole.y / (kChartCell * kChartCell) > kMostPlaneCells;
    const auto has_too_many_faces = [&] {
        const FaceGrid faces(mesh, bounds.first, glm::vec2(0.0f), glm::vec2(size), FaceGrid::Keep::all);
        return cells * kLooksPerCell * faces.layers() > kMostFaces;
    };
    if (is_too_wide || cells > kMostLatticeCells || has_too_many_faces()) {
        const std::string what =
            is_too_wide
                ? fmt::format(
                      "a layout of {:.0f} x {:.0f} m is too much to find ways over and under each other",
                      whole.x, whole.y)
                : fmt::format(
                      "{:.0f} x {:.0f} m of terrain are too much to find people's ways over and under it",
                      size.x, size.y);
        if (has_names)
            diagnostics.error(layout.terrain->file_where, what,
                              "export a part of it, or leave out the levels");
        else
            diagnostics.warning(
                layout.terrain->file_where, what,
                "people walk on one of its faces above each other, see `surface`; or export a "
                "part of it");
        return nullptr;
    }
    try {
        if (!layout.links.empty()) return layOutWithLinks(layout, mesh, bounds, diagnostics);
        return TerrainLayingOut(layout, mesh, {}, bounds, diagnostics).run();
    } catch (const std::invalid_argument& error) {
        diagnostics.error(layout.terrain->file_where,
                          fmt::format("the terrain cannot be used: {}", error.what()),
                          "name the `surface` that people walk on, or export the ground alone");
        return nullptr;
    }
}

}  // namespace throng::authoring
