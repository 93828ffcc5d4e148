// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/scene_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <stdexcept>

#include "authoring/layout/layout_reader.h"
#include "authoring/layout/patch_sizes.h"
#include "authoring/scene/audience.h"
#include "authoring/scene/behaviours.h"
#include "authoring/scene/boarding.h"
#include "authoring/scene/chart_map.h"
#include "authoring/scene/draw_people.h"
#include "authoring/scene/given.h"
#include "authoring/scene/itineraries.h"
#include "authoring/scene/narrow_places.h"
#include "authoring/scene/patches.h"
#include "authoring/scene/place_formations.h"
#include "authoring/scene/raster.h"
#include "authoring/scene/rebase.h"
#include "authoring/scene/route_flow.h"
#include "authoring/scene/routes.h"
#include "authoring/scene/seat_feet.h"
#include "authoring/scene/seat_ground.h"
#include "authoring/scene/seat_ways.h"
#include "authoring/scene/slope_costs.h"
#include "authoring/scene/terrain_charts.h"
#include "authoring/scene/terrain_check.h"
#include "authoring/scene/traffic.h"
#include "authoring/scene/walls.h"
#include "authoring/scene/ways_check.h"
#include "authoring/storeys/charts.h"
#include "base/side_by_side.h"

namespace throng::authoring {
namespace {

class SceneAssembly {
  public:
    SceneAssembly(const Layout& layout, Diagnostics& diagnostics, GroundCache& cache,
                  const TerrainMesh* terrain, DistanceSolver* solver, std::shared_ptr<const Charts> charts)
        : layout_(layout),
          diagnostics_(diagnostics),
          cache_(cache),
          terrain_mesh_(terrain),
          solver_(solver),
          rebase_(layout) {
        scene_.settings = layout.simulation;
        scene_.origin = rebase_.origin();
        scene_.output_origin = rebase_.outputOrigin();
        scene_.minimum = rebase_.minimum();
        scene_.maximum = rebase_.maximum();
        if (charts) mapCharts(std::move(charts));
    }

    std::optional<Scene> build() {
        if (!isOfSensibleSize()) return std::nullopt;
        thinnest_ = drawEverybody(layout_, rebase_, scene_);
        buildGeometry();
        if (diagnostics_.hasErrors()) return std::nullopt;
        scene_.traffic = buildTraffic(layout_, rebase_, diagnostics_);
        if (diagnostics_.hasErrors()) return std::nullopt;
        addCalls(layout_, scene_.queues, scene_.traffic);
        buildTerrain();
        if (terrain_mesh_ && layout_.terrain && !scene_.terrain) return std::nullopt;
        Routes routes = planRoutes();
        Itineraries itineraries(layout_, rebase_, geometry_, routes, diagnostics_, scene_);
        std::future<CloseStarts> close = std::async(kInAThread, [this] {
            return closeStarts(scene_, geometry_, layout_.flows.size(), layout_.formations.size());
        });
        itineraries.prepare();
        routes.solvePlanned();
        BehaviourTables behaviours(layout_, rebase_, geometry_, routes, itineraries, diagnostics_, scene_);
        const Placing with{layout_,     rebase_,    geometry_,    routes,
                           itineraries, behaviours, diagnostics_, scene_};
        for (std::size_t i = 0; i < layout_.flows.size(); ++i)
            routeFlow(with, layout_.flows[i], i);
        placeFormations(with, closed_gates_, close.get());
        for (std::size_t group = 0; group < scene_.groups.size(); ++group)
            if (scene_.groups[group].block) seatAudience(group, behaviours);
        buildSeats(layout_, rebase_, scene_, diagnostics_);
        addWays(layout_, rebase_, scene_);
        tellOfFastWays(layout_, diagnostics_);
        numberTickets();
        if (routes.tooManyFields())
            diagnostics_.error({},
                               "there are too many different goals behind walls: their distance fields need "
                               "more than 1 GiB",
                               "give people areas as goals instead of single points");
        const bool valid = !diagnostics_.hasErrors();
        if (valid) checkWays(layout_, rebase_, geometry_, routes, scene_, diagnostics_);
        if (valid) finish(routes);
        ground_->solveWith(nullptr);  // ground may be kept for longer than its solver lives
        return valid ? std::optional(std::move(scene_)) : std::nullopt;
    }

