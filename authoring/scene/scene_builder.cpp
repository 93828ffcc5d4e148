// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/scene_builder.h"

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

#include "authoring/scene/people.h"
#include "authoring/scene/raster.h"
#include "authoring/scene/rebase.h"
#include "authoring/scene/routes.h"
#include "authoring/scene/walls.h"

namespace throng::authoring {
namespace {

constexpr std::uint32_t kEntryPoints = 1024;
constexpr float kStageTolerance = 0.3f;   // m
constexpr float kEntryClearance = 0.02f;  // m beyond the body

/// Bodies already placed, so that nobody starts inside another.
class PlacedBodies {
  public:
    bool hasRoom(glm::vec2 position, float radius) const {
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const auto cell = cells_.find(key(position, x, y));
                if (cell == cells_.end()) continue;
                for (const auto& [other, other_radius] : cell->second)
                    if (glm::distance(other, position) < other_radius + radius) return false;
            }
        return true;
    }
    void add(glm::vec2 position, float radius) { cells_[key(position, 0, 0)].emplace_back(position, radius); }

  private:
    static constexpr float kCell = 2.0f;  // m: bodies have radii of up to one
    static std::uint64_t key(glm::vec2 position, int dx, int dy) {
        const auto x = static_cast<std::int32_t>(std::floor(position.x / kCell)) + dx;
        const auto y = static_cast<std::int32_t>(std::floor(position.y / kCell)) + dy;
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 |
               static_cast<std::uint32_t>(y);
    }
    std::unordered_map<std::uint64_t, std::vector<std::pair<glm::vec2, float>>> cells_;
};

glm::vec2 middleOf(const LocalPolygon& polygon) {
    glm::vec2 middle(0.0f);
    for (const glm::vec2 point : polygon)
        middle += point / static_cast<float>(polygon.size());
    return middle;
}

class Builder {
  public:
    Builder(const Layout& layout, Diagnostics& diagnostics)
        : layout_(layout), diagnostics_(diagnostics), rebase_(layout) {
        scene_.settings = layout.simulation;
        scene_.origin = rebase_.origin();
        scene_.output_origin = rebase_.outputOrigin();
        scene_.minimum = rebase_.minimum();
        scene_.maximum = rebase_.maximum();
    }

    std::optional<Scene> build() {
        drawPeople();
        buildGeometry();
        scene_.grid = makeGrid(geometry_);
        Routes routes(layout_, rebase_, geometry_, scene_.grid);
        for (std::size_t i = 0; i < layout_.flows.size(); ++i)
            routeFlow(layout_.flows[i], i, routes);
        for (std::size_t i = 0; i < layout_.formations.size(); ++i)
            placeFormation(layout_.formations[i], i, routes);
        if (routes.tooManyFields())
            diagnostics_.error({},
                               "there are too many different goals behind walls: their distance fields need "
                               "more than 128 MiB",
                               "give people areas as goals instead of single points");
        if (diagnostics_.hasErrors()) return std::nullopt;
        finish(routes);
        return std::move(scene_);
    }

