// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/place_formations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "authoring/layout/plan.h"
#include "authoring/scene/formation_complaints.h"
#include "authoring/scene/listed_agents.h"
#include "authoring/scene/people.h"
#include "authoring/scene/placed_bodies.h"
#include "authoring/scene/walls.h"
#include "base/side_by_side.h"

namespace throng::authoring {
namespace {

constexpr float kPauseTolerance = 1.0f;  // m: who is pushed about before setting off does not mind
constexpr std::uint64_t kPauseDraw = 900;

/// Who walks together ends together: no further from the first one's goal than standing side by side
/// takes.
glm::dvec2 goalOf(const Formation& formation, const FormationPlaces& places, std::uint64_t i,
                  std::uint64_t leader) {
    if (i == leader) return places.goals[i];
    const auto* grid = std::get_if<GridFormation>(&formation.shape);
    const bool by_chance = grid && std::holds_alternative<Extent>(grid->goal);
    const std::vector<glm::dvec2>& pattern = by_chance ? places.positions : places.goals;
    const glm::dvec2 offset = pattern[i] - pattern[leader];
    const double most = 0.8 * static_cast<double>(i - leader);
    return places.goals[leader] + offset * std::min(1.0, most / std::max(glm::length(offset), 1.0e-9));
}

gpu::Stage pointStage(glm::vec2 point, float tolerance) {
    gpu::Stage stage{};
    stage.point = stage.facing = point;
    stage.tolerance = tolerance;
    stage.field = stage.line = gpu::NO_INDEX;
    stage.activity = gpu::ACTIVITY_STAND;
    return stage;
}

double wallGap(const Capsule& shape, const gpu::WallSegment& wall) {
    const glm::dvec2 half = 0.5 * glm::dvec2(wall.b - wall.a);
    return segmentsDistance(shape.middle - 0.5 * glm::dvec2(wall.a + wall.b), shape.axis, half) -
           shape.thickness - wall.half_thickness;
}

/// The way of those of a formation who have none of their own.
struct SharedWay {
    Journey journey;
    bool is_there = false;
    bool is_alike = false;  // everybody walks the same stages: these, once somebody has them
    std::uint32_t first_stage = 0, stage_count = 0;
};

class FormationPlacer {
  public:
    FormationPlacer(const Placing& with, const std::vector<gpu::WallSegment>& closed_gates,
                    const CloseStarts& close)
        : with_(with), closed_gates_(closed_gates), close_(close) {
        std::size_t people = 0;
        for (std::size_t i = 0; i < with.layout.formations.size(); ++i)
            people += with.scene.queues[with.layout.flows.size() + i].row_count;
        with.scene.stages.reserve(with.scene.stages.size() + people);  // some have more than one
        with.scene.goals.reserve(with.scene.goals.size() + people);
    }

    void place(const Formation& formation, std::size_t formation_index) {
        const std::size_t index = with_.layout.flows.size() + formation_index;
        const GroupRandom random(with_.layout.simulation.seed, formation.id);
        const Behaviour plan = planOf(with_.layout, formation);
        SharedWay shared = sharedWay(formation, plan);
        const std::uint32_t state = formation.behaviour ? addBehaviour(formation, index, shared.journey) : 0;
        const FormationPlaces places = shared.is_there || formation.behaviour
                                           ? FormationPlaces{}
                                           : formationPlaces(formation, with_.layout.simulation.seed);
        std::uint64_t i = 0;
        forEachRow(with_.scene, index, [&](gpu::Person& person) {
            const Traveller traveller = travellerOf(with_.scene, person, index, i);
            person.first_stage = static_cast<std::uint32_t>(with_.scene.stages.size());
            addPause(formation, i, random, traveller, person);
            if (formation.behaviour)
                with_.behaviours.begin(person, rowOf(with_.scene, person), state);
            else if (shared.is_there || ownDestination(formation, i))
                addJourney(formation, i, random, traveller, shared, person);
            else
                addGoal(formation, i, addWay(formation, i, person),
                        with_.rebase.local(goalOf(formation, places, i, traveller.leader)), person);
            with_.scene.goals.push_back(lastOf(person).point);
            ++i;
        });
        turnAll(formation, index, shared.is_there);
        findRoomForAll(formation, index);
        if (!turnsOf(plan).empty()) changePlans(formation, plan, random, index);
        complaints_.tell(formation, with_.diagnostics);
    }

