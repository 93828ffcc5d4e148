// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/scene_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "authoring/layout/layout_reader.h"
#include "authoring/layout/patch_sizes.h"
#include "authoring/layout/plan.h"
#include "authoring/scene/audience.h"
#include "authoring/scene/behaviours.h"
#include "authoring/scene/boarding.h"
#include "authoring/scene/chart_map.h"
#include "authoring/scene/given.h"
#include "authoring/scene/itineraries.h"
#include "authoring/scene/narrow_places.h"
#include "authoring/scene/patches.h"
#include "authoring/scene/people.h"
#include "authoring/scene/raster.h"
#include "authoring/scene/rebase.h"
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
#include "base/capsule.h"

namespace throng::authoring {
namespace {

constexpr std::uint32_t kEntryPoints = 1024;
constexpr float kEntryClearance = 0.02f;  // m beyond the body
constexpr float kPauseTolerance = 1.0f;   // m: who is pushed about before setting off does not mind
constexpr std::uint64_t kPauseDraw = 900;
constexpr double kComesOutByVehicle = 1.0e9;  // s: at a time of its own nobody gets off

Capsule shapeOf(const gpu::Person& person) {
    const double heading = person.heading;
    return capsuleOf(person.spawn_position, {std::cos(heading), std::sin(heading)}, person.radius,
                     person.half_axis);
}

/// m: half of what it needs to get through somewhere.
float thicknessOf(const gpu::Person& person) {
    return person.radius - std::abs(person.half_axis);
}

/// Bodies already placed, so that nobody starts inside another.
class PlacedBodies {
  public:
    bool hasRoom(const gpu::Person& person) const {
        const glm::vec2 position = person.spawn_position;
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const auto cell = cells_.find(key(position, x, y));
                if (cell == cells_.end()) continue;
                for (const gpu::Person& other : cell->second)
                    if (areInEachOther(person, other)) return false;
            }
        return true;
    }
    void add(const gpu::Person& person) { cells_[key(person.spawn_position, 0, 0)].push_back(person); }

  private:
    static bool areInEachOther(const gpu::Person& a, const gpu::Person& b) {
        if (glm::distance(b.spawn_position, a.spawn_position) >= b.radius + a.radius) return false;
        return (a.half_axis == 0.0f && b.half_axis == 0.0f) || freeBetween(shapeOf(a), shapeOf(b)) < 0.0;
    }
    static constexpr float kCell = 2.0f;  // m: bodies have radii of up to one
    static std::uint64_t key(glm::vec2 position, int dx, int dy) {
        const auto x = static_cast<std::int32_t>(std::floor(position.x / kCell)) + dx;
        const auto y = static_cast<std::int32_t>(std::floor(position.y / kCell)) + dy;
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 |
               static_cast<std::uint32_t>(y);
    }
    std::unordered_map<std::uint64_t, std::vector<gpu::Person>> cells_;
};

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
        drawPeople();
        buildGeometry();
        if (diagnostics_.hasErrors()) return std::nullopt;
        scene_.traffic = buildTraffic(layout_, rebase_, diagnostics_);
        if (diagnostics_.hasErrors()) return std::nullopt;
        addCalls(layout_, scene_.queues, scene_.traffic);
        buildTerrain();
        if (terrain_mesh_ && layout_.terrain && !scene_.terrain) return std::nullopt;
        Routes routes = planRoutes();
        Itineraries itineraries(layout_, rebase_, geometry_, routes, diagnostics_, scene_);
        itineraries.prepare();
        routes.solvePlanned();
        BehaviourTables behaviours(layout_, rebase_, geometry_, routes, itineraries, diagnostics_, scene_);
        for (std::size_t i = 0; i < layout_.flows.size(); ++i)
            routeFlow(layout_.flows[i], i, routes, itineraries, behaviours);
        for (std::size_t i = 0; i < layout_.formations.size(); ++i)
            placeFormation(layout_.formations[i], i, routes, itineraries, behaviours);
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
        const std::vector<Routes::PointGoal> goals = pointGoals();
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

