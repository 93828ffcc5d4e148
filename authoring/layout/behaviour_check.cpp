// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/behaviour_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace throng::authoring {
namespace {

using Does = BehaviourState::Does;
using Kind = Condition::Kind;

/// A way from one state to another.
struct Edge {
    std::size_t to = 0;
    std::vector<const Condition*> conditions;
    bool takes_time = false;
};

bool isTimed(const Condition& condition, const BehaviourState& state) {
    switch (condition.kind) {
        case Kind::after:
            return condition.time.kind != Distribution::Kind::constant || condition.time.mean > 0.0;
        case Kind::arrived:
            return state.does != Does::stay;
        case Kind::chance:
            return true;
        default:
            return false;
    }
}

std::vector<Edge> edgesOf(const BehaviourState& state) {
    std::vector<Edge> edges;
    for (const Transition& transition : state.until) {
        Edge edge{transition.then, {}, false};
        for (const Condition& condition : transition.conditions) {
            edge.conditions.push_back(&condition);
            edge.takes_time = edge.takes_time || isTimed(condition, state);
        }
        edges.push_back(std::move(edge));
    }
    if (state.then) edges.push_back({*state.then, {}, state.does != Does::flee});
    return edges;
}

bool isEnd(const BehaviourState& state) {
    return state.for_good || (state.does == Does::walk && !state.then);
}

/// A gate is not open and closed at once, and a signal not green and red.
bool excludeEachOther(const std::vector<const Condition*>& conditions) {
    for (const Condition* one : conditions)
        for (const Condition* other : conditions)
            if ((one->kind == Kind::open && other->kind == Kind::closed && one->wall == other->wall) ||
                (one->kind == Kind::green && other->kind == Kind::red && one->light == other->light))
                return true;
    return false;
}

class Graph {
  public:
    explicit Graph(const Behaviour& behaviour) : behaviour_(behaviour) {
        for (const BehaviourState& state : behaviour.states)
            edges_.push_back(edgesOf(state));
    }

    std::vector<bool> reachable() const {
        std::vector<bool> found(edges_.size(), false);
        std::vector<std::size_t> open = {behaviour_.start};
        found[behaviour_.start] = true;
        while (!open.empty()) {
            const std::size_t at = open.back();
            open.pop_back();
            for (const Edge& edge : edges_[at])
                if (!found[edge.to]) {
                    found[edge.to] = true;
                    open.push_back(edge.to);
                }
        }
        return found;
    }

    /// From which states a way leads to an end.
    std::vector<bool> ending() const {
        std::vector<bool> ends(edges_.size(), false);
        for (bool grows = true; grows;) {
            grows = false;
            for (std::size_t i = 0; i < edges_.size(); ++i) {
                if (ends[i]) continue;
                ends[i] = isEnd(behaviour_.states[i]) ||
                          std::ranges::any_of(edges_[i], [&](const Edge& edge) { return ends[edge.to]; });
                grows = grows || ends[i];
            }
        }
        return ends;
    }

    bool hasExit(std::size_t state) const { return !edges_[state].empty(); }

    /// States that lead back to the first of them at once.
    std::optional<std::vector<std::size_t>> loopWithoutTime() {
        marks_.assign(edges_.size(), Mark::fresh);
        for (std::size_t i = 0; i < edges_.size(); ++i)
            if (marks_[i] == Mark::fresh)
                if (auto loop = search(i)) return loop;
        return std::nullopt;
    }

  private:
    enum class Mark { fresh, on_the_way, done };

    std::optional<std::vector<std::size_t>> search(std::size_t at) {
        marks_[at] = Mark::on_the_way;
        path_.push_back(at);
        for (const Edge& edge : edges_[at]) {
            if (edge.takes_time) continue;
            taken_.push_back(&edge);
            if (marks_[edge.to] == Mark::on_the_way) {
                if (auto loop = loopFrom(edge.to)) return loop;
            } else if (marks_[edge.to] == Mark::fresh) {
                if (auto loop = search(edge.to)) return loop;
            }
            taken_.pop_back();
        }
        path_.pop_back();
        marks_[at] = Mark::done;
        return std::nullopt;
    }

    std::optional<std::vector<std::size_t>> loopFrom(std::size_t first) const {
        const auto begin = std::ranges::find(path_, first);
        std::vector<const Condition*> conditions;
        for (auto edge = taken_.begin() + (begin - path_.begin()); edge != taken_.end(); ++edge)
            conditions.insert(conditions.end(), (*edge)->conditions.begin(), (*edge)->conditions.end());
        if (excludeEachOther(conditions)) return std::nullopt;
        return std::vector(begin, path_.end());
    }

    const Behaviour& behaviour_;
    std::vector<std::vector<Edge>> edges_;
    std::vector<Mark> marks_;
    std::vector<std::size_t> path_;
    std::vector<const Edge*> taken_;  // from each state on the path to the next
};

void tellOfDeadEnds(const Behaviour& behaviour, const Graph& graph, const std::vector<bool>& reached,
                    Diagnostics& diagnostics) {
    bool told = false;
    for (std::size_t i = 0; i < behaviour.states.size(); ++i) {
        const BehaviourState& state = behaviour.states[i];
        if (!reached[i] || isEnd(state) || graph.hasExit(i)) continue;
        told = true;
        diagnostics.warning(
            state.where,
            fmt::format("the state `{}` of behaviour `{}` cannot be left", state.id, behaviour.id),
            state.does == Does::stay || state.does == Does::gather || state.does == Does::sit
                ? R"(say what ends it under "until", or write "for_good": true)"
                : R"(say what ends it under "until")");
    }
    if (told || graph.ending()[behaviour.start]) return;
    diagnostics.warning(
        behaviour.where,
        fmt::format("the behaviour `{}` has no end: its states lead to each other for ever", behaviour.id),
        R"(let one of them lead to a "walk_to" without "then", or to one with "for_good")");
}

}  // namespace

void checkBehaviour(const Behaviour& behaviour, Diagnostics& diagnostics) {
    Graph graph(behaviour);
    const std::vector<bool> reached = graph.reachable();
    for (std::size_t i = 0; i < behaviour.states.size(); ++i)
        if (!reached[i])
            diagnostics.warning(behaviour.states[i].where,
                                fmt::format("nothing leads to the state `{}` of behaviour `{}`",
                                            behaviour.states[i].id, behaviour.id),
                                "name it under `start`, or under `then` of another");
    tellOfDeadEnds(behaviour, graph, reached, diagnostics);
    if (const auto loop = graph.loopWithoutTime()) {
        std::string names;
        for (const std::size_t state : *loop)
            names += fmt::format("`{}`, ", behaviour.states[state].id);
        const BehaviourState& first = behaviour.states[loop->front()];
        diagnostics.warning(
            first.where,
            fmt::format("states of behaviour `{}` may lead round without time: {}and `{}` again",
                        behaviour.id, names, first.id),
            R"(add "after" to one of the conditions, or what excludes the others)");
    }
}

}  // namespace throng::authoring