  private:
    const gpu::Stage& lastOf(const gpu::Person& person) const {
        return with_.scene.stages[person.first_stage + person.stage_count - 1];
    }

    static SharedWay sharedWay(const Formation& formation, const Behaviour& plan) {
        SharedWay shared{{fmt::format("formation `{}`", formation.id), formation.where}};
        shared.is_there = !plan.states.front().to.places.empty();
        if (shared.is_there) shared.journey.stops = wayFrom(plan, plan.start);
        shared.is_alike = shared.is_there && Itineraries::isShared(shared.journey);
        return shared;
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
        with_.scene.stages.push_back(pause);
        ++person.stage_count;
    }

    /// The places on somebody's way. @returns the last of them, or where it begins
    glm::vec2 addWay(const Formation& formation, std::uint64_t i, gpu::Person& person) {
        glm::vec2 from = person.spawn_position;
        for (const Waypoint& waypoint : wayOf(formation, i))
            from = addLeg(formation, i, from, with_.rebase.local(waypoint.point),
                          static_cast<float>(waypoint.wait), &waypoint, person);
        return from;
    }

    /// A goal that is a place: somebody's own, or everybody's.
    void addJourney(const Formation& formation, std::uint64_t i, const GroupRandom& random,
                    const Traveller& traveller, SharedWay& shared, gpu::Person& person) {
        addWay(formation, i, person);
        std::vector<gpu::Stage>& stages = with_.scene.stages;
        if (const Destination* own = ownDestination(formation, i)) {
            shared.journey.stops = {goalState(*own, formation.arrival)};
            person.stage_count += with_.itineraries.appendStages(shared.journey, random, traveller);
        } else if (!shared.is_alike || shared.stage_count == 0) {
            shared.first_stage = static_cast<std::uint32_t>(stages.size());
            shared.stage_count = with_.itineraries.appendStages(shared.journey, random, traveller);
            person.stage_count += shared.stage_count;
        } else if (person.stage_count == 0) {
            person.first_stage = shared.first_stage;
            person.stage_count = shared.stage_count;
        } else {  // after a pause or places of its own
            for (std::uint32_t nth = 0; nth < shared.stage_count; ++nth)
                stages.push_back(gpu::Stage(stages[shared.first_stage + nth]));
            person.stage_count += shared.stage_count;
        }
    }

    /// A goal that is a point.
    void addGoal(const Formation& formation, std::uint64_t i, glm::vec2 from, glm::vec2 goal,
                 gpu::Person& person) {
        const float dwell = formation.arrival == Arrival::stay ? gpu::DWELL_FOR_GOOD : 0.0f;
        addLeg(formation, i, from, goal, dwell, nullptr, person);
        const auto* grid = std::get_if<GridFormation>(&formation.shape);
        if (grid && std::holds_alternative<Extent>(grid->goal))
            with_.scene.stages.back().flags |= gpu::STAGE_ANYWHERE;
    }

    /// @param waypoint null: it is the goal
    glm::vec2 addLeg(const Formation& formation, std::uint64_t i, glm::vec2 from, glm::vec2 to, float dwell,
                     const Waypoint* waypoint, gpu::Person& person) {
        gpu::Stage stage = pointStage(to, static_cast<float>(formation.goal_tolerance));
        stage.dwell = dwell;
        findWay(formation, i, waypoint, person, from, stage);
        with_.scene.stages.push_back(stage);
        ++person.stage_count;
        return to;
    }