    /// Without walls, the straight way is all there is to know.
    std::vector<Routes::PointGoal> pointGoals() {
        std::vector<Routes::PointGoal> goals;
        if (!geometry_.hasObstacles()) return goals;
        for (std::size_t index = 0; index < layout_.formations.size(); ++index) {
            const Formation& formation = layout_.formations[index];
            if (formation.behaviour) continue;
            const FormationPlaces places = formationPlaces(formation, layout_.simulation.seed);
            if (places.goals.empty()) continue;
            std::uint64_t i = 0;
            forEachRow(layout_.flows.size() + index, [&](const gpu::Person& person) {
                const Traveller traveller = travellerOf(person, layout_.flows.size() + index, i);
                glm::vec2 from = person.spawn_position;
                const auto goOn = [&](glm::dvec2 to) {
                    const glm::vec2 goal = rebase_.local(to);
                    goals.emplace_back(goal, isStraight(from, goal, person.radius));
                    from = goal;
                };
                for (const Waypoint& waypoint : wayOf(formation, i))
                    goOn(waypoint.point);
                if (!ownDestination(formation, i)) goOn(goalOf(formation, places, i, traveller.leader));
                ++i;
            });
        }
        return goals;
    }

    bool isStraight(glm::vec2 from, glm::vec2 to, float radius) const {
        return straightIsClear(geometry_, from, to, radius) &&
               !(geometry_.slopes && geometry_.slopes->meets(from, to)) &&
               std::ranges::none_of(geometry_.costly,
                                    [&](const CostlyGround& ground) { return ground.meets(from, to); });
    }

    /// Bodies and times of everybody, because the walls' clearance depends on the smallest and the largest
    /// body.
    void drawPeople() {
        for (std::size_t i = 0; i < layout_.flows.size(); ++i)
            drawFlow(layout_.flows[i], i);
        for (const Formation& formation : layout_.formations)
            drawFormation(formation);
        for (std::size_t block = 0; block < layout_.seats.size(); ++block)
            if (layout_.seats[block].isOpen()) drawAudience(block);
        for (std::size_t index = 0; index < layout_.given.size(); ++index) {
            beginGroup(layout_.given[index].id, false, layout_.given[index].people);
            scene_.groups.back().is_given = true;
            for (gpu::Person& person : givenPeople(layout_, index, scene_.charts.get(), rebase_, group())) {
                person.party_first = static_cast<std::uint32_t>(scene_.people.size());
                addPerson(person);
            }
        }
    }

    void drawFlow(const Flow& flow, std::size_t index) {
        const GroupRandom random(layout_.simulation.seed, flow.id);
        std::vector<RateChange> changes;
        for (const Event& event : layout_.events)
            if (event.kind == Event::Kind::rate && event.subject == index)
                changes.push_back({event.at, event.rate});
        // Who is told to go elsewhere does not come in any more.
        double end = std::numeric_limits<double>::infinity();
        for (const Turn& turn : turnsOf(planOf(layout_, flow)))
            if (turn.at > flow.start) end = std::min(end, turn.at);
        const std::vector<double> times =
            flow.alights ? std::vector<double>(alightingPeople(layout_, flow), kComesOutByVehicle)
                         : entryTimes(flow, changes, random, layout_.simulation.warmup, end);
        beginGroup(flow.id, true, flow.people);
        std::vector<Party> parties = drawParties(flow.people, random, times.size());
        if (flow.alights) {
            const std::uint64_t each = std::max<std::uint64_t>(flow.count.value_or(0), 1);
            parties = splitWhere(parties, [&](std::uint64_t i) { return i % each == 0; });
        }
        for (const Party& party : parties) {
            for (std::uint64_t i = party.first; i < party.first + party.size; ++i) {
                gpu::Person person = drawPerson(flow.people, random, i, group());
                person.spawn_time = static_cast<float>(times[party.first]);
                if (flow.alights) person.flags |= gpu::PERSON_ALIGHTS;
                if (keepsToRoads(layout_)) person.flags |= gpu::PERSON_KEEPS_TO_ROADS;
                addPerson(person);
            }
            bringTogether(party);
        }
    }