  private:
    /// Bodies and times of everybody, because the walls' clearance depends on the smallest and the largest
    /// body.
    void drawPeople() {
        for (const Flow& flow : layout_.flows) {
            const GroupRandom random(layout_.simulation.seed, flow.id);
            const std::vector<double> times = entryTimes(flow, random, layout_.simulation.warmup);
            beginGroup(flow.id, true);
            for (std::size_t i = 0; i < times.size(); ++i) {
                gpu::Person person = drawPerson(flow.people, random, i, group());
                person.spawn_time = static_cast<float>(times[i]);
                if (flow.arrival == Arrival::stay) person.flags |= gpu::PERSON_STAYS;
                if (!layout_.roads.empty()) person.flags |= gpu::PERSON_KEEPS_TO_ROADS;
                addPerson(person);
            }
        }
        for (const Formation& formation : layout_.formations) {
            const GroupRandom random(layout_.simulation.seed, formation.id);
            const FormationPlaces places = formationPlaces(formation, layout_.simulation.seed);
            const auto* list = std::get_if<ListFormation>(&formation.shape);
            beginGroup(formation.id, false);
            for (std::size_t i = 0; i < places.positions.size(); ++i) {
                gpu::Person person = drawPerson(formation.people, random, i, group());
                if (list) overrideListed(list->agents[i], person);
                person.spawn_position = rebase_.local(places.positions[i]);
                person.spawn_time =
                    static_cast<float>(formation.start == 0.0 ? -layout_.simulation.warmup : formation.start);
                person.flags |=
                    gpu::PERSON_FIXED_SPAWN | (formation.arrival == Arrival::stay ? gpu::PERSON_STAYS : 0);
                addPerson(person);
            }
        }
    }

    static void overrideListed(const ListedAgent& agent, gpu::Person& person) {
        if (agent.radius) person.radius = static_cast<float>(*agent.radius);
        if (!agent.speed) return;
        person.maximum_speed *= static_cast<float>(*agent.speed) / person.preferred_speed;
        person.preferred_speed = static_cast<float>(*agent.speed);
    }

    void beginGroup(const std::string& id, bool is_flow) {
        scene_.groups.push_back({id, is_flow});
        scene_.queues.push_back({static_cast<gpu::uint>(scene_.people.size()), 0});
    }
    std::uint32_t group() const { return static_cast<std::uint32_t>(scene_.groups.size() - 1); }
    void addPerson(const gpu::Person& person) {
        const bool first = scene_.people.empty();
        scene_.smallest_radius = first ? person.radius : std::min(scene_.smallest_radius, person.radius);
        scene_.largest_radius = first ? person.radius : std::max(scene_.largest_radius, person.radius);
        scene_.people.push_back(person);
        ++scene_.queues.back().row_count;
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
        checkResolution();
        if (scene_.people.empty()) scene_.smallest_radius = scene_.largest_radius = 0.25f;
        geometry_.minimum = scene_.minimum;
        geometry_.maximum = scene_.maximum;
        geometry_.smallest_radius = scene_.smallest_radius;
        geometry_.largest_radius = scene_.largest_radius;
        buildWalls(layout_, rebase_, geometry_);
        for (const Road& road : layout_.roads)
            geometry_.roads.push_back(
                {rebase_.local(road.centreline), static_cast<float>(road.width), road.one_way});
        for (const Area& area : layout_.areas)
            geometry_.areas.push_back(rebase_.local(area.polygon));
        scene_.wall_segments = geometry_.walls;
        scene_.wall_tiles = wallTiles(geometry_.walls, scene_.smallest_radius,
                                      static_cast<float>(layout_.simulation.tile_radius));
    }

    void routeFlow(const Flow& flow, std::size_t index, Routes& routes) {
        const bool keep_to_roads = !layout_.roads.empty();
        std::vector<Place> places = flow.via;
        places.push_back(flow.to);
        const auto first_stage = static_cast<std::uint32_t>(scene_.stages.size());
        LocalPolygon from = routes.outline(flow.from, Routes::kEntryDepth);
        const std::uint32_t first_field = routes.fieldTo(places.front(), keep_to_roads);
        Place before = flow.from;
        for (const Place& place : places) {
            const std::uint32_t field = routes.fieldTo(place, keep_to_roads);
            const LocalPolygon target = routes.outline(place, Routes::kTargetDepth);
            scene_.stages.push_back({middleOf(target), kStageTolerance, field});
            if (routes.reachable(field, from) == kUnreachable)
                diagnostics_.error(place.where.line ? place.where : flow.where,
                                   fmt::format("flow `{}`: nobody can walk from `{}` to `{}`", flow.id,
                                               routes.name(before), routes.name(place)),
                                   "look for walls across the way, doors narrower than a body, and one-way "
                                   "roads that point the other way");
            from = target;
            before = place;
        }
        const auto entry = static_cast<std::uint32_t>(scene_.entries.size());
        scene_.entries.push_back(findEntryPoints(flow, index, routes, first_field));
        const glm::vec2 goal = scene_.stages.back().point;
        forEachRow(index, [&](gpu::Person& person) {
            person.entry = entry;
            person.first_stage = first_stage;
            person.stage_count = static_cast<std::uint32_t>(places.size());
            const glm::vec2 ahead = goal - middleOf(routes.outline(flow.from, Routes::kEntryDepth));
            person.heading = std::atan2(ahead.y, ahead.x);
            scene_.goals.push_back(goal);
        });
    }

