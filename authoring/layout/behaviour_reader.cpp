// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/behaviour_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "authoring/layout/behaviour_check.h"
#include "authoring/layout/people_reader.h"

namespace throng::authoring {
namespace {

using Does = BehaviourState::Does;
using Kind = Condition::Kind;

struct Verb {
    const char* key;
    Does does;
};
constexpr std::array kVerbs = {
    Verb{"walk_to", Does::walk},  Verb{"stay", Does::stay},     Verb{"wander", Does::wander},
    Verb{"visit", Does::visit},   Verb{"gather", Does::gather}, Verb{"flee", Does::flee},
    Verb{"follow", Does::follow}, Verb{"queue", Does::queue},   Verb{"sit", Does::sit}};

/// Which keys belong to which activities.
struct KeyOf {
    const char* key;
    std::vector<Does> does;
};
const std::vector<KeyOf>& keysOf() {
    static const std::vector<KeyOf> keys = {
        {"count", {Does::visit}},
        {"beyond", {Does::flee}},
        {"distance", {Does::follow}},
        {"person", {Does::follow}},
        {"for", {Does::stay, Does::wander, Does::visit, Does::gather, Does::queue, Does::sit}},
        {"line", {Does::queue}},
        {"spacing", {Does::queue}},
        {"do", {Does::stay, Does::wander, Does::visit, Does::gather, Does::sit}},
        {"facing", {Does::stay, Does::visit, Does::gather, Does::queue}},
        {"for_good", {Does::stay, Does::gather, Does::sit}}};
    return keys;
}

std::optional<std::uint64_t> wholeOf(const JsonNode& node, Limits limits, Diagnostics& diagnostics) {
    const std::optional<double> number = numberOf(node, limits, diagnostics);
    if (number && *number != std::floor(*number)) {
        diagnostics.error(node.where, fmt::format("expected a whole number, found {:.15g}", *number));
        return std::nullopt;
    }
    return number ? std::optional(static_cast<std::uint64_t>(*number)) : std::nullopt;
}

/// Where people are until something happens, or for a time.
bool isStay(Does does) {
    return does == Does::stay || does == Does::gather || does == Does::sit;
}

const char* keyOf(Does does) {
    return std::ranges::find(kVerbs, does, &Verb::does)->key;
}

}  // namespace

void BehaviourReader::read(const JsonNode& node) {
    Behaviour behaviour;
    behaviour.where = node.where;
    const SchemaRule rule = schema_.definition("behaviour");
    ObjectReader reader(node, rule, "a behaviour", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "the name that flows and formations use", behaviour.id);
    const JsonNode* start = reader.require("start", "the state in which people begin");
    const JsonNode* states = reader.require("states", "what people do, by name");
    reader.finish();
    claimId(node, behaviour.id, behaviours_, layout_.behaviours.size(), "a behaviour", diagnostics_);
    if (!states) return;
    if (states->kind != JsonNode::Kind::object || states->members.empty() ||
        states->members.size() > rule.property("states").mostOf("maxProperties")) {
        diagnostics_.error(states->where,
                           fmt::format("expected one to {} states, by name",
                                       rule.property("states").mostOf("maxProperties")),
                           R"(for example {"stroll": {"wander": "square"}})");
        return;
    }
    states_.clear();
    for (const JsonNode::Member& member : states->members) {
        states_.emplace(member.key, behaviour.states.size());
        behaviour.states.emplace_back();
        behaviour.states.back().id = member.key;
        behaviour.states.back().where = member.key_where;
    }
    if (start) behaviour.start = stateNamed(*start).value_or(0);
    for (std::size_t i = 0; i < behaviour.states.size(); ++i) {
        const JsonNode::Member& member = states->members[i];
        readState(*states->find(member.key), rule.property("states").property(member.key),
                  behaviour.states[i]);
    }
    layout_.behaviours.push_back(std::move(behaviour));
}

void BehaviourReader::refuseBeside(const JsonNode& owner, const std::vector<std::string>& keys) const {
    refuseKeys(owner, keys, "`{}` is said twice: the behaviour tells where people go",
               "leave `{}` out, or `behaviour`", diagnostics_);
}

std::optional<std::size_t> BehaviourReader::behaviourOf(ObjectReader& reader, const JsonNode& owner,
                                                        const std::vector<std::string>& instead) const {
    const JsonNode* node = reader.get("behaviour");
    if (!node) return std::nullopt;
    refuseBeside(owner, instead);
    const auto known = behaviours_.find(node->text);
    if (node->kind == JsonNode::Kind::text && known != behaviours_.end()) return known->second;
    diagnostics_.error(
        node->where, fmt::format("there is no behaviour `{}`", node->text),
        behaviours_.empty() ? "list it under `behaviours`" : hintFor(node->text, namesOf(behaviours_)));
    return std::nullopt;
}

std::optional<std::size_t> BehaviourReader::stateNamed(const JsonNode& node) {
    const auto found = states_.find(node.text);
    if (node.kind == JsonNode::Kind::text && found != states_.end()) return found->second;
    diagnostics_.error(node.where,
                       node.kind == JsonNode::Kind::text
                           ? fmt::format("there is no state `{}`", node.text)
                           : fmt::format("expected the name of a state, found {}", node.kindName()),
                       hintFor(node.text, namesOf(states_)));
    return std::nullopt;
}

void BehaviourReader::readState(const JsonNode& node, SchemaRule rule, State& state) {
    ObjectReader reader(node, rule, fmt::format("the state `{}`", state.id), diagnostics_);
    if (!reader.isObject()) return;
    for (const KeyOf& each : keysOf())
        reader.get(each.key);  // checkKeys() tells of those that are out of place
    const JsonNode* what = nullptr;
    const std::optional<Does> does = activityOf(reader, node, what);
    if (does) {
        state.does = *does;
        readActivity(reader, *what, state);
        if (*does == Does::stay) checkIsTrue(node, "stay");
    }
    readManner(reader, state);
    readExits(reader, node, state);
    reader.finish();
    if (does) checkKeys(node, state);
}

std::optional<Does> BehaviourReader::activityOf(ObjectReader& reader, const JsonNode& node,
                                                const JsonNode*& what) {
    std::optional<Does> does;
    int found = 0;
    std::vector<std::string> keys;
    for (const Verb& verb : kVerbs) {
        keys.emplace_back(verb.key);
        const JsonNode* key = reader.get(verb.key);
        if (!key) continue;
        ++found;
        what = key;
        does = verb.does;
    }
    if (found == 1) return does;
    diagnostics_.error(node.where,
                       fmt::format("a state needs exactly one of {}, this one has {}", fmt::join(keys, ", "),
                                   found == 0 ? "none" : "several"),
                       R"(for example {"wander": "square"})");
    return std::nullopt;
}

void BehaviourReader::readActivity(ObjectReader& reader, const JsonNode& what, State& state) {
    switch (state.does) {
        case Does::walk:
        case Does::gather:
            if (auto to = places_.destination(what)) state.to = std::move(*to);
            break;
        case Does::wander:
            if (const auto place = places_.place(what)) state.to = {Destination::Kind::one, {*place}, {}, {}};
            break;
        case Does::visit:
            readVisits(reader, what, state);
            break;
        case Does::queue:
            readQueue(reader, what, state);
            break;
        case Does::flee:
            readFlight(reader, what, state);
            break;
        case Does::follow:
            readFollowing(reader, what, state);
            break;
        case Does::sit:
            readSeats(what, state.blocks);
            break;
        case Does::stay:
            break;
    }
    if (!state.to.places.empty()) state.to.where = what.where;
}

void BehaviourReader::readSeats(const JsonNode& what, std::vector<GroupName>& blocks) {
    const std::vector<JsonNode> one = {what};
    for (const JsonNode& item : what.kind == JsonNode::Kind::array ? what.items : one)
        if (item.kind == JsonNode::Kind::text)
            blocks.push_back({item.text, item.where});
        else
            diagnostics_.error(item.where,
                               fmt::format("expected a block of seats, found {}", item.kindName()),
                               R"(for example "south", or ["south", "west"])");
    if (what.kind == JsonNode::Kind::array && what.items.empty())
        diagnostics_.error(what.where, "in which block of seats?", R"(for example ["south", "west"])");
}

std::optional<std::size_t> BehaviourReader::sittingIn(const JsonNode& goal, const std::string& owner) {
    const JsonNode* seats = goal.find("seats");
    if (!seats) return std::nullopt;
    State state;
    state.id = "sit";
    state.does = Does::sit;
    state.activity = ActivityCode::sits;
    state.for_good = true;
    state.where = goal.where;
    ObjectReader reader(goal, schema_.definition("seat_goal"), "a goal", diagnostics_);
    reader.get("seats");
    reader.finish();
    readSeats(*seats, state.blocks);
    layout_.behaviours.push_back({owner, {std::move(state)}, 0, goal.where});
    return layout_.behaviours.size() - 1;
}

void BehaviourReader::readVisits(ObjectReader& reader, const JsonNode& what, State& state) {
    const std::size_t most = reader.rule("visit").mostOf("maxItems");
    if (what.kind != JsonNode::Kind::array || what.items.empty() || what.items.size() > most) {
        diagnostics_.error(what.where, fmt::format("expected a list of one to {} places", most),
                           R"(for example ["stall-1", "stall-2"])");
        return;
    }
    for (const JsonNode& item : what.items)
        if (const auto place = places_.place(item)) state.to.places.push_back(*place);
    state.to.kind = Destination::Kind::choose;
    state.to.weights.assign(state.to.places.size(), 1.0);
    state.least = state.most = what.items.size();
    const JsonNode* count = reader.get("count");
    if (!count) return;
    const SchemaRule rule = reader.rule("count");
    const Limits limits = rule.item().limits();
    const bool is_range = count->kind == JsonNode::Kind::array && count->items.size() == 2;
    const auto least = wholeOf(is_range ? count->items[0] : *count, limits, diagnostics_);
    const auto greatest = wholeOf(is_range ? count->items[1] : *count, limits, diagnostics_);
    if (!least || !greatest) return;
    state.least = *least;
    state.most = *greatest;
    if (state.least > state.most)
        diagnostics_.error(count->where, "the minimum is above the maximum", "swap the two");
    else if (state.most > what.items.size())
        diagnostics_.error(count->where, fmt::format("there are only {} places to visit", what.items.size()),
                           "name more of them, or visit fewer");
}

void BehaviourReader::readQueue(ObjectReader& reader, const JsonNode& what, State& state) {
    if (const auto place = places_.place(what)) state.to = {Destination::Kind::one, {*place}, {}, {}};
    state.activity = ActivityCode::queues;
    reader.number("spacing", state.spacing);
    if (reader.get("line")) {
        state.line = reader.points("line");
        return;
    }
    diagnostics_.error(what.where, "a queue needs the `line` along which people stand, from its front",
                       R"(for example "line": [[0, 0], [6, 0]])");
}

void BehaviourReader::readFlight(ObjectReader& reader, const JsonNode& what, State& state) {
    state.distance = 20.0;
    if (what.kind == JsonNode::Kind::array) {
        reader.point("flee", "what people flee from, [x, y] in metres", state.from);
    } else if (what.kind == JsonNode::Kind::text && !what.text.empty() && !places_.isPlace(what.text)) {
        state.followed = {what.text, what.where};
    } else if (const auto place = places_.place(what)) {
        state.to = {Destination::Kind::one, {*place}, {}, what.where};
    }
    reader.number("beyond", state.distance);
}

void BehaviourReader::readFollowing(ObjectReader& reader, const JsonNode& what, State& state) {
    state.distance = 1.5;
    if (what.kind != JsonNode::Kind::text)
        diagnostics_.error(
            what.where, fmt::format("expected a flow, formation or given people, found {}", what.kindName()),
            "whom do people follow?");
    state.followed = {what.text, what.where};
    reader.number("distance", state.distance);
    if (const JsonNode* person = reader.get("person"))
        state.person = wholeOf(*person, reader.rule("person").limits(), diagnostics_);
}

/// What people do where they are; in a seat they do it there.
void BehaviourReader::readPose(ObjectReader& reader, State& state) {
    using Code = ActivityCode;
    const bool sits = state.does == Does::sit;
    if (sits) state.activity = Code::sits;
    std::optional<Code> told;
    reader.choice("do",
                  {{"stand", Code::stands},
                   {"look", Code::looks},
                   {"sit", Code::sits},
                   {"clap", sits ? Code::claps : Code::applauds},
                   {"cheer", sits ? Code::cheers : Code::jubilates},
                   {"sing", sits ? Code::sings : Code::sways},
                   {"wave", Code::waves}},
                  told);
    if (!told) return;
    state.activity = *told;
    const JsonNode& where = *reader.get("do");
    if (*told == Code::sits && !sits)
        diagnostics_.error(where.where, "there is nothing to sit on here",
                           R"(write "sit": the id of a block of seats; a bench is a block of one row)");
    if (sits && (*told == Code::stands || *told == Code::looks || *told == Code::waves))
        diagnostics_.error(where.where, fmt::format("who sits does not {}", where.text),
                           "in seats people sit, clap, cheer or sing");
}

void BehaviourReader::readManner(ObjectReader& reader, State& state) {
    if (state.does == Does::visit) state.activity = ActivityCode::looks;
    readPose(reader, state);
    reader.point("facing", state.facing);
    reader.number("pace", state.pace);
    reader.boolean("for_good", state.for_good);
    if (reader.get("for")) state.lasts = readDistribution(reader, "for", {}, diagnostics_);
}

void BehaviourReader::readExits(ObjectReader& reader, const JsonNode& node, State& state) {
    if (const JsonNode* then = reader.get("then")) state.then = stateNamed(*then);
    const JsonNode* until = reader.get("until");
    if (until && (until->kind != JsonNode::Kind::array || until->items.empty()))
        diagnostics_.error(until->where, "expected a list of what ends the state, and what comes then",
                           R"(for example [{"after": 10, "then": "leave"}])");
    else if (until)
        for (const JsonNode& item : until->items)
            readTransition(item, reader.rule("until").item(), state);
    if (state.for_good && (node.find("then") || until))
        diagnostics_.error(node.find("for_good")->where, "who stays for good does not go on",
                           "leave out `for_good`, or `then` and `until`");
}

Condition* BehaviourReader::addCondition(ObjectReader& reader, const char* key, Condition::Kind kind,
                                         Transition& transition) {
    const JsonNode* found = reader.get(key);
    if (!found) return nullptr;
    transition.conditions.emplace_back();
    transition.conditions.back().kind = kind;
    transition.conditions.back().where = found->where;
    return &transition.conditions.back();
}

/// A new condition is a key here, a kind in authoring/behaviour.h, and a case of
/// shaders/behaviour/conditions.glsl.
void BehaviourReader::readTransition(const JsonNode& node, SchemaRule rule, State& state) {
    ObjectReader reader(node, rule, "what ends a state", diagnostics_);
    if (!reader.isObject()) return;
    Transition transition;
    for (const auto& [key, kind] : {std::pair{"after", Kind::after}, std::pair{"at", Kind::at}})
        if (Condition* timed = addCondition(reader, key, kind, transition))
            timed->time = readDistribution(reader, key, {}, diagnostics_);
    if (addCondition(reader, "arrived", Kind::arrived, transition)) checkIsTrue(node, "arrived");
    readNearness(reader, node, transition);
    for (const auto& [key, kind] : {std::pair{"crowded", Kind::crowded}, std::pair{"chance", Kind::chance}})
        if (Condition* measured = addCondition(reader, key, kind, transition))
            reader.number(key, measured->number);
    readCounts(reader, node, transition);
    readGates(reader, node, transition);
    readLights(reader, node, transition);
    const JsonNode* then = reader.require("then", "the state that comes then");
    reader.finish();
    if (transition.conditions.empty())
        diagnostics_.error(node.where, "nothing says when this happens",
                           R"(for example "after": 10, or "arrived": true)");
    const auto next = then ? stateNamed(*then) : std::nullopt;
    if (!next || transition.conditions.empty()) return;
    transition.then = *next;
    state.until.push_back(std::move(transition));
}

void BehaviourReader::checkIsTrue(const JsonNode& node, const char* key) {
    const JsonNode* told = node.find(key);
    if (told->kind == JsonNode::Kind::boolean && told->boolean) return;
    diagnostics_.error(told->where, fmt::format("`{}` is true or is left out", key),
                       fmt::format(R"(write "{}": true)", key));
}

void BehaviourReader::readNearness(ObjectReader& reader, const JsonNode& node, Transition& transition) {
    if (Condition* near = addCondition(reader, "near", Condition::Kind::near_place, transition)) {
        near->number = 2.0;
        reader.number("within", near->number);
        readPlaceOrPeople(*node.find("near"), *near);
    } else if (const JsonNode* within = reader.get("within")) {
        diagnostics_.error(within->where, "within so many metres of what?", R"(write "near" beside it)");
    }
}

void BehaviourReader::readCounts(ObjectReader& reader, const JsonNode& node, Transition& transition) {
    for (const auto& [key, kind] : {std::pair{"empty", Kind::empty}, std::pair{"all_here", Kind::all_here}})
        if (Condition* counted = addCondition(reader, key, kind, transition))
            if (const auto place = places_.place(*node.find(key))) counted->place = *place;
    const JsonNode* who = reader.get("of");
    if (!who) return;
    const auto empty = std::ranges::find(transition.conditions, Kind::empty, &Condition::kind);
    if (empty == transition.conditions.end())
        diagnostics_.error(who->where, "empty of whom, but where?", R"(write "empty" beside it)");
    else
        readWho(*who, *empty);
}

void BehaviourReader::readGates(ObjectReader& reader, const JsonNode& node, Transition& transition) {
    for (const auto& [key, kind] : {std::pair{"open", Kind::open}, std::pair{"closed", Kind::closed}}) {
        Condition* gate = addCondition(reader, key, kind, transition);
        if (!gate) continue;
        const std::string& id = node.find(key)->text;
        const auto wall = walls_.find(id);
        if (wall != walls_.end()) {
            gate->wall = wall->second;
            continue;
        }
        gate->kind = Kind::arrived;  // so that nobody looks for the wall
        diagnostics_.error(gate->where, fmt::format("there is no wall `{}`", id),
                           hintFor(id, namesOf(walls_)));
    }
}

void BehaviourReader::readLights(ObjectReader& reader, const JsonNode& node, Transition& transition) {
    for (const auto& [key, kind] : {std::pair{"green", Kind::green}, std::pair{"red", Kind::red}}) {
        Condition* light = addCondition(reader, key, kind, transition);
        if (!light) continue;
        if (const auto named = traffic_.litBy(*node.find(key)))
            light->light = *named;
        else
            light->kind = Kind::arrived;  // so that nobody looks for it
    }
}

void BehaviourReader::readPlaceOrPeople(const JsonNode& node, Condition& condition) {
    if (node.kind == JsonNode::Kind::text && !places_.isPlace(node.text)) {
        condition.kind = Condition::Kind::near_people;
        condition.who = {{node.text, node.where}};
    } else if (const auto place = places_.place(node)) {
        condition.place = *place;
    }
}

void BehaviourReader::readWho(const JsonNode& list, Condition& condition) {
    const std::vector<JsonNode> one = {list};
    const std::vector<JsonNode>& items = list.kind == JsonNode::Kind::array ? list.items : one;
    for (const JsonNode& item : items) {
        if (item.kind == JsonNode::Kind::text)
            condition.who.push_back({item.text, item.where});
        else
            diagnostics_.error(item.where,
                               fmt::format("expected a flow or formation, found {}", item.kindName()));
    }
}

/// What a state cannot do with what it says.
void BehaviourReader::checkKeys(const JsonNode& node, const State& state) {
    for (const KeyOf& each : keysOf()) {
        const JsonNode* key = node.find(each.key);
        if (!key || std::ranges::find(each.does, state.does) != each.does.end()) continue;
        std::vector<std::string> verbs;
        for (const Does does : each.does)
            verbs.emplace_back(keyOf(does));
        diagnostics_.error(key->where,
                           fmt::format("`{}` says nothing beside `{}`", each.key, keyOf(state.does)),
                           fmt::format("it belongs to {}", fmt::join(verbs, ", ")));
    }
    const bool never_done =
        state.does == Does::wander || state.does == Does::follow || (isStay(state.does) && !state.lasts);
    if (state.then && never_done)
        diagnostics_.error(node.find("then")->where,
                           fmt::format("`{}` is never done: `then` would never come", keyOf(state.does)),
                           isStay(state.does) ? R"(say how long under "for", or what ends it under "until")"
                                              : R"(say what ends it under "until")");
    const bool needs_then =
        state.does == Does::visit || state.does == Does::queue || (state.lasts && isStay(state.does));
    if (!node.find("then") && needs_then)
        diagnostics_.error(node.where, fmt::format("what comes after the state `{}`?", state.id),
                           R"(write "then": the name of a state)");
    if (state.does == Does::visit && !state.lasts)
        diagnostics_.error(node.where, "how long do people stay at each place?",
                           R"(write for example "for": {"uniform": [5, 15]})");
    if (state.does == Does::queue && !state.lasts)
        diagnostics_.error(node.where, "how long is one served?",
                           R"(write for example "for": {"uniform": [10, 20]})");
}

void BehaviourReader::checkGroup(const GroupName& name, bool or_place) {
    if (groups_.contains(name.id)) return;
    std::vector<std::string> known = namesOf(groups_);
    if (or_place) std::ranges::copy(places_.names(), std::back_inserter(known));
    diagnostics_.error(
        name.where,
        fmt::format("there is no {}flow, formation or given people `{}`", or_place ? "place, " : "", name.id),
        hintFor(name.id, known));
}

void BehaviourReader::checkGate(const Condition& condition) {
    const Wall& wall = layout_.walls[condition.wall];
    if (!wall.toggles.empty()) return;
    diagnostics_.error(condition.where, fmt::format("wall `{}` never opens or closes", wall.id),
                       R"(let an event open it, for example {"at": 30, "open": "doors"})");
}

void BehaviourReader::checkLight(const Condition& condition) {
    if (std::ranges::any_of(layout_.traffic.signals,
                            [&](const Signal& signal) { return signal.holds(condition.light); }))
        return;
    const std::size_t index = condition.light.index;
    const std::string& id =
        condition.light.is_lane ? layout_.traffic.lanes[index].id : layout_.traffic.crossings[index].id;
    diagnostics_.error(condition.where, fmt::format("no signal has `{}`", id),
                       "name it under `green` in a phase of a signal");
}

void BehaviourReader::checkReferences(const Behaviour& behaviour) {
    for (const State& state : behaviour.states) {
        if (state.does == Does::follow || !state.followed.id.empty())
            checkGroup(state.followed, state.does == Does::flee);
        for (const Transition& transition : state.until)
            for (const Condition& condition : transition.conditions) {
                for (const GroupName& name : condition.who)
                    checkGroup(name, condition.kind == Condition::Kind::near_people);
                if (condition.kind == Condition::Kind::open || condition.kind == Condition::Kind::closed)
                    checkGate(condition);
                if (condition.kind == Condition::Kind::green || condition.kind == Condition::Kind::red)
                    checkLight(condition);
            }
    }
}

/// Everybody has one seat.
void BehaviourReader::checkSeatsOf(const Behaviour& behaviour, Diagnostics& diagnostics) {
    const State* first = nullptr;
    for (const State& state : behaviour.states) {
        if (state.does != Does::sit) continue;
        if (!first) first = &state;
        if (!std::ranges::equal(state.blocks, first->blocks, {}, &GroupName::id, &GroupName::id))
            diagnostics.error(state.where,
                              fmt::format("the states `{}` and `{}` of behaviour `{}` have other seats",
                                          first->id, state.id, behaviour.id),
                              "everybody has one seat: name the same blocks in both");
    }
}

void BehaviourReader::finish() {
    for (const Behaviour& behaviour : layout_.behaviours) {
        checkReferences(behaviour);
        checkSeatsOf(behaviour, diagnostics_);
    }
    if (diagnostics_.hasErrors()) return;
    std::vector<bool> used(layout_.behaviours.size(), false);
    for (const Flow& flow : layout_.flows)
        if (flow.behaviour) used[*flow.behaviour] = true;
    for (const Formation& formation : layout_.formations)
        if (formation.behaviour) used[*formation.behaviour] = true;
    for (const SeatBlock& block : layout_.seats)
        if (block.behaviour) used[*block.behaviour] = true;
    for (std::size_t i = 0; i < layout_.behaviours.size(); ++i) {
        const Behaviour& behaviour = layout_.behaviours[i];
        if (!used[i])
            diagnostics_.warning(behaviour.where, fmt::format("nobody has the behaviour `{}`", behaviour.id),
                                 "name it under `behaviour` of a flow or formation");
        checkBehaviour(behaviour, diagnostics_);
    }
}

}  // namespace throng::authoring