  private:
    /// The plane begins where a cell of every grid does.
    void mapCharts(std::shared_ptr<const Charts> charts) {
        const auto step = gpu::SHIFT_STEP;
        scene_.minimum = glm::floor((scene_.minimum - static_cast<float>(charts->reach)) / step) * step;
        scene_.maximum = glm::ceil((scene_.maximum + static_cast<float>(charts->reach)) / step) * step;
        scene_.chart_map = makeChartMap(*charts, scene_.minimum, scene_.maximum, scene_.origin);
        if (charts->grounds) standOnTerrain(*charts);
        geometry_.charts = std::make_shared<const ChartMap>(scene_.chart_map);
        scene_.charts = std::move(charts);
    }

    void standOnTerrain(const Charts& charts) {
        PlaneGround ground = planeGroundOf(charts, scene_.chart_map, scene_.origin);
        try {
            const TerrainMesh& mesh = charts.grounds->walked ? *charts.grounds->walked : *terrain_mesh_;
            scene_.terrain = std::make_shared<const Terrain>(mesh, std::move(ground), scene_.origin,
                                                             scene_.minimum, scene_.maximum);
            scene_.chart_map.cell_costs =
                slopeCosts(*scene_.terrain, scene_.chart_map, layout_.simulation.motion);
        } catch (const std::invalid_argument& error) {
            diagnostics_.error(layout_.terrain->file_where,
                               fmt::format("the terrain cannot be used: {}", error.what()));
        }
    }

    /// Floats keep a centimetre up to here, and everything has as many parts as it is long.
    bool isOfSensibleSize() {
        const double most = layoutRules().rule().remark("x-most-extent").number;
        if (rebase_.extent() <= most) return true;
        diagnostics_.error(rebase_.outermost(),
                           fmt::format("with this, the layout is {:.6g} m long or wide: it can be {:.6g}",
                                       rebase_.extent(), most),
                           "look for a slip in the coordinates");
        return false;
    }

    /// How fine the ground is depends on how many fields there will be, and how many points share a field on
    /// the ground.
    Routes planRoutes() {
        const std::vector<Routes::PointGoal> goals = pointGoals(layout_, rebase_, geometry_, scene_);
        std::size_t fields = 1;
        for (;;) {
            ground_ = cache_.groundFor(geometry_, resolutionFor(geometry_, fields));
            Routes routes(layout_, rebase_, *ground_);
            const std::size_t needed =
                std::max<std::size_t>(1, routes.plan(goals) + Itineraries::destinationCount(layout_));
            if (fields > 1 || resolutionFor(geometry_, needed) == resolutionFor(geometry_, 1)) {
                ground_->solveWith(scene_.charts ? nullptr : solver_);
                scene_.grid = ground_->grid();
                return routes;
            }
            fields = needed;
        }
    }

    /// Below 0.7 pixels per body radius, people who stand together hide each other from the rays.
    void checkResolution() {
        constexpr double kFewest = 0.7;
        const SimulationSettings& settings = layout_.simulation;
        const double pixels = settings.pixels_per_metre * scene_.smallest_radius;
        if (settings.pixels_per_metre <= 0.0 || pixels >= kFewest || scene_.people.empty()) return;
        diagnostics_.warning(settings.pixels_per_metre_where,
                             fmt::format("the smallest body ({:.2f} m) gets {:.2f} pixels a radius: in "
                                         "crowds, people will not see all "
                                         "of their neighbours",
                                         scene_.smallest_radius, pixels),
                             fmt::format("set simulation.pixels_per_metre to {:.3g} or more, or leave it out",
                                         std::ceil(10.0 * kFewest / scene_.smallest_radius) / 10.0));
    }