    /// By which field somebody goes from one place to that of a stage, where there are walls.
    /// @param waypoint null: it is the goal
    void findWay(const Formation& formation, std::uint64_t i, const Waypoint* waypoint,
                 const gpu::Person& person, glm::vec2 from, gpu::Stage& stage) {
        const glm::vec2 goal = stage.point;
        if (!with_.geometry.hasObstacles()) return;
        if (const auto near = whyUnattainable(formation, person, goal)) {
            complaints_.add(i, waypoint ? "has a place of its way in a wall" : "has its goal in a wall",
                            near->empty() ? "move the goal, or the wall"
                                          : "move the goal, or the wall, or raise `goal_tolerance`",
                            *near, Severity::error, waypoint);
            return;
        }
        // Even where the straight way is clear, others may push somebody round a corner on the way.
        const bool clear = isStraight(with_.geometry, from, goal, person.radius);
        const std::uint32_t field = with_.routes.fieldTo({goal, clear});
        if (field == gpu::NO_INDEX) {
            if (!clear) with_.routes.lackField();
            return;
        }
        if (with_.routes.reachable(field, from) == kUnreachable) {
            if (!clear)
                complaints_.add(i, waypoint ? "cannot reach a place of its way" : "cannot reach its goal",
                                "there is a wall all round one of the two", "", Severity::error, waypoint);
            return;
        }
        stage.field = field | gpu::FIELD_THEN_POINT;
    }

    /// A goal may be nearer to a wall than a body gets to it, as long as it gets near enough.
    /// @returns nothing for goals that will do; no words where a goal is in the wall itself
    std::optional<std::string> whyUnattainable(const Formation& formation, const gpu::Person& person,
                                               glm::vec2 goal) const {
        constexpr float kHair = 1.0e-4f;  // m, of rounding
        const float depth = wallDepth(with_.geometry, goal, thicknessOf(person));
        if (depth <= static_cast<float>(formation.goal_tolerance) + kHair &&
            wallDepth(with_.geometry, goal, 0.0f) <= 0.0f && !isInSolid(goal))
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
        return std::any_of(with_.geometry.solids.begin(), with_.geometry.solids.end(),
                           [&](const LocalPolygon& solid) { return insidePolygon(solid, point); });
    }

    /// Of who goes to a place: no way leads there.
    bool isCutOff(const Formation& formation, std::uint64_t i, const gpu::Person& person) const {
        const std::span<const Waypoint> way = wayOf(formation, i);
        const glm::vec2 from = way.empty() ? person.spawn_position : with_.rebase.local(way.back().point);
        return with_.routes.reachable(lastOf(person).field & ~gpu::FIELD_THEN_POINT, from) == kUnreachable;
    }

    /// @param share_place that all go to
    void turnAll(const Formation& formation, std::size_t index, bool share_place) {
        const std::span people = rowsOf(with_.scene, index);
        std::vector<std::uint8_t> cut_off(people.size(), 0);
        doSideBySide(people.size(), kPeopleWorthAThread, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                turn(formation, i, *(&lastOf(people[i]) - wayOf(formation, i).size()), people[i]);
                if (!formation.behaviour && (share_place || ownDestination(formation, i)))
                    cut_off[i] = isCutOff(formation, i, people[i]);
            }
        });
        for (std::size_t i = 0; i < people.size(); ++i)
            if (cut_off[i]) complaints_.add(i, "cannot reach its goal", "look for walls all round it");
    }

    void changePlans(const Formation& formation, const Behaviour& plan, const GroupRandom& random,
                     std::size_t index) {
        std::uint64_t i = 0;
        for (gpu::Person& person : rowsOf(with_.scene, index))
            addPlanChanges(with_, plan, formation.people,
                           {{person.spawn_position, person.spawn_position, person.spawn_position}}, random,
                           i++, index, person);
    }

    /// People look where their way leads.
    void turn(const Formation& formation, std::size_t i, const gpu::Stage& stage, gpu::Person& person) const {
        glm::vec2 ahead = wayBetween(with_.scene, person.spawn_position, stage.point);
        if (stage.field != gpu::NO_INDEX && (stage.field & gpu::FIELD_THEN_POINT) != 0)
            if (const glm::vec2 way =
                    with_.routes.directionFrom(stage.field & ~gpu::FIELD_THEN_POINT, person.spawn_position);
                way != glm::vec2(0.0f))
                ahead = way;
        person.heading = ahead == glm::vec2(0.0f) ? 0.0f : std::atan2(ahead.y, ahead.x);
        if (const ListedAgent* agent = listed(formation, i); agent && agent->heading)
            person.heading = static_cast<float>(*agent->heading * 3.14159265358979 / 180.0);
    }

