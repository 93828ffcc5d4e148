// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/boarding_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace throng::authoring {
namespace {

constexpr double kDoorOfCars = 2.0;  // m behind the front

bool callsOn(const VehicleFlow& flow, const AtPlatform& at) {
    return flow.lane == at.lane && flow.doors.has_value();
}

}  // namespace

std::optional<VehicleDoors> doorsOf(VehicleKind kind) {
    VehicleDoors doors;
    if (kind == VehicleKind::bus) {
        doors.at = {1.3, 6.3};
        return doors;
    }
    if (kind != VehicleKind::tram) return std::nullopt;
    doors.at = {3.9, 11.1, 16.9, 24.1};
    doors.sides = VehicleDoors::Sides::both;
    return doors;
}

std::uint32_t capacityOf(VehicleKind kind) {
    if (kind == VehicleKind::tram) return 180;
    return kind == VehicleKind::bus ? 75 : 4;
}

void BoardingReader::readPlatform(ObjectReader& reader, const JsonNode& node, LaneStop& stop) {
    const JsonNode* area = reader.get("platform");
    const JsonNode* id = reader.get("id");
    const JsonNode* dwell = reader.get("dwell");
    if (!area) {
        for (const JsonNode* each : {id, dwell})
            if (each)
                diagnostics_.error(each->where, "only a stop with a `platform` has this",
                                   R"(name the area where people wait: "platform": "...")");
        return;
    }
    StopPlatform platform;
    reader.requiredText("id", "the name that flows use", platform.id);
    if (const auto known = areas_.find(area->text);
        area->kind == JsonNode::Kind::text && known != areas_.end())
        platform.area = known->second;
    else
        diagnostics_.error(area->where, fmt::format("there is no area `{}`", area->text),
                           areas_.empty() ? "list it under `areas`" : hintFor(area->text, namesOf(areas_)));
    readDwell(reader, platform);
    claimId(node, platform.id, ids_, ids_.size(), "a stop", diagnostics_);
    stop.platform = std::move(platform);
}

void BoardingReader::readDwell(ObjectReader& reader, StopPlatform& platform) {
    const JsonNode* standard = reader.rule("dwell").standard();
    reader.expectSame("dwell", !standard || (standard->items.at(0).number == platform.least &&
                                             standard->items.at(1).number == platform.most));
    const JsonNode* dwell = reader.get("dwell");
    const std::vector<JsonNode>* bounds = dwell ? reader.items("dwell") : nullptr;
    if (!bounds) return;
    if (bounds->size() != 2) {
        diagnostics_.error(dwell->where, "expected two numbers: the least and the most, s",
                           R"(for example "dwell": [10, 40])");
        return;
    }
    const Limits limits = reader.rule("dwell").item().limits();
    platform.least = numberOf((*bounds)[0], limits, diagnostics_).value_or(platform.least);
    platform.most = numberOf((*bounds)[1], limits, diagnostics_).value_or(platform.most);
    if (platform.least > platform.most)
        diagnostics_.error(dwell->where,
                           fmt::format("vehicles stand there for at least {:.6g} s and at most {:.6g} s",
                                       platform.least, platform.most),
                           "swap the two");
}

void BoardingReader::readVehicle(ObjectReader& reader, VehicleFlow& flow) {
    flow.doors = doorsOf(flow.kind);
    flow.capacity = capacityOf(flow.kind);
    if (const JsonNode* doors = reader.get("doors")) readDoors(*doors, flow);
    const JsonNode* capacity = reader.get("capacity");
    const JsonNode* aboard = reader.get("aboard");
    for (const JsonNode* each : {capacity, aboard})
        if (each && !flow.doors)
            diagnostics_.error(each->where, "nobody gets on or off: these vehicles have no doors",
                               R"(for example "doors": {})");
    std::uint64_t most = flow.capacity, inside = 0;
    reader.integer("capacity", most);
    reader.integer("aboard", inside);
    flow.capacity = static_cast<std::uint32_t>(most);
    if (!aboard) return;
    flow.aboard = static_cast<std::uint32_t>(inside);
    if (*flow.aboard > flow.capacity)
        diagnostics_.error(
            aboard->where,
            fmt::format("{} people are aboard, and there is room for {}", *flow.aboard, flow.capacity),
            "raise `capacity`, or lower `aboard`");
}

void BoardingReader::readDoors(const JsonNode& node, VehicleFlow& flow) {
    ObjectReader reader(node, schema_.definition("doors"), "`doors`", diagnostics_);
    if (!reader.isObject()) return;
    if (flow.kind == VehicleKind::bicycle)
        diagnostics_.error(node.where, "bicycles have no doors", "leave `doors` out");
    VehicleDoors doors;
    const std::optional<VehicleDoors> usual = doorsOf(flow.kind);
    if (usual) doors.sides = usual->sides;
    const Limits limits = reader.rule("at").item().limits();
    eachOf(reader, "at", [&](const JsonNode& item) {
        if (const auto at = numberOf(item, limits, diagnostics_)) doors.at.push_back(*at);
    });
    if (const JsonNode* at = node.find("at"); at && at->kind == JsonNode::Kind::array && at->items.empty())
        diagnostics_.error(at->where, "expected one door or more: metres behind the front",
                           "leave `doors` out where there are none");
    if (!node.find("at")) doors.at = usual ? usual->at : std::vector<double>{kDoorOfCars};
    reader.number("width", doors.width);
    reader.number("flow", doors.flow);
    reader.number("time", doors.time);
    reader.choice("sides",
                  {{"left", VehicleDoors::Sides::left},
                   {"right", VehicleDoors::Sides::right},
                   {"both", VehicleDoors::Sides::both}},
                  doors.sides);
    reader.finish();
    std::ranges::sort(doors.at);
    flow.doors = std::move(doors);
    checkDoors(node, flow);
}

