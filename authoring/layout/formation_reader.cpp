// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/formation_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "authoring/layout/goal_reader.h"
#include "authoring/layout/people_reader.h"

namespace throng::authoring {
namespace {

enum class Shape { circle, grid, agents };

}  // namespace

void FormationReader::read(const JsonNode& node) {
    Formation formation;
    formation.where = node.where;
    ObjectReader reader(node, schema_.definition("formation"), "a formation", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "its name in the account", formation.id);
    reader.require("type", "circle, grid or agents");
    std::optional<Shape> type;
    reader.choice("type", {{"circle", Shape::circle}, {"grid", Shape::grid}, {"agents", Shape::agents}},
                  type);
    formation.behaviour = behaviours_.behaviourOf(reader, node, {"goal", "wait", "arrival"});
    const bool behaves = node.find("behaviour") != nullptr || sits(node, "goal");
    if (sits(node, "goal") && type == Shape::grid)
        formation.behaviour =
            seatsFor(behaviours_, reader, node, "goal", {"arrival"}, formation.id, diagnostics_);
    if (type == Shape::circle) formation.shape = readCircle(reader);
    if (type == Shape::grid) formation.shape = readGrid(reader, behaves);
    reader.number("start", formation.start);
    if (type == Shape::agents) formation.shape = readList(reader, behaves, formation.start);
    formation.wait = readDistribution(reader, "wait", formation.wait, diagnostics_);
    formation.people = readPeople(reader, diagnostics_);
    readArrival(reader, formation.arrival);
    reader.number("goal_tolerance", formation.goal_tolerance);
    formation.level = levels_.levelOf(reader);
    if (type) reader.finish();
    claimId(node, formation.id, groups_, std::string::npos, "a flow or formation", diagnostics_);
    layout_.formations.push_back(std::move(formation));
}

CircleFormation FormationReader::readCircle(ObjectReader& reader) {
    CircleFormation circle;
    reader.point("centre", "the middle, [x, y] in metres", circle.centre);
    reader.require("radius", "metres");
    reader.number("radius", circle.radius);
    reader.require("count", "people");
    reader.integer("count", circle.count);
    reader.number("ring_spacing", circle.ring_spacing);
    reader.number("along", circle.along);
    if ((circle.ring_spacing > 0.0) != (circle.along > 0.0))
        diagnostics_.error(
            reader.where(), "`ring_spacing` and `along` go together",
            "the first is the distance between rings, the second between neighbours on a ring");
    return circle;
}

/// Whether an object says in any of the ways that there are where a grid goes.
bool FormationReader::isGoal(const JsonNode& goal) {
    const std::vector<std::string> ways = {"offset", "mirror", "anywhere", "nearest", "choose"};
    if (std::ranges::any_of(ways, [&](const std::string& way) { return goal.find(way) != nullptr; }))
        return true;
    if (goal.members.empty())
        diagnostics_.error(goal.where, fmt::format("`goal` needs one of {}", fmt::join(ways, ", ")),
                           R"(for example {"offset": [10, 0]})");
    for (const JsonNode::Member& member : goal.members)
        diagnostics_.error(member.key_where, fmt::format("`goal` has no key `{}`", member.key),
                           hintFor(member.key, ways));
    return false;
}

/// @param behaves a behaviour says where its people go
GridFormation FormationReader::readGrid(ObjectReader& reader, bool behaves) {
    GridFormation grid;
    reader.point("origin", "the first person, [x, y] in metres", grid.origin);
    reader.require("rows", "people along the grid's +Y");
    reader.integer("rows", grid.rows);
    reader.require("columns", "people along the grid's +X");
    reader.integer("columns", grid.columns);
    reader.number("spacing", grid.spacing);
    reader.integer("count", grid.count);
    if (grid.count > grid.rows * grid.columns)
        diagnostics_.error(reader.where(), fmt::format("`count` ({}) is more than {} rows of {} hold",
                                                       grid.count, grid.rows, grid.columns));
    reader.number("jitter", grid.jitter);
    reader.number("rotation", grid.rotation);
    constexpr const char* kMeaning = "{\"offset\": [dx, dy]} or a place";
    const JsonNode* goal = behaves ? reader.get("goal") : reader.require("goal", kMeaning);
    if (!goal || behaves) return grid;
    if (goal->kind != JsonNode::Kind::object || goal->find("nearest") || goal->find("choose")) {
        if (auto destination = places_.destination(*goal)) grid.goal = std::move(*destination);
        return grid;
    }
    if (!isGoal(*goal)) return grid;
    ObjectReader inner(*goal, reader.rule("goal"), "`goal`", diagnostics_);
    if (goal->find("mirror")) {
        if (const auto line = lineOf(inner, "mirror", *goal, diagnostics_)) grid.goal = *line;
    } else if (const JsonNode* box = goal->find("anywhere")) {
        const std::vector<glm::dvec2> corners = inner.points("anywhere");
        if (corners.size() == 2)
            grid.goal = Extent{corners[0], corners[1]};
        else if (corners.size() > 2)
            diagnostics_.error(box->where, "`anywhere` is a box: two opposite corners");
    } else {
        glm::dvec2 offset(0.0);
        inner.point("offset", "added to everybody's position, [dx, dy] in metres", offset);
        grid.goal = offset;
    }
    inner.finish();
    return grid;
}

/// @param behaves a behaviour says where its people go
/// @param start s: of those who name none
ListFormation FormationReader::readList(ObjectReader& reader, bool behaves, double start) {
    ListFormation list;
    reader.require("agents", "an array of people");
    const SchemaRule rule = reader.rule("agents").item();
    eachOf(reader, "agents", [&](const JsonNode& node) {
        ListedAgent agent;
        agent.where = node.where;
        ObjectReader inner(node, rule, "a person", diagnostics_);
        if (!inner.isObject()) return;
        inner.point("position", "[x, y] in metres", agent.position);
        agent.goal = agent.position;
        readGoal(inner, node, behaves, agent);
        if (behaves) behaviours_.refuseBeside(node, {"goal", "via", "wait"});
        readVia(inner, agent);
        agent.start = start;
        inner.number("start", agent.start);
        inner.number("wait", agent.wait);
        inner.number("speed", agent.speed);
        inner.number("radius", agent.radius);
        inner.number("heading", agent.heading);
        inner.finish();
        list.agents.push_back(agent);
    });
    // Rows of people come in one after the other.
    std::ranges::stable_sort(list.agents, {}, &ListedAgent::start);
    return list;
}

/// A point, or what flows may go to.
void FormationReader::readGoal(ObjectReader& reader, const JsonNode& node, bool behaves, ListedAgent& agent) {
    const JsonNode* goal = node.find("goal");
    if (goal && (goal->kind == JsonNode::Kind::text || goal->kind == JsonNode::Kind::object)) {
        reader.get("goal");
        agent.to = places_.destination(*goal);
    } else if (goal || !behaves) {
        reader.point("goal", "[x, y] in metres, or a place", agent.goal);
    }
}

void FormationReader::readVia(ObjectReader& reader, ListedAgent& agent) {
    const SchemaRule rule = reader.rule("via").item();
    eachOf(reader, "via", [&](const JsonNode& node) {
        Waypoint waypoint;
        waypoint.where = node.where;
        ObjectReader inner(node, rule, "a place on the way", diagnostics_);
        if (!inner.isObject()) return;
        inner.point("point", "[x, y] in metres", waypoint.point);
        inner.number("wait", waypoint.wait);
        inner.finish();
        agent.via.push_back(waypoint);
    });
}

}  // namespace throng::authoring