    void drawFormation(const Formation& formation) {
        const GroupRandom random(layout_.simulation.seed, formation.id);
        const FormationPlaces places = formationPlaces(formation, layout_.simulation.seed);
        const auto* list = std::get_if<ListFormation>(&formation.shape);
        beginGroup(formation.id, false, formation.people);
        std::vector<Party> parties = drawParties(formation.people, random, places.positions);
        if (list)  // nobody waits for company that comes later or goes another way
            parties = splitWhere(
                parties, [&](std::uint64_t i) { return !goAlike(list->agents[i - 1], list->agents[i]); });
        for (const Party& party : parties) {
            for (std::uint64_t i = party.first; i < party.first + party.size; ++i) {
                gpu::Person person = drawPerson(formation.people, random, i, group());
                if (list) overrideListed(list->agents[i], person);
                person.spawn_position = rebase_.local(places.positions[i]);
                const double start = startOf(formation, i);
                person.spawn_time = static_cast<float>(start == 0.0 ? -layout_.simulation.warmup : start);
                person.flags |= gpu::PERSON_FIXED_SPAWN;
                addPerson(person);
            }
            bringTogether(party);
        }
    }

    /// Those who sit in a block that people walk to or leave.
    void drawAudience(std::size_t index) {
        const SeatBlock& block = layout_.seats[index];
        beginGroup(block.id, false, block.people);
        scene_.groups.back().block = index;
        const std::vector<Spectator> audience = audienceIn(layout_, index);
        for (std::size_t i = 0; i < audience.size(); ++i) {
            const Spectator& each = audience[i];
            gpu::Person person = each.person;
            person.group = group();
            person.spawn_position = rebase_.local(each.seat.place);
            person.spawn_time = static_cast<float>(-layout_.simulation.warmup);
            person.heading = static_cast<float>(std::atan2(each.seat.ahead.y, each.seat.ahead.x));
            person.flags |=
                gpu::PERSON_FIXED_SPAWN | gpu::PERSON_PRESENT_AT_START | gpu::PERSON_SITS_AT_START;
            addPerson(person);
            const bool is_last = i + 1 == audience.size() || audience[i + 1].party != each.party;
            if (is_last) bringTogether({each.party, static_cast<std::uint32_t>(i + 1 - each.party)});
        }
    }

    /// The last ones added are a party.
    void bringTogether(const Party& party) {
        const std::span<gpu::Person> members(scene_.people.end() - party.size, scene_.people.end());
        const auto first = static_cast<std::uint32_t>(scene_.people.size() - party.size);
        for (gpu::Person& person : members) {
            person.party_first = first;
            person.party_size = party.size;
        }
        walkTogether(members);
    }

    static const ListedAgent* listed(const Formation& formation, std::uint64_t i) {
        const auto* list = std::get_if<ListFormation>(&formation.shape);
        return list ? &list->agents[i] : nullptr;
    }
    /// Of somebody who is listed with a place to go to.
    static const Destination* ownDestination(const Formation& formation, std::uint64_t i) {
        const ListedAgent* agent = listed(formation, i);
        return agent && agent->to ? &*agent->to : nullptr;
    }
    static double startOf(const Formation& formation, std::uint64_t i) {
        const ListedAgent* agent = listed(formation, i);
        return agent ? agent->start : formation.start;
    }
    static std::span<const Waypoint> wayOf(const Formation& formation, std::uint64_t i) {
        const ListedAgent* agent = listed(formation, i);
        return agent ? std::span<const Waypoint>(agent->via) : std::span<const Waypoint>();
    }

    static bool goAlike(const ListedAgent& a, const ListedAgent& b) {
        const auto same = [](const Place& one, const Place& other) {
            return one.kind == other.kind && one.index == other.index;
        };
        const auto placesOf = [](const ListedAgent& agent) {
            return agent.to ? std::span<const Place>(agent.to->places) : std::span<const Place>();
        };
        return a.start == b.start && a.wait == b.wait && std::ranges::equal(placesOf(a), placesOf(b), same) &&
               std::ranges::equal(a.via, b.via, {}, &Waypoint::point, &Waypoint::point) &&
               std::ranges::equal(a.via, b.via, {}, &Waypoint::wait, &Waypoint::wait);
    }

    static void overrideListed(const ListedAgent& agent, gpu::Person& person) {
        if (agent.radius) {
            person.radius = static_cast<float>(*agent.radius);
            person.half_axis = 0.0f;
        }
        if (!agent.speed) return;
        person.maximum_speed *= static_cast<float>(*agent.speed) / person.preferred_speed;
        person.preferred_speed = static_cast<float>(*agent.speed);
    }

