// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/place_reader.h"

#include <fmt/format.h>

#include "authoring/layout/people_reader.h"

namespace throng::authoring {
namespace {

constexpr const char* kDestinationHint =
    R"(a place such as "road:end" or an area's id, {"nearest": [places]} or {"choose": {place: weight}})";

}  // namespace

std::optional<Place> PlaceReader::place(const JsonNode& node) const {
    if (node.kind == JsonNode::Kind::text) return placeNamed(node.text, node.where);
    diagnostics_.error(node.where, fmt::format("expected a place, found {}", node.kindName()),
                       "\"road:start\", \"road:end\" or an area's id");
    return std::nullopt;
}

bool PlaceReader::isPlace(const std::string& name) const {
    return areas_.contains(name) || roads_.contains(name.substr(0, name.rfind(':')));
}

std::optional<Place> PlaceReader::placeNamed(const std::string& name, const SourcePosition& where) const {
    if (const auto area = areas_.find(name); area != areas_.end())
        return Place{Place::Kind::area, area->second, where};
    const std::size_t colon = name.rfind(':');
    const std::string id = name.substr(0, colon);
    const std::string end = colon == std::string::npos ? "" : name.substr(colon + 1);
    const auto road = roads_.find(id);
    if (road != roads_.end() && (end == "start" || end == "end"))
        return Place{end == "start" ? Place::Kind::road_start : Place::Kind::road_end, road->second, where};
    const std::string what = road != roads_.end()
                                 ? fmt::format("`{}` names a road, not one of its ends", name)
                                 : fmt::format("there is no place `{}`", name);
    diagnostics_.error(where, what, hintFor(name, names()));
    return std::nullopt;
}

std::vector<std::string> PlaceReader::names() const {
    std::vector<std::string> names = namesOf(areas_);
    for (const auto& [road, index] : roads_) {
        names.push_back(road + ":start");
        names.push_back(road + ":end");
    }
    return names;
}

Destination PlaceReader::nearestOf(const JsonNode& list) const {
    Destination result{Destination::Kind::nearest, {}, {}, list.where};
    if (list.kind != JsonNode::Kind::array || list.items.empty())
        diagnostics_.error(list.where, "expected a list of places", R"(for example ["gate-a", "gate-b"])");
    if (const std::size_t most = rule().property("nearest").mostOf("maxItems"); list.items.size() > most) {
        diagnostics_.error(list.where, fmt::format("there are {} places, more than the {} that can be",
                                                   list.items.size(), most));
        return result;
    }
    for (const JsonNode& item : list.items)
        if (const auto found = place(item)) result.places.push_back(*found);
    return result;
}

Destination PlaceReader::choiceOf(const JsonNode& shares) const {
    Destination result{Destination::Kind::choose, {}, {}, shares.where};
    if (shares.kind != JsonNode::Kind::object || shares.members.empty()) {
        diagnostics_.error(shares.where, "expected places and their weights",
                           R"(for example {"gate-a": 2, "gate-b": 1})");
        return result;
    }
    ObjectReader reader(shares, rule().property("choose"), "`choose`", diagnostics_);
    for (const JsonNode::Member& member : shares.members) {
        const auto found = placeNamed(member.key, member.key_where);
        const auto weight = numberOf(*reader.get(member.key), reader.rule(member.key).limits(), diagnostics_);
        if (!found || !weight) continue;
        result.places.push_back(*found);
        result.weights.push_back(*weight);
    }
    return result;
}

std::optional<Destination> PlaceReader::destination(const JsonNode& node) const {
    if (node.kind == JsonNode::Kind::text) {
        const auto found = place(node);
        return found ? std::optional(Destination{Destination::Kind::one, {*found}, {}, node.where})
                     : std::nullopt;
    }
    if (node.kind != JsonNode::Kind::object ||
        (node.find("nearest") == nullptr) == (node.find("choose") == nullptr)) {
        diagnostics_.error(node.where, fmt::format("expected a destination, found {}", node.kindName()),
                           kDestinationHint);
        return std::nullopt;
    }
    ObjectReader reader(node, rule(), "a destination", diagnostics_);
    const JsonNode* nearest = reader.get("nearest");
    const JsonNode* choose = reader.get("choose");
    Destination result = nearest ? nearestOf(*nearest) : choiceOf(*choose);
    result.where = node.where;
    reader.finish();
    return result.places.empty() ? std::nullopt : std::optional(result);
}

std::optional<BehaviourState> PlaceReader::stop(const JsonNode& node) const {
    BehaviourState stop;
    stop.does = BehaviourState::Does::walk;
    stop.where = node.where;
    if (!node.find("at")) {
        const auto at = destination(node);
        if (!at) return std::nullopt;
        stop.to = *at;
        return stop;
    }
    ObjectReader reader(node, schema_.definition("stop"), "a stop", diagnostics_);
    const auto at = destination(*reader.get("at"));
    readWhatHappens(reader, node, stop);
    reader.finish();
    if (!at) return std::nullopt;
    stop.to = *at;
    if (stop.stops() && at->kind == Destination::Kind::nearest)
        diagnostics_.error(at->where, "people cannot stop at the nearest of several places",
                           "name one place, or let them `choose`");
    if (stop.does == BehaviourState::Does::queue && at->places.size() > 1)
        diagnostics_.error(at->where, "a line stands at one place", "write one stop for each");
    return stop;
}

void PlaceReader::readWhatHappens(ObjectReader& reader, const JsonNode& node, BehaviourState& stop) const {
    using Does = BehaviourState::Does;
    stop.lasts = readDistribution(reader, "wait", {}, diagnostics_);
    reader.choice(
        "activity",
        {{"gather", ActivityCode::stands}, {"look", ActivityCode::looks}, {"queue", ActivityCode::queues}},
        stop.activity);
    reader.point("facing", stop.facing);
    const bool queues = stop.activity == ActivityCode::queues;
    if (stop.stops() || queues) stop.does = queues ? Does::queue : Does::gather;
    if (const JsonNode* line = reader.get("line")) {
        stop.line = reader.points("line");
        if (!queues)
            diagnostics_.error(line->where, "only a queue has a `line`", R"(write "activity": "queue")");
    }
    const JsonNode* spacing = reader.get("spacing");
    reader.number("spacing", stop.spacing);
    if (spacing && !queues)
        diagnostics_.error(spacing->where, "only a queue has a `spacing`", R"(write "activity": "queue")");
    if (queues && !node.find("line"))
        diagnostics_.error(node.where, "a queue needs the `line` along which people stand, from its front",
                           R"(for example "line": [[0, 0], [6, 0]])");
    if (stop.activity != ActivityCode::stands && !stop.stops())
        diagnostics_.error(node.where, "this stop has no `wait`: people would pass through",
                           R"(write for example "wait": {"uniform": [5, 20]})");
    if (stop.activity == ActivityCode::looks && !stop.facing)
        diagnostics_.error(node.where, "where do people look?", R"(write "facing": [x, y])");
}

}  // namespace throng::authoring