    /// Points spread evenly over the entry (the R2 sequence, Roberts 2018), clear of walls and with a way to
    /// the goal.
    gpu::Entry findEntryPoints(const Flow& flow, std::size_t index, const Routes& routes,
                               std::uint32_t field) {
        float largest = 0.0f;
        forEachRow(index, [&](const gpu::Person& person) { largest = std::max(largest, person.radius); });
        const LocalPolygon outline = routes.outline(flow.from, Routes::kEntryDepth);
        const Box box = boundsOf(outline, 0.0f);
        const auto first = static_cast<std::uint32_t>(scene_.entry_points.size());
        double x = 0.5, y = 0.5;
        for (std::uint32_t i = 0; i < 16 * kEntryPoints && scene_.entry_points.size() - first < kEntryPoints;
             ++i) {
            x = std::fmod(x + 0.7548776662466927, 1.0);
            y = std::fmod(y + 0.5698402909980532, 1.0);
            const glm::vec2 point =
                box.lower + (box.upper - box.lower) * glm::vec2(static_cast<float>(x), static_cast<float>(y));
            if (!insidePolygon(outline, point) ||
                wallDepth(geometry_, point, largest + kEntryClearance) > 0.0f)
                continue;
            if (routes.reachable(field, point) < kUnreachable) scene_.entry_points.push_back(point);
        }
        const auto found = static_cast<std::uint32_t>(scene_.entry_points.size()) - first;
        if (found == 0) {
            diagnostics_.error(
                flow.from.where.line ? flow.from.where : flow.where,
                fmt::format("flow `{}`: there is no room to enter in `{}`", flow.id, routes.name(flow.from)),
                "its area is inside a wall, too small for a body, or cut off from the goal");
            scene_.entry_points.push_back(middleOf(outline));
        }
        return {first, std::max(found, 1u)};
    }

    template <class Visit>
    void forEachRow(std::size_t group_index, Visit visit) {
        const gpu::SpawnQueue& queue = scene_.queues[group_index];
        for (std::uint32_t row = queue.first_row; row < queue.first_row + queue.row_count; ++row)
            visit(scene_.people[row]);
    }

    void placeFormation(const Formation& formation, std::size_t formation_index, Routes& routes) {
        const std::size_t index = layout_.flows.size() + formation_index;
        const FormationPlaces places = formationPlaces(formation, layout_.simulation.seed);
        const auto* grid = std::get_if<GridFormation>(&formation.shape);
        const Place* place = grid ? std::get_if<Place>(&grid->goal) : nullptr;
        const std::uint32_t place_field = place ? routes.fieldTo(*place, false) : gpu::NO_INDEX;
        const glm::vec2 place_goal =
            place ? middleOf(routes.outline(*place, Routes::kTargetDepth)) : glm::vec2(0.0f);
        std::size_t i = 0;
        forEachRow(index, [&](gpu::Person& person) {
            const glm::vec2 goal = place ? place_goal : rebase_.local(places.goals[i]);
            person.first_stage = static_cast<std::uint32_t>(scene_.stages.size());
            person.stage_count = 1;
            scene_.stages.push_back(stageOf(formation, i, person, goal, place_field, routes));
            scene_.goals.push_back(goal);
            turn(formation, i, goal, person);
            if (formation.start == 0.0 && bodies_.hasRoom(person.spawn_position, person.radius)) {
                person.flags |= gpu::PERSON_PRESENT_AT_START;
                bodies_.add(person.spawn_position, person.radius);
            }
            ++i;
        });
    }