    void beginGroup(const std::string& id, bool is_flow, const People& people) {
        scene_.groups.push_back({id, is_flow, false, people.look, people.colours, {}});
        for (const PeopleShare& share : people.kinds)
            scene_.groups.back().profiles.push_back(share.profile);
        scene_.queues.push_back({static_cast<gpu::uint>(scene_.people.size()), 0});
    }
    std::uint32_t group() const { return static_cast<std::uint32_t>(scene_.groups.size() - 1); }
    void addPerson(const gpu::Person& person) {
        const bool first = scene_.people.empty();
        scene_.smallest_radius = first ? person.radius : std::min(scene_.smallest_radius, person.radius);
        scene_.largest_radius = first ? person.radius : std::max(scene_.largest_radius, person.radius);
        thinnest_ = first ? thicknessOf(person) : std::min(thinnest_, thicknessOf(person));
        scene_.people.push_back(person);
        scene_.people.back().own_radius = person.radius;
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

    /// Who gets on waits until then, and looks at the tracks.
    std::vector<BehaviourState> wayOf(const Behaviour& plan, const Flow& flow) const {
        std::vector<BehaviourState> way = wayFrom(plan, plan.start);
        if (!flow.boards) return way;
        way.back().lasts = {Distribution::Kind::constant, double{gpu::DWELL_WHILE}, 0.0, 0.0, 0.0};
        way.back().facing = sightAt(layout_, *flow.boards);
        return way;
    }

    /// Those who walk stop by stop; whoever has a behaviour begins in its first state.
    void routeFlow(const Flow& flow, std::size_t index, Routes& routes, Itineraries& itineraries,
                   BehaviourTables& behaviours) {
        const Behaviour plan = planOf(layout_, flow);
        Journey journey{fmt::format("flow `{}`", flow.id), flow.where, keepsToRoads(layout_)};
        const LocalPolygon start = routes.outline(flow.from, Routes::kEntryDepth);
        const std::string from = fmt::format("`{}`", routes.name(flow.from));
        std::uint32_t state = 0, first_field = 0;
        if (flow.behaviour) {
            state = behaviours.add(layout_.behaviours[*flow.behaviour],
                                   {journey.traveller, index, journey.keep_to_roads, from, {start}});
            first_field = behaviours.fieldOf(state);
        } else {
            journey.stops = wayOf(plan, flow);
            itineraries.check(journey, from, {start});
            first_field = itineraries.fieldTo(journey.stops.front().to, journey.keep_to_roads);
        }
        const auto entry = static_cast<std::uint32_t>(scene_.entries.size());
        scene_.entries.push_back(findEntryPoints(flow, index, routes, first_field));
        const GroupRandom random(layout_.simulation.seed, flow.id);
        std::uint64_t i = 0;
        gpu::Person before{};
        forEachRow(index, [&](gpu::Person& person) {
            person.entry = entry;
            if (flow.behaviour) {
                behaviours.begin(person, rowOf(person), state);
            } else if (i > 0 && Itineraries::isShared(journey)) {
                person.first_stage = before.first_stage;
                person.stage_count = before.stage_count;
            } else {
                person.first_stage = static_cast<std::uint32_t>(scene_.stages.size());
                person.stage_count = itineraries.appendStages(journey, random, travellerOf(person, index, i));
                if (flow.boards) scene_.stages.back().board = boardWord(layout_, *flow.boards);
            }
            const glm::vec2 goal = scene_.stages[person.first_stage + person.stage_count - 1].point;
            const glm::vec2 ahead = wayBetween(scene_.entry_points[scene_.entries[entry].first_point], goal);
            person.heading = std::atan2(ahead.y, ahead.x);
            scene_.goals.push_back(goal);
            addChanges(plan, flow.people, {start}, random, i, index, person, itineraries);
            before = person;
            ++i;
        });
    }

    Traveller travellerOf(const gpu::Person& person, std::size_t group_index, std::uint64_t i) const {
        const std::uint32_t first_row = scene_.queues[group_index].first_row;
        const std::uint64_t leader = person.party_first - first_row;
        return {leader, static_cast<std::uint32_t>(i - leader), person.party_size, person.radius};
    }

    /// The turns that somebody's plan takes at times of the shot.
    void addChanges(const Behaviour& plan, const People& people, const std::vector<LocalPolygon>& from,
                    const GroupRandom& random, std::uint64_t i, std::size_t group_index, gpu::Person& person,
                    Itineraries& itineraries) {
        person.first_change = static_cast<std::uint32_t>(scene_.plan_changes.size());
        std::uint64_t nth = 0;
        for (const Turn& turn : turnsOf(plan)) {
            Journey journey{fmt::format("`{}`", plan.id), plan.states[turn.then].where,
                            (person.flags & gpu::PERSON_KEEPS_TO_ROADS) != 0, wayFrom(plan, turn.then)};
            journey.first_draw = 1000 + nth;
            if (i == 0) itineraries.check(journey, "where they start", from);
            const Traveller traveller = travellerOf(person, group_index, i);
            const PeopleShare& kind = people.kinds[kindOf(people, random, traveller.leader)];
            const double reaction =
                random.draw(kind.settings.reaction, traveller.leader, Purpose::reaction, nth++);
            gpu::PlanChange change{};
            change.start_step = stepAt(turn.at + reaction);
            change.first_stage = static_cast<std::uint32_t>(scene_.stages.size());
            change.stage_count = itineraries.appendStages(journey, random, traveller);
            scene_.plan_changes.push_back(change);
            ++person.change_count;
        }
    }

    /// How many steps are done at a time of the shot.
    std::uint32_t stepAt(double time) const {
        const SimulationSettings& s = layout_.simulation;
        return static_cast<std::uint32_t>(std::ceil((time + s.warmup) * s.fps * s.substeps));
    }

    /// Points clear of walls and with a way to the goal.
    gpu::Entry findEntryPoints(const Flow& flow, std::size_t index, const Routes& routes,
                               std::uint32_t field) {
        float largest = 0.0f;
        forEachRow(index, [&](const gpu::Person& person) { largest = std::max(largest, person.radius); });
        const LocalPolygon outline = routes.outline(flow.from, Routes::kEntryDepth);
        const auto first = static_cast<std::uint32_t>(scene_.entry_points.size());
        Itineraries::Spread spread(outline, geometry_, largest + kEntryClearance);
        for (std::uint32_t i = 0; i < 16 * kEntryPoints && scene_.entry_points.size() - first < kEntryPoints;
             ++i) {
            const std::optional<glm::vec2> point = spread.next();
            if (!point) break;
            if (field == gpu::NO_INDEX || routes.reachable(field, *point) < kUnreachable)
                scene_.entry_points.push_back(*point);
        }
        const auto found = static_cast<std::uint32_t>(scene_.entry_points.size()) - first;
        if (found == 0) {
            diagnostics_.error(
                flow.from.where.line ? flow.from.where : flow.where,
                fmt::format("flow `{}`: there is no room to enter in `{}`", flow.id, routes.name(flow.from)),
                "its area is inside a wall, too small for a body, or cut off from the goal");
            scene_.entry_points.push_back(outline.front());
        }
        return {first, std::max(found, 1u)};
    }

    template <class Visit>
    void forEachRow(std::size_t group_index, Visit visit) {
        const gpu::SpawnQueue& queue = scene_.queues[group_index];
        for (std::uint32_t row = queue.first_row; row < queue.first_row + queue.row_count; ++row)
            visit(scene_.people[row]);
    }

    std::size_t rowOf(const gpu::Person& person) const {
        return static_cast<std::size_t>(&person - scene_.people.data());
    }

    /// The state in which a formation's people begin.
    std::uint32_t addBehaviour(const Formation& formation, std::size_t index, const Journey& journey,
                               BehaviourTables& behaviours) const {
        const glm::vec2 place = scene_.people[scene_.queues[index].first_row].spawn_position;
        return behaviours.add(layout_.behaviours[*formation.behaviour],
                              {journey.traveller, index, false, "where they stand", {{place, place, place}}});
    }

    void placeFormation(const Formation& formation, std::size_t formation_index, Routes& routes,
                        Itineraries& itineraries, BehaviourTables& behaviours) {
        const std::size_t index = layout_.flows.size() + formation_index;
        const FormationPlaces places = formationPlaces(formation, layout_.simulation.seed);
        const GroupRandom random(layout_.simulation.seed, formation.id);
        const Behaviour plan = planOf(layout_, formation);
        Journey journey{fmt::format("formation `{}`", formation.id), formation.where};
        const bool shared = !plan.states.front().to.places.empty();
        if (shared) journey.stops = wayFrom(plan, plan.start);
        const std::uint32_t state =
            formation.behaviour ? addBehaviour(formation, index, journey, behaviours) : 0;
        PlacedBodies later;  // who comes in at the same time
        double since = 0.0;
        std::uint64_t i = 0;
        forEachRow(index, [&](gpu::Person& person) {
            const Traveller traveller = travellerOf(person, index, i);
            const double start = startOf(formation, i);
            if (start != std::exchange(since, start)) later = {};
            PlacedBodies& bodies = start == 0.0 ? bodies_ : later;
            person.first_stage = static_cast<std::uint32_t>(scene_.stages.size());
            addPause(formation, i, random, traveller, person);
            if (formation.behaviour) {
                behaviours.begin(person, rowOf(person), state);
            } else {
                const Destination* own = ownDestination(formation, i);
                if (own) journey.stops = {goalState(*own, formation.arrival)};
                const glm::vec2 from = addWay(formation, i, routes, person);
                if (own || shared) {
                    person.stage_count += itineraries.appendStages(journey, random, traveller);
                    const std::uint32_t field = scene_.stages.back().field & ~gpu::FIELD_THEN_POINT;
                    if (routes.reachable(field, from) == kUnreachable)
                        complain(i, "cannot reach its goal", "look for walls all round it");
                } else {
                    addGoal(formation, i, from, rebase_.local(goalOf(formation, places, i, traveller.leader)),
                            routes, person);
                }
            }
            scene_.goals.push_back(scene_.stages.back().point);
            const std::size_t first = scene_.stages.size() - 1 - wayOf(formation, i).size();
            turn(formation, i, scene_.stages[first], routes, person);
            checkStart(i, start, person, bodies);
            addChanges(plan, formation.people,
                       {{person.spawn_position, person.spawn_position, person.spawn_position}}, random, i,
                       index, person, itineraries);
            if (bodies.hasRoom(person)) {
                if (start == 0.0) person.flags |= gpu::PERSON_PRESENT_AT_START;
                bodies.add(person);
            }
            ++i;
        });
        reportComplaints(formation);
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
        forEachRow(group_index, [&](gpu::Person& person) {
            behaviours.begin(person, rowOf(person), state);
            scene_.goals.push_back(person.spawn_position);
        });
    }

    /// m: how far into walls somebody stands.
    float depthInWalls(const gpu::Person& person) const {
        const Capsule shape = shapeOf(person);
        float depth = -kUnreachable;
        for (const double along : {-1.0, 0.0, 1.0})
            depth = std::max(depth, wallDepth(geometry_, glm::vec2(shape.middle + along * shape.axis),
                                              static_cast<float>(shape.thickness)));
        return depth;
    }

    static double wallGap(const Capsule& shape, const gpu::WallSegment& wall) {
        const glm::dvec2 half = 0.5 * glm::dvec2(wall.b - wall.a);
        return segmentsDistance(shape.middle - 0.5 * glm::dvec2(wall.a + wall.b), shape.axis, half) -
               shape.thickness - wall.half_thickness;
    }

    void checkStart(std::uint64_t i, double start, const gpu::Person& person, const PlacedBodies& bodies) {
        if (const float depth = depthInWalls(person); depth > 0.0f)
            complain(i, "stands in a wall", "move it, or the wall", fmt::format(" ({:.2f} m deep)", depth));
        if (start == 0.0)
            for (const gpu::WallSegment& gate : closed_gates_)
                if (wallGap(shapeOf(person), gate) < 0.0) {
                    complain(i, fmt::format("stands in the closed gate `{}`", layout_.walls[gate.wall].id),
                             "move it, or open the gate at the start");
                    break;
                }
        if (!bodies.hasRoom(person))
            complain(
                i,
                "starts where somebody else stands: it comes in once there is room, or is refused in the end",
                "move it, by both bodies' radii or more", "", Severity::warning);
    }

    /// Who walks together ends together: no further from the first one's goal than standing side by side
    /// takes.
    static glm::dvec2 goalOf(const Formation& formation, const FormationPlaces& places, std::uint64_t i,
                             std::uint64_t leader) {
        if (i == leader) return places.goals[i];
        const auto* grid = std::get_if<GridFormation>(&formation.shape);
        const bool by_chance = grid && std::holds_alternative<Extent>(grid->goal);
        const std::vector<glm::dvec2>& pattern = by_chance ? places.positions : places.goals;
        const glm::dvec2 offset = pattern[i] - pattern[leader];
        const double most = 0.8 * static_cast<double>(i - leader);
        return places.goals[leader] + offset * std::min(1.0, most / std::max(glm::length(offset), 1.0e-9));
    }

    /// Those who do not set off at once first stop where they stand.
    void addPause(const Formation& formation, std::uint64_t i, const GroupRandom& random,
                  const Traveller& traveller, gpu::Person& person) {
        const ListedAgent* agent = listed(formation, i);
        const double wait = agent && agent->wait
                                ? *agent->wait
                                : random.draw(formation.wait, traveller.leader, Purpose::wait, kPauseDraw);
        if (wait <= 0.0) return;
        gpu::Stage pause = pointStage(person.spawn_position, kPauseTolerance);
        pause.dwell = static_cast<float>(wait);
        scene_.stages.push_back(pause);
        ++person.stage_count;
    }

    static gpu::Stage pointStage(glm::vec2 point, float tolerance) {
        gpu::Stage stage{};
        stage.point = stage.facing = point;
        stage.tolerance = tolerance;
        stage.field = stage.line = gpu::NO_INDEX;
        stage.activity = gpu::ACTIVITY_STAND;
        return stage;
    }

    /// m, from one place in the plane to another as they lie at home.
    glm::vec2 wayBetween(glm::vec2 from, glm::vec2 to) const {
        return scene_.chart_map.home(to) - scene_.chart_map.home(from);
    }

    /// People look where their way leads.
    void turn(const Formation& formation, std::size_t i, const gpu::Stage& stage, const Routes& routes,
              gpu::Person& person) const {
        glm::vec2 ahead = wayBetween(person.spawn_position, stage.point);
        if (stage.field != gpu::NO_INDEX && (stage.field & gpu::FIELD_THEN_POINT) != 0)
            if (const glm::vec2 way =
                    routes.directionFrom(stage.field & ~gpu::FIELD_THEN_POINT, person.spawn_position);
                way != glm::vec2(0.0f))
                ahead = way;
        person.heading = ahead == glm::vec2(0.0f) ? 0.0f : std::atan2(ahead.y, ahead.x);
        if (const ListedAgent* agent = listed(formation, i); agent && agent->heading)
            person.heading = static_cast<float>(*agent->heading * 3.14159265358979 / 180.0);
    }

    /// The places on somebody's way. @returns the last of them, or where it begins
    glm::vec2 addWay(const Formation& formation, std::uint64_t i, Routes& routes, gpu::Person& person) {
        glm::vec2 from = person.spawn_position;
        for (const Waypoint& waypoint : wayOf(formation, i))
            from = addLeg(formation, i, from, rebase_.local(waypoint.point),
                          static_cast<float>(waypoint.wait), &waypoint, routes, person);
        return from;
    }

    /// A goal that is a point.
    void addGoal(const Formation& formation, std::uint64_t i, glm::vec2 from, glm::vec2 goal, Routes& routes,
                 gpu::Person& person) {
        const float dwell = formation.arrival == Arrival::stay ? gpu::DWELL_FOR_GOOD : 0.0f;
        addLeg(formation, i, from, goal, dwell, nullptr, routes, person);
        const auto* grid = std::get_if<GridFormation>(&formation.shape);
        if (grid && std::holds_alternative<Extent>(grid->goal))
            scene_.stages.back().flags |= gpu::STAGE_ANYWHERE;
    }

    /// @param waypoint null: it is the goal
    glm::vec2 addLeg(const Formation& formation, std::uint64_t i, glm::vec2 from, glm::vec2 to, float dwell,
                     const Waypoint* waypoint, Routes& routes, gpu::Person& person) {
        gpu::Stage stage = pointStage(to, static_cast<float>(formation.goal_tolerance));
        stage.dwell = dwell;
        findWay(formation, i, waypoint, person, from, routes, stage);
        scene_.stages.push_back(stage);
        ++person.stage_count;
        return to;
    }

    /// By which field somebody goes from one place to that of a stage, where there are walls.
    /// @param waypoint null: it is the goal
    void findWay(const Formation& formation, std::uint64_t i, const Waypoint* waypoint,
                 const gpu::Person& person, glm::vec2 from, Routes& routes, gpu::Stage& stage) {
        const glm::vec2 goal = stage.point;
        if (!geometry_.hasObstacles()) return;
        if (const auto near = whyUnattainable(formation, person, goal)) {
            complain(i, waypoint ? "has a place of its way in a wall" : "has its goal in a wall",
                     near->empty() ? "move the goal, or the wall"
                                   : "move the goal, or the wall, or raise `goal_tolerance`",
                     *near, Severity::error, waypoint);
            return;
        }
        // Even where the straight way is clear, others may push somebody round a corner on the way.
        const bool clear = isStraight(from, goal, person.radius);
        const std::uint32_t field = routes.fieldTo({goal, clear});
        if (field == gpu::NO_INDEX) {
            if (!clear) routes.lackField();
            return;
        }
        if (routes.reachable(field, from) == kUnreachable) {
            if (!clear)
                complain(i, waypoint ? "cannot reach a place of its way" : "cannot reach its goal",
                         "there is a wall all round one of the two", "", Severity::error, waypoint);
            return;
        }
        stage.field = field | gpu::FIELD_THEN_POINT;
    }

    /// A goal may be nearer to a wall than a body gets to it, as long as it gets near enough.
    /// @returns nothing for goals that will do
    /// @returns nothing where it is; no words where it is in the wall itself
    std::optional<std::string> whyUnattainable(const Formation& formation, const gpu::Person& person,
                                               glm::vec2 goal) const {
        constexpr float kHair = 1.0e-4f;  // m, of rounding
        const float depth = wallDepth(geometry_, goal, thicknessOf(person));
        if (depth <= static_cast<float>(formation.goal_tolerance) + kHair &&
            wallDepth(geometry_, goal, 0.0f) <= 0.0f && !isInSolid(goal))
            return std::nullopt;
        const float apart = thicknessOf(person) - depth;  // from the wall
        if (apart > 0.0f && !isInSolid(goal))
            return fmt::format(
                ", or nearer to one than its body can come: {:.2f} m from it, with a radius of {:.2f} m and "
                "a `goal_tolerance` of {:.2f} m",
                apart, thicknessOf(person), formation.goal_tolerance);
        return "";
    }

    bool isInSolid(glm::vec2 point) const {
        return std::any_of(geometry_.solids.begin(), geometry_.solids.end(),
                           [&](const LocalPolygon& solid) { return insidePolygon(solid, point); });
    }

    /// What is wrong with people of a formation, once for all of them.
    struct Complaint {
        std::string what, hint, detail;
        Severity severity = Severity::error;
        std::uint64_t first = 0, count = 0;
        const Waypoint* waypoint = nullptr;  // that it is about
    };

    void complain(std::uint64_t i, const std::string& what, const std::string& hint,
                  const std::string& detail = "", Severity severity = Severity::error,
                  const Waypoint* waypoint = nullptr) {
        const auto known = std::find_if(complaints_.begin(), complaints_.end(),
                                        [&](const Complaint& complaint) { return complaint.what == what; });
        if (known == complaints_.end())
            complaints_.push_back({what, hint, detail, severity, i, 1, waypoint});
        else
            ++known->count;
    }

    void reportComplaints(const Formation& formation) {
        const auto* list = std::get_if<ListFormation>(&formation.shape);
        for (const Complaint& complaint : complaints_) {
            const SourcePosition& where = complaint.waypoint ? complaint.waypoint->where
                                          : list             ? list->agents[complaint.first].where
                                                             : formation.where;
            std::string text = fmt::format("formation `{}`: person {} {}{}", formation.id, complaint.first,
                                           complaint.what, complaint.detail);
            if (complaint.count > 1)
                text += fmt::format(", and {} more of the formation likewise", complaint.count - 1);
            if (complaint.severity == Severity::error)
                diagnostics_.error(where, text, complaint.hint);
            else
                diagnostics_.warning(where, text, complaint.hint);
        }
        complaints_.clear();
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
    PlacedBodies bodies_;
    std::vector<Complaint> complaints_;  // about the formation at hand
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
