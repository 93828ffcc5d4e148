// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/flow_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "authoring/layout/amounts.h"
#include "authoring/layout/goal_reader.h"
#include "authoring/layout/people_reader.h"

namespace throng::authoring {

void FlowReader::read(const JsonNode& node) {
    Flow flow;
    flow.where = node.where;
    flow.end = layout_.simulation.duration;
    ObjectReader reader(node, schema_.definition("flow"), "a flow", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "its name in the account", flow.id);
    flow.behaviour = behaviours_.behaviourOf(reader, node, {"via", "to", "board", "arrival"});
    const bool behaves = node.find("behaviour") != nullptr || sits(node, "to");
    if (sits(node, "to"))
        flow.behaviour = seatsFor(behaviours_, reader, node, "to", {"via", "arrival"}, flow.id, diagnostics_);
    const std::optional<Place> from_place = readBeginning(reader, node, flow);
    const std::optional<Destination> destination = readEnd(reader, node, flow);
    eachOf(reader, "via", [&](const JsonNode& item) {
        if (auto stop = places_.stop(item)) flow.via.push_back(std::move(*stop));
    });
    readAmount(reader, node, flow);
    reader.number("start", flow.start);
    reader.number("end", flow.end);
    if (flow.end <= flow.start)
        diagnostics_.error(node.find("end") ? node.find("end")->where : node.where,
                           fmt::format("the flow ends ({:.6g} s) {} it starts ({:.6g} s)", flow.end,
                                       flow.end < flow.start ? "before" : "when", flow.start));
    flow.people = readPeople(reader, diagnostics_);
    readArrival(reader, flow.arrival);
    reader.finish();
    claimId(node, flow.id, groups_, layout_.flows.size(), "a flow or formation", diagnostics_);
    if (!from_place || (!destination && !behaves)) return;
    flow.from = *from_place;
    if (destination) flow.to = *destination;
    checkEnds(flow);
    layout_.flows.push_back(std::move(flow));
}

/// Where people come from: a place, or out of vehicles.
std::optional<Place> FlowReader::readBeginning(ObjectReader& reader, const JsonNode& node, Flow& flow) {
    const JsonNode* alight = reader.get("alight");
    const JsonNode* from = alight ? reader.get("from") : reader.require("from", "where people come from");
    if (!alight) return from ? places_.place(*from) : std::nullopt;
    boarding_.checkAlighting(node);
    flow.alights = boarding_.atPlatform(*alight);
    return flow.alights ? std::optional(boarding_.placeOf(*flow.alights)) : std::nullopt;
}

/// Where people go: a place, or into vehicles; nothing where a behaviour tells.
std::optional<Destination> FlowReader::readEnd(ObjectReader& reader, const JsonNode& node, Flow& flow) {
    const JsonNode* board = reader.get("board");
    if (sits(node, "to") && !board) return std::nullopt;
    const bool told = board || node.find("behaviour") != nullptr;
    const JsonNode* to = told ? reader.get("to") : reader.require("to", "where people go");
    if (!board) return to ? places_.destination(*to) : std::nullopt;
    refuseKeys(node, {"to", "arrival"}, "people who `board` go nowhere else: `{}` has no meaning",
               "leave `{}` out", diagnostics_);
    flow.boards = boarding_.atPlatform(*board);
    if (!flow.boards) return std::nullopt;
    const Place platform = boarding_.placeOf(*flow.boards);
    return Destination{Destination::Kind::one, {platform}, {}, platform.where};
}

void FlowReader::readAmount(ObjectReader& reader, const JsonNode& node, Flow& flow) {
    const JsonNode* count = reader.get("count");
    const JsonNode* rate = reader.get("rate");
    const JsonNode* gaps = reader.get("gaps");
    const JsonNode* times = reader.get("times");
    std::vector<const char*> told;
    for (const auto& [key, name] :
         {std::pair{count, "`count`"}, {rate, "`rate`"}, {gaps, "`gaps`"}, {times, "`times`"}})
        if (key) told.push_back(name);
    if (told.size() != 1)
        diagnostics_.error(
            node.where,
            fmt::format("a flow needs exactly one of `count` (people in all), `rate` (people per second), "
                        "`gaps` (seconds between them) and `times` (moments), this one has {}",
                        told.empty() ? "none" : fmt::format("{}", fmt::join(told, " and "))));
    std::uint64_t people = 0;
    double per_second = 0.0;
    reader.integer("count", people);
    reader.number("rate", per_second);
    if (count) flow.count = people;
    if (rate) flow.rate = per_second;
    if (gaps) flow.gaps = readDistribution(reader, "gaps", {}, diagnostics_);
    if (gaps && flow.gaps->maximum <= 0.0)
        diagnostics_.error(gaps->where, "`gaps` of 0 s: everybody would come at once",
                           "for people who come together write a formation");
    if (times)
        refuseKeys(node, {"start", "end"}, "people come at their `times`: `{}` has no meaning",
                   "leave `{}` out", diagnostics_);
    if (times && times->items.empty())
        diagnostics_.error(times->where, "expected one moment or more, in seconds",
                           "for example [0, 2.5, 7]");
    const Limits limits = reader.rule("times").item().limits();
    eachOf(reader, "times", [&](const JsonNode& item) {
        const auto time = numberOf(item, limits, diagnostics_);
        if (time && *time < -layout_.simulation.warmup)
            diagnostics_.error(item.where,
                               fmt::format("{:.6g} s is before everything begins, at {:.6g} s", *time,
                                           0.0 - layout_.simulation.warmup),
                               "raise simulation.warmup");
        if (time) flow.times.push_back(*time);
    });
    std::ranges::sort(flow.times);
}

void FlowReader::checkEnds(const Flow& flow) {
    if (!flow.via.empty() || flow.boards) return;
    for (const Place& to : flow.to.places) {
        if (flow.from.kind == to.kind && flow.from.index == to.index)
            diagnostics_.error(to.where, fmt::format("flow `{}` goes to where it comes from", flow.id));
        else if (flow.from.kind == Place::Kind::road_end && to.kind == Place::Kind::road_start &&
                 flow.from.index == to.index && layout_.roads[flow.from.index].one_way)
            diagnostics_.error(flow.from.where,
                               fmt::format("flow `{}` walks against the one-way road `{}`", flow.id,
                                           layout_.roads[flow.from.index].id),
                               "swap `from` and `to`, or drop the road's `one_way`");
    }
}

}  // namespace throng::authoring