void BoardingReader::checkDoors(const JsonNode& node, const VehicleFlow& flow) {
    const VehicleDoors& doors = *flow.doors;
    const VehicleType& type = typeOf(flow.kind);
    for (std::size_t i = 0; i < doors.at.size(); ++i) {
        const double begin = doors.at[i] - 0.5 * doors.width, end = doors.at[i] + 0.5 * doors.width;
        if (begin < 0.0 || end > type.length)
            diagnostics_.error(node.where,
                               fmt::format("the door {:.6g} m behind the front is not in the side of a {}, "
                                           "which is {:.6g} m long",
                                           doors.at[i], type.name, type.length),
                               "`at` counts from the front to a door's middle");
        if (i > 0 && begin < doors.at[i - 1] + 0.5 * doors.width)
            diagnostics_.error(node.where,
                               fmt::format("the doors {:.6g} and {:.6g} m behind the front are in each other",
                                           doors.at[i - 1], doors.at[i]),
                               fmt::format("each is {:.6g} m wide", doors.width));
    }
}

std::optional<AtPlatform> BoardingReader::stopNamed(const JsonNode& name) const {
    const std::vector<Lane>& lanes = layout_.traffic.lanes;
    for (std::size_t lane = 0; lane < lanes.size(); ++lane)
        for (std::size_t stop = 0; stop < lanes[lane].stops.size(); ++stop)
            if (const auto& platform = lanes[lane].stops[stop].platform;
                platform && name.kind == JsonNode::Kind::text && platform->id == name.text)
                return AtPlatform{lane, stop, {}, name.where};
    diagnostics_.error(name.where, fmt::format("there is no stop `{}` with a platform", name.text),
                       ids_.empty()
                           ? R"(write in `stops` of a lane {"id": ..., "at": [x, y], "platform": ...})"
                           : hintFor(name.text, namesOf(ids_)));
    return std::nullopt;
}

std::optional<AtPlatform> BoardingReader::atPlatform(const JsonNode& node) {
    if (node.kind != JsonNode::Kind::object) {
        std::optional<AtPlatform> at = stopNamed(node);
        if (!at) return std::nullopt;
        for (std::size_t i = 0; i < layout_.traffic.vehicles.size(); ++i)
            if (callsOn(layout_.traffic.vehicles[i], *at)) at->lines.push_back(i);
        return at;
    }
    ObjectReader reader(node, schema_.definition("at_platform"), "where people get on or off", diagnostics_);
    const JsonNode* stop = reader.require("stop", "the id of a stop with a platform");
    const JsonNode* lines = reader.get("lines");
    std::optional<AtPlatform> at = stop ? stopNamed(*stop) : std::nullopt;
    if (at && lines)
        readLines(*lines, *at);
    else if (at)
        at = atPlatform(*stop);
    reader.items("lines");
    reader.finish();
    return at;
}

void BoardingReader::readLines(const JsonNode& list, AtPlatform& at) const {
    const std::vector<VehicleFlow>& vehicles = layout_.traffic.vehicles;
    std::vector<std::string> calling;
    for (const VehicleFlow& flow : vehicles)
        if (callsOn(flow, at)) calling.push_back(flow.id);
    for (const JsonNode& item : list.items) {
        const auto found = std::ranges::find(vehicles, item.text, &VehicleFlow::id);
        if (item.kind == JsonNode::Kind::text && found != vehicles.end() && callsOn(*found, at)) {
            const auto line = static_cast<std::size_t>(found - vehicles.begin());
            if (std::ranges::find(at.lines, line) != at.lines.end())
                diagnostics_.error(item.where, fmt::format("`{}` is named twice", item.text));
            else
                at.lines.push_back(line);
            continue;
        }
        const std::string& stop = layout_.traffic.lanes[at.lane].stops[at.stop].platform->id;
        diagnostics_.error(
            item.where, fmt::format("no vehicles `{}` stop at `{}`", item.text, stop),
            calling.empty() ? "no vehicles with doors come on its lane" : hintFor(item.text, calling));
    }
}

void BoardingReader::checkAlighting(const JsonNode& node) {
    refuseKeys(node, {"from", "rate", "gaps", "times", "start", "end"},
               "people who `alight` come as their vehicles do, `count` of each: `{}` has no meaning",
               "leave `{}` out", diagnostics_);
}

Place BoardingReader::placeOf(const AtPlatform& at) const {
    return {Place::Kind::area, layout_.traffic.lanes[at.lane].stops[at.stop].platform->area, at.where};
}

}  // namespace throng::authoring
