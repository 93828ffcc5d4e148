// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/plan.h"

#include <algorithm>
#include <iterator>
#include <variant>

namespace throng::authoring {
namespace {

Behaviour chained(std::string id, std::vector<BehaviourState> states, const SourcePosition& where) {
    for (std::size_t i = 0; i + 1 < states.size(); ++i)
        states[i].then = i + 1;
    return {std::move(id), std::move(states), 0, where};
}

double timeOf(const Transition& turn) {
    return turn.conditions.front().time.mean;
}

/// Every state leads to those that events bring; who has none yet begins without one.
void addEvents(const Layout& layout, Behaviour& plan) {
    std::vector<Transition> turns;
    if (plan.states.empty()) plan.states.emplace_back();  // stays where it is
    const std::size_t before = plan.states.size();
    for (const Event& event : layout.events) {
        if (!sends(event, plan.id)) continue;
        Condition condition;
        condition.kind = Condition::Kind::at;
        condition.time = {Distribution::Kind::constant, event.at, 0.0, event.at, event.at};
        condition.where = event.where;
        turns.push_back({{condition}, plan.states.size()});
        plan.states.push_back(event.then);
        plan.states.back().where = event.where.line ? event.where : plan.where;
    }
    for (std::size_t i = 0; i < before; ++i)
        plan.states[i].until = turns;
    // Later events find those whom earlier ones have sent.
    for (std::size_t i = before; i < plan.states.size(); ++i)
        std::ranges::copy_if(turns, std::back_inserter(plan.states[i].until), [&](const Transition& turn) {
            return timeOf(turn) > timeOf(turns[i - before]);
        });
}

}  // namespace

BehaviourState goalState(const Destination& to, Arrival arrival) {
    BehaviourState state;
    state.does = BehaviourState::Does::walk;
    state.to = to;
    state.where = to.where;
    state.for_good = arrival == Arrival::stay;
    return state;
}

bool sends(const Event& event, const std::string& group_id) {
    return event.kind == Event::Kind::go_to &&
           (event.who.empty() || std::ranges::find(event.who, group_id) != event.who.end());
}

Behaviour planOf(const Layout& layout, const Flow& flow) {
    std::vector<BehaviourState> states = flow.via;
    if (!flow.behaviour) states.push_back(goalState(flow.to, flow.boards ? Arrival::leave : flow.arrival));
    Behaviour plan = chained(flow.id, std::move(states), flow.where);
    addEvents(layout, plan);
    return plan;
}

Behaviour planOf(const Layout& layout, const Formation& formation) {
    std::vector<BehaviourState> states;
    const auto* grid = std::get_if<GridFormation>(&formation.shape);
    if (const auto* to = grid ? std::get_if<Destination>(&grid->goal) : nullptr)
        states.push_back(goalState(*to, formation.arrival));
    Behaviour plan = chained(formation.id, std::move(states), formation.where);
    addEvents(layout, plan);
    return plan;
}

std::vector<BehaviourState> wayFrom(const Behaviour& plan, std::size_t state) {
    std::vector<BehaviourState> way = {plan.states.at(state)};
    while (way.back().then && way.size() < plan.states.size())
        way.push_back(plan.states.at(*way.back().then));
    return way;
}

std::vector<Turn> turnsOf(const Behaviour& plan) {
    std::vector<Turn> turns;
    for (const Transition& transition : plan.states.at(plan.start).until)
        turns.push_back({timeOf(transition), transition.then});
    return turns;
}

}  // namespace throng::authoring