    void turn(const Formation& formation, std::size_t i, glm::vec2 goal, gpu::Person& person) const {
        const glm::vec2 ahead = goal - person.spawn_position;
        person.heading = ahead == glm::vec2(0.0f) ? 0.0f : std::atan2(ahead.y, ahead.x);
        if (const auto* list = std::get_if<ListFormation>(&formation.shape); list && list->agents[i].heading)
            person.heading = static_cast<float>(*list->agents[i].heading * 3.14159265358979 / 180.0);
    }

    gpu::Stage stageOf(const Formation& formation, std::size_t i, const gpu::Person& person, glm::vec2 goal,
                       std::uint32_t place_field, Routes& routes) {
        const auto tolerance = static_cast<float>(formation.goal_tolerance);
        if (const float depth = wallDepth(geometry_, person.spawn_position, person.radius); depth > 0.0f)
            complain(formation, i, fmt::format("stands in a wall ({:.2f} m deep)", depth),
                     "move it, or the wall");
        if (place_field != gpu::NO_INDEX) {
            if (routes.reachable(place_field, person.spawn_position) == kUnreachable)
                complain(formation, i, "cannot reach its goal", "look for walls all round it");
            return {goal, kStageTolerance, place_field};
        }
        if (wallDepth(geometry_, goal, person.radius) > 0.0f) {
            complain(formation, i, "has its goal in a wall", "move the goal, or the wall");
            return {goal, tolerance, gpu::NO_INDEX};
        }
        // Even where the straight way is clear, others may push somebody round a corner on the way. But cells
        // coarser than a body close gaps that are open: then the straight way is what can be trusted.
        const gpu::Stage straight{goal, tolerance, gpu::NO_INDEX};
        if (geometry_.walls.empty()) return straight;
        const bool clear = straightIsClear(geometry_, person.spawn_position, goal, person.radius);
        if (clear && scene_.grid.cell_size > 0.5f) return straight;
        const std::uint32_t field = routes.fieldTo(goal);
        if (clear &&
            (field == gpu::NO_INDEX || routes.reachable(field, person.spawn_position) == kUnreachable))
            return straight;
        if (field == gpu::NO_INDEX) {
            routes.lackField();
            return straight;
        }
        if (routes.reachable(field, person.spawn_position) == kUnreachable)
            complain(formation, i, "cannot reach its goal", "there is a wall all round one of the two");
        return {goal, tolerance, field | gpu::FIELD_THEN_POINT};
    }

    void complain(const Formation& formation, std::size_t i, const std::string& what,
                  const std::string& hint) {
        SourcePosition where = formation.where;
        if (const auto* list = std::get_if<ListFormation>(&formation.shape)) where = list->agents[i].where;
        diagnostics_.error(where, fmt::format("formation `{}`: person {} {}", formation.id, i, what), hint);
    }

    void finish(Routes& routes) {
        scene_.field_count = routes.fieldCount();
        if (layout_.simulation.avoid_congestion) scene_.detours = routes.detours();
        scene_.fields = routes.takeCells();
        scene_.road_distance = roadDistance(geometry_, scene_.grid);
    }

    const Layout& layout_;
    Diagnostics& diagnostics_;
    Rebase rebase_;
    WalkGeometry geometry_;
    PlacedBodies bodies_;
    Scene scene_;
};

}  // namespace

std::optional<Scene> buildScene(const Layout& layout, Diagnostics& diagnostics) {
    return Builder(layout, diagnostics).build();
}

}  // namespace throng::authoring