    void buildGeometry() {
        if (scene_.people.empty()) scene_.smallest_radius = scene_.largest_radius = thinnest_ = 0.25f;
        const SizeBounds sizes = sizeBounds(layout_.patches);
        scene_.smallest_radius *= sizes.least;
        scene_.largest_radius *= sizes.most;
        checkResolution();
        geometry_.minimum = scene_.minimum;
        geometry_.maximum = scene_.maximum;
        // In whole centimetres, so that the ground is the same whoever is drawn to walk on it.
        constexpr float kHair = 0.01f;  // cm: sizes that are whole centimetres stay what they are
        geometry_.smallest_radius = std::floor(100.0f * thinnest_ + kHair) / 100.0f;
        geometry_.largest_radius = std::ceil(100.0f * scene_.largest_radius - kHair) / 100.0f;
        buildWalls(layout_, rebase_, geometry_);
        for (const Road& road : layout_.roads)
            geometry_.roads.push_back(
                {rebase_.local(road.centreline), static_cast<float>(road.width), road.one_way});
        for (const Area& area : layout_.areas)
            geometry_.areas.push_back(rebase_.local(area.polygon));
        for (const SeatBlock& block : layout_.seats)
            for (std::size_t aisle = 0; block.isOpen() && aisle < countAisles(block); ++aisle)
                geometry_.areas.push_back(rebase_.local(footOf(block, aisle)));
        for (const Zebra& crossing : layout_.traffic.crossings)
            geometry_.areas.push_back(rebase_.local(crossing.polygon));
        geometry_.costly = costlyGround(layout_, rebase_);
        geometry_.has_crossings = keepsOffStreets(layout_);
        scene_.wall_segments = geometry_.walls;
        if (layout_.simulation.walls_hide)
            for (std::uint32_t i = 0; i < geometry_.walls.size(); ++i)
                if (layout_.walls[geometry_.walls[i].wall].height >= kSeenOver)
                    scene_.hiding_walls.push_back(i);
        openGates();
        sortWalls(geometry_);
        if (!hasRoomForTiles()) return;
        scene_.wall_tiles =
            wallTiles(geometry_.walls, scene_.smallest_radius,
                      static_cast<float>(layout_.simulation.tile_radius), scene_.charts != nullptr);
    }

    bool hasRoomForTiles() {
        constexpr double kMost = 1.0e6;
        double needed = 0.0;
        for (const gpu::WallSegment& segment : scene_.wall_segments) {
            needed += tilesNeeded(segment, scene_.smallest_radius);
            if (needed <= kMost) continue;
            const double length = kMost * static_cast<double>(scene_.smallest_radius);
            diagnostics_.error(
                layout_.walls[segment.wall].where,
                fmt::format("up to this one, walls are longer than {:.0f} km together: more cannot "
                            "be simulated",
                            length / 1000.0),
                "leave out walls that nobody comes near");
            return false;
        }
        return true;
    }

    void buildTerrain() {
        if (scene_.charts && scene_.charts->grounds) return;
        if (scene_.charts)
            scene_.terrain = std::make_shared<const Terrain>(scene_.charts->plane_mesh, true, scene_.origin,
                                                             scene_.minimum, scene_.maximum);
        if (!layout_.terrain || !terrain_mesh_) return;
        try {
            scene_.terrain = std::make_shared<const Terrain>(*terrain_mesh_, layout_.terrain->highest,
                                                             scene_.origin, scene_.minimum, scene_.maximum);
        } catch (const std::invalid_argument& error) {
            diagnostics_.error(layout_.terrain->file_where,
                               fmt::format("the terrain cannot be used: {}", error.what()));
            return;
        }
        checkTerrain(layout_, rebase_, geometry_, *terrain_mesh_, *scene_.terrain, diagnostics_);
        const auto slopes = std::make_shared<const SlopeCosts>(layout_.simulation.motion, *scene_.terrain);
        if (!slopes->isFlat()) geometry_.slopes = slopes;
    }

