// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/behaviours.h"

#include <fmt/format.h>

#include <algorithm>

#include "authoring/scene/itineraries.h"
#include "authoring/scene/raster.h"
#include "authoring/scene/standing.h"
#include "authoring/scene/traffic.h"

namespace throng::authoring {
namespace {

using Does = BehaviourState::Does;
using Kind = Condition::Kind;

constexpr std::uint32_t kSpots = 256;  // of a place

gpu::Drawn drawnOf(const Distribution& distribution) {
    return {static_cast<gpu::uint>(distribution.kind), static_cast<float>(distribution.mean),
            static_cast<float>(distribution.standard_deviation), static_cast<float>(distribution.minimum),
            static_cast<float>(distribution.maximum)};
}

const gpu::Drawn kWhile{0, gpu::DWELL_WHILE, 0.0f, 0.0f, 0.0f};
constexpr gpu::Drawn kNothing{0, 0.0f, 0.0f, 0.0f, 0.0f};

gpu::Drawn stayOf(const BehaviourState& state) {
    if (state.lasts) return drawnOf(*state.lasts);
    if (state.for_good) return {0, gpu::DWELL_FOR_GOOD, 0.0f, 0.0f, 0.0f};
    return state.does == Does::wander || state.does == Does::walk ? kNothing : kWhile;
}

}  // namespace

BehaviourTables::BehaviourTables(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry,
                                 Routes& routes, Itineraries& itineraries, Diagnostics& diagnostics,
                                 Scene& scene)
    : layout_(layout),
      rebase_(rebase),
      geometry_(geometry),
      routes_(routes),
      itineraries_(itineraries),
      diagnostics_(diagnostics),
      scene_(scene) {}

std::vector<Destination> BehaviourTables::destinationsOf(const BehaviourState& state) {
    if (state.does == Does::flee) return {};
    if (state.does == Does::walk && state.to.kind == Destination::Kind::nearest) return {state.to};
    std::vector<Destination> each;
    for (const Place& place : state.to.places)
        each.push_back({Destination::Kind::one, {place}, {}, place.where});
    return each;
}

std::uint32_t BehaviourTables::add(const Behaviour& behaviour, const Owner& owner) {
    Behaviours& tables = scene_.behaviours;
    const auto first = static_cast<std::uint32_t>(tables.states.size());
    tables.states.resize(first + behaviour.states.size());
    for (std::size_t i = 0; i < behaviour.states.size(); ++i) {
        const BehaviourState& state = behaviour.states[i];
        gpu::BehaviourState result{};
        result.does = static_cast<gpu::uint>(state.does);
        result.then = state.then ? first + static_cast<std::uint32_t>(*state.then) : gpu::NO_INDEX;
        result.activity = static_cast<gpu::uint>(state.activity);
        result.least = static_cast<gpu::uint>(state.least);
        result.most = static_cast<gpu::uint>(state.most);
        result.distance = static_cast<float>(state.distance);
        result.pace = static_cast<float>(state.pace);
        result.lasts = stayOf(state);
        if (state.does == Does::walk && !state.then) result.flags |= gpu::STATE_LEAVES;
        if (state.for_good) result.flags |= gpu::STATE_FOR_GOOD;
        if (state.facing) {
            result.flags |= gpu::STATE_FACES;
            result.facing = rebase_.local(*state.facing);
        }
        addPlaces(state, owner, result);
        if (state.does == Does::flee && state.followed.id.empty())
            result.from = state.to.places.empty()
                              ? rebase_.local(state.from)
                              : middleOf(routes_.outline(state.to.places.front(), Routes::kTargetDepth));
        if (!state.followed.id.empty()) {
            const gpu::SpawnQueue rows = rowsOf(state.followed.id);
            result.first_row = rows.first_row;
            result.row_count = rows.row_count;
            if (state.person) {
                result.first_row += std::min(static_cast<std::uint32_t>(*state.person), rows.row_count);
                result.row_count = std::min(1u, rows.first_row + rows.row_count - result.first_row);
            }
        }
        if (state.does == Does::queue) addLine(state, owner, result);
        addRules(state, owner, first, result);
        tables.states[first + i] = result;
    }
    return first + static_cast<std::uint32_t>(behaviour.start);
}

/// Everybody of the flow or formation may stand in it at once.
void BehaviourTables::addLine(const BehaviourState& state, const Owner& owner, gpu::BehaviourState& result) {
    const Place& place = state.to.places.front();
    const LocalPolygon area = routes_.outline(place, Routes::kTargetDepth);
    for (const glm::dvec2 point : state.line)
        if (!insidePolygon(area, rebase_.local(point)))
            diagnostics_.error(state.where,
                               fmt::format("the line at `{}` leaves its area at [{:.6g}, {:.6g}]",
                                           routes_.name(place), point.x, point.y),
                               "the whole line has to lie in the area of its queue");
    result.line = itineraries_.lineFor(state.line, state.spacing);
    const std::uint32_t count = scene_.queues[owner.group].row_count;
    scene_.lines[result.line].ticket_count += count;
    scene_.ticket_count += count;
    gpu::BehaviourPlace& there = scene_.behaviours.places[result.first_place];
    there.middle = there.facing = rebase_.local(state.line.front());
}

void BehaviourTables::addPlaces(const BehaviourState& state, const Owner& owner,
                                gpu::BehaviourState& result) {
    Behaviours& tables = scene_.behaviours;
    result.first_place = static_cast<std::uint32_t>(tables.places.size());
    const bool spots = state.does == Does::wander || state.does == Does::visit || state.does == Does::gather;
    const std::vector<Destination> each = destinationsOf(state);
    for (std::size_t i = 0; i < each.size(); ++i) {
        gpu::BehaviourPlace place = placeOf(each[i], each[i].places.front(), owner, spots);
        place.weight = state.to.weights.empty() ? 1.0f : static_cast<float>(state.to.weights[i]);
        tables.places.push_back(place);
    }
    result.place_count = static_cast<std::uint32_t>(each.size());
    if (state.to.kind == Destination::Kind::nearest) result.flags |= gpu::STATE_NEAREST;
}

gpu::BehaviourPlace BehaviourTables::placeOf(const Destination& to, const Place& place, const Owner& owner,
                                             bool spots) {
    gpu::BehaviourPlace result{};
    const LocalPolygon outline = routes_.outline(place, Routes::kTargetDepth);
    result.middle = result.facing = middleOf(outline);
    if (place.kind == Place::Kind::area && layout_.areas[place.index].facing)
        result.facing = rebase_.local(*layout_.areas[place.index].facing);
    result.field = to.kind == Destination::Kind::nearest ? routes_.fieldTo(to.places, owner.keep_to_roads)
                                                         : routes_.fieldTo(place, owner.keep_to_roads);
    const Outline corners = outlineOf(place);
    result.first_corner = corners.first;
    result.corner_count = corners.count;
    checkWay(to, place, result.field, owner);
    if (spots) spotsFor(result, outline, owner);
    return result;
}

void BehaviourTables::checkWay(const Destination& to, const Place& place, std::uint32_t field,
                               const Owner& owner) {
    for (const LocalPolygon& outline : owner.from) {
        if (routes_.reachable(field, outline) != kUnreachable) continue;
        diagnostics_.error(
            to.where.line ? to.where : place.where,
            fmt::format("{}: nobody can walk from {} to `{}`", owner.name, owner.start, routes_.name(place)),
            "look for walls across the way, doors narrower than a body, and one-way roads "
            "that point the other way");
        return;
    }
}

/// Clear of walls, and with room for a ring of those who walk together.
void BehaviourTables::spotsFor(gpu::BehaviourPlace& place, const LocalPolygon& outline, const Owner& owner) {
    float largest = 0.2f;
    bool together = false;
    const gpu::SpawnQueue& rows = scene_.queues[owner.group];
    for (std::uint32_t row = rows.first_row; row < rows.first_row + rows.row_count; ++row) {
        largest = std::max(largest, scene_.people[row].radius);
        together = together || scene_.people[row].party_size > 1;
    }
    const float beyond = together ? kCircle : kStandClearance;
    Itineraries::Spread spread(outline, geometry_, largest + beyond, beyond);
    place.first_point = static_cast<std::uint32_t>(scene_.behaviours.points.size());
    for (std::uint32_t i = 0; i < kSpots; ++i) {
        const std::optional<glm::vec2> point = spread.next();
        if (!point) break;
        if (routes_.reachable(place.field, *point) < kUnreachable) scene_.behaviours.points.push_back(*point);
    }
    place.point_count = static_cast<std::uint32_t>(scene_.behaviours.points.size()) - place.first_point;
    if (place.point_count > 0) return;
    scene_.behaviours.points.push_back(place.middle);
    place.point_count = 1;
}

BehaviourTables::Outline BehaviourTables::outlineOf(const Place& place) {
    const auto [entry, is_new] = outlines_.try_emplace(routes_.name(place));
    if (is_new) {
        std::vector<glm::vec2>& points = scene_.behaviours.points;
        const LocalPolygon outline = routes_.outline(place, Routes::kTargetDepth);
        entry->second = {static_cast<std::uint32_t>(points.size()),
                         static_cast<std::uint32_t>(outline.size())};
        points.insert(points.end(), outline.begin(), outline.end());
    }
    return entry->second;
}

gpu::SpawnQueue BehaviourTables::rowsOf(const std::string& group) const {
    for (std::size_t i = 0; i < scene_.groups.size(); ++i)
        if (scene_.groups[i].id == group) return scene_.queues[i];
    return {0, 0};
}

std::uint32_t BehaviourTables::censusOf(const Place& place, gpu::SpawnQueue rows) {
    const Outline outline = outlineOf(place);
    std::vector<gpu::Census>& all = scene_.behaviours.censuses;
    const auto known = std::ranges::find_if(all, [&](const gpu::Census& census) {
        return census.first_corner == outline.first && census.first_row == rows.first_row &&
               census.row_count == rows.row_count;
    });
    if (known != all.end()) return static_cast<std::uint32_t>(known - all.begin());
    all.push_back({outline.first, outline.count, rows.first_row, rows.row_count});
    return static_cast<std::uint32_t>(all.size()) - 1;
}

void BehaviourTables::fillRule(const Condition& condition, const Owner& owner, gpu::BehaviourRule& rule) {
    std::vector<glm::vec2>& points = scene_.behaviours.points;
    switch (condition.kind) {
        case Kind::near_place: {
            const Outline outline = outlineOf(condition.place);
            rule.first = outline.first;
            rule.count = outline.count;
            break;
        }
        case Kind::near_people: {
            const gpu::SpawnQueue rows = rowsOf(condition.who.front().id);
            rule.first = rows.first_row;
            rule.count = rows.row_count;
            break;
        }
        case Kind::all_here:
            rule.subject = censusOf(condition.place, scene_.queues[owner.group]);
            break;
        case Kind::open:
        case Kind::closed: {
            const Wall& wall = layout_.walls[condition.wall];
            rule.subject = wall.open_at_start ? 1 : 0;
            rule.first = static_cast<std::uint32_t>(points.size());
            rule.count = static_cast<std::uint32_t>(wall.toggles.size());
            for (const double at : wall.toggles)
                points.emplace_back(static_cast<float>(at), 0.0f);
            break;
        }
        case Kind::green:
        case Kind::red: {
            const LightPlan plan = lightOf(condition);
            rule.first = static_cast<std::uint32_t>(points.size());
            rule.count = static_cast<std::uint32_t>(plan.green.size());
            rule.number = static_cast<float>(plan.cycle);
            rule.time = {0, static_cast<float>(plan.offset), 0.0f, 0.0f, 0.0f};
            for (const LightPlan::Span& span : plan.green)
                points.emplace_back(static_cast<float>(span.begin), static_cast<float>(span.end));
            break;
        }
        default:
            break;
    }
}

/// The first signal that has it counts, as for those who wait there.
LightPlan BehaviourTables::lightOf(const Condition& condition) const {
    for (const Signal& signal : layout_.traffic.signals)
        if (auto plan = lightPlan(signal, condition.light)) return *plan;
    return {};
}

/// One rule, or of several groups that are not to be somewhere one each.
std::vector<gpu::BehaviourRule> BehaviourTables::rulesOf(const Condition& condition, const Owner& owner) {
    gpu::BehaviourRule rule{};
    rule.condition = static_cast<gpu::uint>(condition.kind);
    rule.then = gpu::NO_INDEX;
    rule.number = static_cast<float>(condition.number);
    rule.time = drawnOf(condition.time);
    if (condition.kind != Kind::empty) {
        fillRule(condition, owner, rule);
        return {rule};
    }
    std::vector<gpu::SpawnQueue> counted;
    for (const GroupName& name : condition.who)
        counted.push_back(rowsOf(name.id));
    if (counted.empty()) counted.push_back({0, static_cast<std::uint32_t>(scene_.people.size())});
    std::vector<gpu::BehaviourRule> rules;
    for (const gpu::SpawnQueue& rows : counted) {
        rule.subject = censusOf(condition.place, rows);
        rules.push_back(rule);
    }
    return rules;
}

void BehaviourTables::addRules(const BehaviourState& state, const Owner& owner, std::uint32_t first_state,
                               gpu::BehaviourState& result) {
    std::vector<gpu::BehaviourRule>& rules = scene_.behaviours.rules;
    result.first_rule = static_cast<std::uint32_t>(rules.size());
    for (const Transition& transition : state.until) {
        for (const Condition& condition : transition.conditions)
            for (const gpu::BehaviourRule& rule : rulesOf(condition, owner))
                rules.push_back(rule);
        rules.back().then = first_state + static_cast<std::uint32_t>(transition.then);
    }
    result.rule_count = static_cast<std::uint32_t>(rules.size()) - result.first_rule;
}

std::uint32_t BehaviourTables::fieldOf(std::uint32_t state) const {
    const gpu::BehaviourState& begun = scene_.behaviours.states[state];
    return begun.place_count > 0 ? scene_.behaviours.places[begun.first_place].field : gpu::NO_INDEX;
}

void BehaviourTables::begin(gpu::Person& person, std::size_t row, std::uint32_t state) {
    const gpu::BehaviourState& begun = scene_.behaviours.states[state];
    gpu::Stage stage{};
    stage.point = stage.facing = person.spawn_position;
    stage.field = fieldOf(state);
    if (stage.field != gpu::NO_INDEX) stage.point = scene_.behaviours.places[begun.first_place].middle;
    stage.tolerance = kPassTolerance;
    stage.dwell = gpu::DWELL_WHILE;
    stage.line = gpu::NO_INDEX;
    stage.activity = gpu::ACTIVITY_STAND;
    if (begun.does == gpu::DOES_SIT) stage.field |= gpu::FIELD_THEN_POINT;
    person.first_stage = static_cast<std::uint32_t>(scene_.stages.size());
    person.stage_count = 2;
    scene_.stages.insert(scene_.stages.end(), 2, stage);
    gpu::Mind mind{};
    mind.state = state;
    mind.place = mind.followed = gpu::NO_INDEX;
    mind.first_stage = person.first_stage;
    mind.next = mind.seat = gpu::NO_INDEX;
    gpu::Mind none{};
    none.state = gpu::NO_INDEX;
    scene_.behaviours.minds.resize(scene_.people.size(), none);
    scene_.behaviours.minds[row] = mind;
}

}  // namespace throng::authoring
