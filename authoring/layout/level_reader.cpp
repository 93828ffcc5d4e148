// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/level_reader.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "authoring/layout/bent_link.h"
#include "authoring/layout/polygon_check.h"
#include "authoring/link_kinds.h"

namespace throng::authoring {
namespace {

constexpr double kSteepestRamp = 0.25, kSteepestStairs = 1.2;  // rise over run
constexpr double kFlattestStairs = 0.2;
constexpr double kSteepestEscalator = 0.71, kSteepestTravelator = 0.22;  // 35 and 12 degrees: EN 115-1
constexpr double kWidthOfSteps = 1.0;                                    // m: the usual ones

/// Keys that no other link has.
constexpr std::array kOfLifts = {"levels",     "at",        "size",  "doors",   "opposite",
                                 "door_width", "door_time", "dwell", "capacity"};

/// What links of one kind are called, and how they may climb: rise over run.
struct Climb {
    const char* many;
    double flattest, steepest;
};

Climb climbOf(Link::Kind kind) {
    switch (kind) {
        case Link::Kind::stairs:
            return {"stairs", kFlattestStairs, kSteepestStairs};
        case Link::Kind::escalator:
            return {"escalators", kFlattestStairs, kSteepestEscalator};
        case Link::Kind::travelator:
            return {"travelators", 0.0, kSteepestTravelator};
        default:
            return {"ramps", 0.0, kSteepestRamp};
    }
}

}  // namespace

/// Which of the two a level has to have depends on whether there is a terrain (scene/terrain_check.h).
void LevelReader::readLevel(const JsonNode& node) {
    Level level;
    level.where = node.where;
    ObjectReader reader(node, schema_.definition("level"), "a level", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "the name that others use", level.id);
    reader.number("height", level.height);
    const JsonNode* floor = node.find("floor");
    if (floor) level.floor = reader.points("floor");
    if (node.find("at")) {
        level.at.emplace(0.0);
        reader.offset("at", *level.at);
    }
    reader.finish();
    if (floor) checkPolygon(level.floor, floor, diagnostics_);
    claimId(node, level.id, levels_, layout_.levels.size(), "a level", diagnostics_);
    layout_.levels.push_back(std::move(level));
}

std::size_t LevelReader::levelNamed(const JsonNode& node) const {
    if (node.kind != JsonNode::Kind::text) {
        diagnostics_.error(node.where, fmt::format("expected a level's id, found {}", node.kindName()));
        return 0;
    }
    if (const auto known = levels_.find(node.text); known != levels_.end()) return known->second;
    diagnostics_.error(node.where, fmt::format("there is no level `{}`", node.text),
                       levels_.empty() ? "list it under `levels`" : hintFor(node.text, namesOf(levels_)));
    return 0;
}

std::size_t LevelReader::levelOf(ObjectReader& reader) const {
    const JsonNode* node = reader.get("level");
    return node ? levelNamed(*node) : 0;
}

void LevelReader::readLink(const JsonNode& node) {
    Link link;
    link.where = node.where;
    ObjectReader reader(node, schema_.definition("link"), "a link", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "its name", link.id);
    reader.choice("type", {kLinkKinds.begin(), kLinkKinds.end()}, link.kind);
    if (link.isLift()) return readLift(reader, node, std::move(link));
    for (const char* key : kOfLifts)
        if (const JsonNode* given = reader.get(key))
            diagnostics_.error(given->where,
                               fmt::format("`{}` is of lifts, and {} are none", key, climbOf(link.kind).many),
                               R"(write "type": "lift", or leave it out)");
    const JsonNode* from = reader.require("from", "the level at which it begins");
    const JsonNode* to = reader.require("to", "the level at which it ends");
    const std::vector<glm::dvec2> path = reader.points("path");
    reader.number("width", link.width);
    if (link.moves() && !node.find("width")) link.width = kWidthOfSteps;
    readBelt(reader, node, link);
    reader.finish();
    if (from) link.from = levelNamed(*from);
    if (to) link.to = levelNamed(*to);
    claimId(node, link.id, links_, layout_.links.size(), "a link", diagnostics_);
    if (path.size() < 2 || !from || !to || diagnostics_.hasErrors()) return;
    if (path.size() > 2) return addBentLink(link, path, node);
    link.begin = path[0];
    link.end = path[1];
    checkLink(link, glm::distance(link.begin, link.end), node);
    layout_.links.push_back(std::move(link));
}

/// As links and levels of its own.
void LevelReader::addBentLink(const Link& link, const std::vector<glm::dvec2>& path, const JsonNode& node) {
    const double low = layout_.levels[link.from].height, high = layout_.levels[link.to].height;
    std::optional<BentLinkFault> fault;
    BentLink bent = bend(link, path, low, high, riserOf(link), fault);
    if (fault) return diagnostics_.error(node.find("path")->where, fault->message, fault->hint);
    double run = 0.0;
    for (const Link& flight : bent.flights)
        run += glm::distance(flight.begin, flight.end);
    checkLink(link, run, node);
    if (diagnostics_.hasErrors()) return;
    const std::size_t first_landing = layout_.levels.size();
    for (Level& landing : bent.landings) {
        claimId(node, landing.id, levels_, layout_.levels.size(), "a level", diagnostics_);
        layout_.levels.push_back(std::move(landing));
    }
    for (std::size_t i = 0; i < bent.flights.size(); ++i) {
        Link& flight = bent.flights[i];
        if (i > 0) flight.from = first_landing + i - 1;
        if (i < bent.landings.size()) flight.to = first_landing + i;
        claimId(node, flight.id, links_, layout_.links.size(), "a link", diagnostics_);
        // Landings are as high as whole steps make them: of short flights that is much.
        if (!diagnostics_.hasErrors() && !isOnTerrain(link))
            checkLink(flight, glm::distance(flight.begin, flight.end), node);
        layout_.links.push_back(std::move(flight));
    }
}

void LevelReader::readBelt(ObjectReader& reader, const JsonNode& node, Link& link) const {
    reader.number("speed", link.speed);
    reader.number("walking", link.walking);
    reader.choice(
        "stand",
        {{"anywhere", Link::Stand::anywhere}, {"right", Link::Stand::right}, {"left", Link::Stand::left}},
        link.stand);
    if (link.moves()) return;
    for (const char* key : {"speed", "walking", "stand"})
        if (const JsonNode* given = node.find(key))
            diagnostics_.error(
                given->where,
                fmt::format("`{}` is of ground that moves, and {} do not", key, climbOf(link.kind).many),
                R"(write "type": "escalator", or leave it out)");
}

void LevelReader::checkLink(const Link& link, double run, const JsonNode& node) const {
    if (link.from == link.to && link.kind != Link::Kind::travelator) {
        diagnostics_.error(node.find("to")->where,
                           fmt::format("link `{}` begins and ends at the same level", link.id));
        return;
    }
    if (isOnTerrain(link)) return;
    const double rise = std::abs(layout_.levels[link.to].height - layout_.levels[link.from].height);
    checkClimb(link, rise, run, node.find("path")->where, diagnostics_);
}

bool LevelReader::isOnTerrain(const Link& link) const {
    return layout_.levels[link.from].at || layout_.levels[link.to].at;
}

double riserOf(const Link& link) {
    constexpr double kRiser = 0.17;  // m, as treads are
    return link.kind == Link::Kind::stairs ? kRiser : 0.0;
}

void checkClimb(const Link& link, double rise, double run, const SourcePosition& where,
                Diagnostics& diagnostics) {
    const Climb climb = climbOf(link.kind);
    const auto tell = [&](const char* most_or_least, double share, const std::string& hint) {
        diagnostics.error(
            where,
            fmt::format("link `{}` climbs {:.2f} m over {:.2f} m: {} climb {}", link.id, rise, run,
                        climb.many, fmt::format(fmt::runtime(most_or_least), 100.0 * share)),
            hint);
    };
    if (rise > climb.steepest * run)
        tell("at most {:.0f} %", climb.steepest,
             fmt::format("make its `path` {:.1f} m long or more",
                         std::ceil(10.0 * rise / climb.steepest) / 10.0));
    if (rise < climb.flattest * run)
        tell("{:.0f} % or more", climb.flattest,
             fmt::format(R"(make it shorter, or write "type": "{}")", link.moves() ? "travelator" : "ramp"));
}

}  // namespace throng::authoring