    /// m: how far into walls somebody stands.
    float depthInWalls(const gpu::Person& person) const {
        const Capsule shape = shapeOf(person);
        if (shape.axis == glm::dvec2(0.0))
            return wallDepth(with_.geometry, person.spawn_position, person.radius);
        float depth = -kUnreachable;
        for (const double along : {-1.0, 0.0, 1.0})
            depth = std::max(depth, wallDepth(with_.geometry, glm::vec2(shape.middle + along * shape.axis),
                                              static_cast<float>(shape.thickness)));
        return depth;
    }

    void findRoomForAll(const Formation& formation, std::size_t index) {
        PlacedBodies later;  // who comes in at the same time
        double since = 0.0;
        std::uint64_t i = 0;
        for (gpu::Person& person : rowsOf(with_.scene, index)) {
            const double start = startOf(formation, i);
            if (start != std::exchange(since, start)) later = {};
            findRoom(i++, start, start == 0.0 ? bodies_ : later, person);
        }
    }

    /// @param bodies of those who are there when it comes in
    void findRoom(std::uint64_t i, double start, PlacedBodies& bodies, gpu::Person& person) {
        const std::size_t row = rowOf(with_.scene, person);
        const bool has_room = !close_.toBody(row) || bodies.hasRoom(person);
        checkStart(i, start, person, has_room);
        if (!has_room) return;
        if (start == 0.0) person.flags |= gpu::PERSON_PRESENT_AT_START;
        if (close_.toBody(row)) bodies.add(person);
    }

    void checkStart(std::uint64_t i, double start, const gpu::Person& person, bool has_room) {
        if (const float depth = close_.toWall(rowOf(with_.scene, person)) ? depthInWalls(person) : 0.0f;
            depth > 0.0f)
            complaints_.add(i, "stands in a wall", "move it, or the wall",
                            fmt::format(" ({:.2f} m deep)", depth));
        if (start == 0.0)
            for (const gpu::WallSegment& gate : closed_gates_)
                if (wallGap(shapeOf(person), gate) < 0.0) {
                    complaints_.add(
                        i, fmt::format("stands in the closed gate `{}`", with_.layout.walls[gate.wall].id),
                        "move it, or open the gate at the start");
                    break;
                }
        if (!has_room)
            complaints_.add(
                i,
                "starts where somebody else stands: it comes in once there is room, or is refused in the end",
                "move it, by both bodies' radii or more", "", Severity::warning);
    }

    /// The state in which a formation's people begin.
    std::uint32_t addBehaviour(const Formation& formation, std::size_t index, const Journey& journey) const {
        const glm::vec2 place = with_.scene.people[with_.scene.queues[index].first_row].spawn_position;
        return with_.behaviours.add(
            with_.layout.behaviours[*formation.behaviour],
            {journey.traveller, index, false, "where they stand", {{place, place, place}}});
    }

    Placing with_;
    const std::vector<gpu::WallSegment>& closed_gates_;
    const CloseStarts& close_;
    PlacedBodies bodies_;             // of those there at the start
    FormationComplaints complaints_;  // about the formation at hand
};

}  // namespace

std::vector<Routes::PointGoal> pointGoals(const Layout& layout, const Rebase& rebase,
                                          const WalkGeometry& geometry, const Scene& scene) {
    std::vector<Routes::PointGoal> goals;
    if (!geometry.hasObstacles()) return goals;
    for (std::size_t index = 0; index < layout.formations.size(); ++index) {
        const Formation& formation = layout.formations[index];
        if (formation.behaviour) continue;
        const FormationPlaces places = formationPlaces(formation, layout.simulation.seed);
        if (places.goals.empty()) continue;
        std::uint64_t i = 0;
        forEachRow(scene, layout.flows.size() + index, [&](const gpu::Person& person) {
            const Traveller traveller = travellerOf(scene, person, layout.flows.size() + index, i);
            glm::vec2 from = person.spawn_position;
            const auto goOn = [&](glm::dvec2 to) {
                const glm::vec2 goal = rebase.local(to);
                goals.emplace_back(goal, isStraight(geometry, from, goal, person.radius));
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

void placeFormations(const Placing& with, const std::vector<gpu::WallSegment>& closed_gates,
                     const CloseStarts& close) {
    FormationPlacer placer(with, closed_gates, close);
    for (std::size_t i = 0; i < with.layout.formations.size(); ++i)
        placer.place(with.layout.formations[i], i);
}

}  // namespace throng::authoring