    /// Routes lead through gates whether these are open or not: people wait before a closed one.
    void openGates() {
        const auto is_gate = [this](const gpu::WallSegment& segment) {
            return !layout_.walls[segment.wall].toggles.empty();
        };
        std::vector<bool> open(layout_.walls.size(), false);
        for (std::uint32_t i = 0; i < layout_.walls.size(); ++i)
            open[i] = layout_.walls[i].open_at_start;
        for (const gpu::WallSegment& segment : geometry_.walls)
            if (is_gate(segment) && !open[segment.wall]) closed_gates_.push_back(segment);
        std::erase_if(geometry_.walls, is_gate);
        for (std::uint32_t i = 0; i < layout_.walls.size(); ++i)
            if (layout_.walls[i].open_at_start) scene_.open_at_start.push_back(i);
        for (const Event& event : layout_.events)
            if (event.kind == Event::Kind::open || event.kind == Event::Kind::close)
                scene_.gate_moves.push_back(
                    {event.at, static_cast<std::uint32_t>(event.subject), event.kind == Event::Kind::open});
    }

    /// Each line's tickets come after those of the lines before.
    void numberTickets() {
        std::uint32_t first = 0;
        for (gpu::WaitingLine& line : scene_.lines) {
            line.first_ticket = first;
            first += line.ticket_count;
        }
    }

    /// What they do begins in their seats.
    void seatAudience(std::size_t group_index, BehaviourTables& behaviours) {
        const SeatBlock& block = layout_.seats[*scene_.groups[group_index].block];
        std::vector<LocalPolygon> feet;
        for (std::size_t aisle = 0; aisle < countAisles(block); ++aisle)
            feet.push_back(rebase_.local(footOf(block, aisle)));
        const std::uint32_t state = behaviours.add(
            layout_.behaviours[*block.behaviour],
            {fmt::format("block `{}`", block.id), group_index, false, "its aisles", std::move(feet)});
        forEachRow(scene_, group_index, [&](gpu::Person& person) {
            behaviours.begin(person, rowOf(scene_, person), state);
            scene_.goals.push_back(person.spawn_position);
        });
    }

    void finish(Routes& routes) {
        scene_.field_count = routes.fieldCount();
        if (layout_.simulation.avoid_congestion && layout_.simulation.motion.isOn("routes_round_jams"))
            scene_.detours = routes.detours();
        scene_.patches = buildPatches(layout_, rebase_, scene_.detours.grid);
        scene_.fields = routes.store();
        scene_.road_distance = ground_->roadDistances();
        const MotionSettings& motion = layout_.simulation.motion;
        if (motion.isOn("nearest_first"))
            scene_.narrow_places =
                narrowPlaces(geometry_, static_cast<float>(motion.number("nearest_first", "widest")));
    }

    const Layout& layout_;
    Diagnostics& diagnostics_;
    GroundCache& cache_;
    const TerrainMesh* terrain_mesh_;
    DistanceSolver* solver_;
    Rebase rebase_;
    WalkGeometry geometry_;
    float thinnest_ = 0.0f;  // m: half of the narrowest that anybody gets through
    std::shared_ptr<Ground> ground_;
    std::vector<gpu::WallSegment> closed_gates_;  // at the start
    Scene scene_;
};

}  // namespace

std::optional<Scene> buildScene(const Layout& layout, Diagnostics& diagnostics, GroundCache* cache,
                                const TerrainMesh* terrain, DistanceSolver* solver) {
    GroundCache own;
    std::shared_ptr<const Charts> charts;
    if (!areLevelsComplete(layout, diagnostics)) return std::nullopt;
    if (!haveGround(layout, layout.terrain && !layout.levels.empty(), diagnostics)) return std::nullopt;
    if (!areFeetOnGround(layout, diagnostics)) return std::nullopt;
    if (!layout.levels.empty() && !layout.terrain && !isWithoutTraffic(layout, diagnostics))
        return std::nullopt;
    if (layout.terrain) {
        if (terrain) charts = layOutTerrain(layout, *terrain, diagnostics);
        if (diagnostics.hasErrors() || !haveGround(layout, charts != nullptr, diagnostics))
            return std::nullopt;
    } else if (!layout.levels.empty()) {
        if (!areOnTheirFloors(layout, diagnostics)) return std::nullopt;
        charts = layOut(layout, diagnostics);
        if (!charts) return std::nullopt;
    }
    const Layout& plane = charts ? charts->plane : layout;
    return SceneAssembly(plane, diagnostics, cache ? *cache : own, terrain, solver, charts).build();
}

}  // namespace throng::authoring
