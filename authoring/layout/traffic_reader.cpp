// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/traffic_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "authoring/layout/polygon_check.h"
#include "base/polygon.h"
#include "shaders/shared/traffic_types.h"

namespace throng::authoring {

bool Phase::isGreen(const Lit& what) const {
    const std::vector<std::size_t>& all = what.is_lane ? lanes : crossings;
    return std::ranges::find(all, what.index) != all.end();
}

bool Signal::holds(const Lit& what) const {
    return std::ranges::any_of(phases, [&](const Phase& phase) { return phase.isGreen(what); });
}

double Signal::cycle() const {
    double seconds = 0.0;
    for (const Phase& phase : phases)
        seconds += phase.seconds;
    return seconds;
}

std::size_t Signal::phaseAt(double time) const {
    double into = std::fmod(time + offset, cycle());
    if (into < 0.0) into += cycle();
    for (std::size_t i = 0; i + 1 < phases.size(); ++i) {
        if (into < phases[i].seconds) return i;
        into -= phases[i].seconds;
    }
    return phases.size() - 1;
}

void TrafficReader::readCrossing(const JsonNode& node) {
    Zebra crossing;
    crossing.where = node.where;
    ObjectReader reader(node, schema_.definition("crossing"), "a crossing", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "the name that signals use", crossing.id);
    crossing.polygon = reader.points("polygon");
    crossing.level = levels_.levelOf(reader);
    reader.finish();
    checkPolygon(crossing.polygon, node.find("polygon"), diagnostics_);
    claimId(node, crossing.id, crossings_, layout_.traffic.crossings.size(), "a crossing", diagnostics_);
    layout_.traffic.crossings.push_back(std::move(crossing));
}

void TrafficReader::readLane(const JsonNode& node) {
    Lane lane;
    lane.where = node.where;
    ObjectReader reader(node, schema_.definition("lane"), "a lane", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "the name that signals and vehicles use", lane.id);
    lane.points = reader.points("points");
    lane.level = levels_.levelOf(reader);
    reader.number("width", lane.width);
    reader.number("speed", lane.speed);
    eachOf(reader, "stops", [&](const JsonNode& item) { readStop(item, lane); });
    reader.finish();
    if (crossings_.contains(lane.id))
        diagnostics_.error(node.where, fmt::format("there already is a crossing `{}`", lane.id),
                           "signals name both: their ids have to differ");
    claimId(node, lane.id, lanes_, layout_.traffic.lanes.size(), "a lane", diagnostics_);
    layout_.traffic.lanes.push_back(std::move(lane));
}

void TrafficReader::readStop(const JsonNode& node, Lane& lane) {
    LaneStop stop;
    stop.where = node.where;
    ObjectReader reader(node, schema_.definition("lane_stop"), "a stop of a lane", diagnostics_);
    if (!reader.isObject()) return;
    reader.point("at", "where fronts stand, [x, y] in metres", stop.at);
    const JsonNode* signal = reader.get("signal");
    const JsonNode* seconds = reader.get("seconds");
    std::optional<double> stands;
    reader.number("seconds", stands);
    stop.seconds = stands.value_or(0.0);
    boarding_.readPlatform(reader, node, stop);
    reader.finish();
    const int told = (signal != nullptr) + (seconds != nullptr) + stop.platform.has_value();
    if (told != 1)
        diagnostics_.error(node.where, fmt::format("a stop needs exactly one of `signal`, `seconds` and "
                                                   "`platform`, this one has {}",
                                                   told == 0 ? "none" : "several"));
    if (signal) named_.push_back({layout_.traffic.lanes.size(), lane.stops.size(), signal});
    checkStop(lane, stop);
    lane.stops.push_back(stop);
}

void TrafficReader::checkStop(const Lane& lane, const LaneStop& stop) const {
    if (lane.points.size() < 2 || diagnostics_.hasErrors()) return;
    constexpr double kBeside = 10.0;  // m: where a sign or a shelter stands
    if (const double apart = distanceToPieces(lane.points, lane.points.size() - 1, stop.at); apart > kBeside)
        diagnostics_.error(stop.where, fmt::format("the stop is {:.1f} m from lane `{}`", apart, lane.id),
                           "give a point on the lane, or beside it");
}

void TrafficReader::readSignal(const JsonNode& node) {
    Signal signal;
    signal.where = node.where;
    ObjectReader reader(node, schema_.definition("signal"), "a signal", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "its name", signal.id);
    reader.number("offset", signal.offset);
    reader.require("phases", "one after the other");
    eachOf(reader, "phases", [&](const JsonNode& item) { readPhase(item, signal); });
    reader.finish();
    if (const JsonNode* list = node.find("phases"); list && signal.phases.empty())
        diagnostics_.error(list->where, fmt::format("signal `{}` has no phases", signal.id),
                           R"(for example [{"seconds": 20, "green": ["lane"]}, {"seconds": 5}])");
    claimId(node, signal.id, signals_, layout_.traffic.signals.size(), "a signal", diagnostics_);
    layout_.traffic.signals.push_back(std::move(signal));
}

void TrafficReader::readPhase(const JsonNode& node, Signal& signal) {
    Phase phase;
    ObjectReader reader(node, schema_.definition("phase"), "a phase", diagnostics_);
    if (!reader.isObject()) return;
    reader.text("name", phase.name);
    reader.require("seconds", "how long it lasts");
    reader.number("seconds", phase.seconds);
    eachOf(reader, "green", [&](const JsonNode& item) { readGreen(item, phase); });
    reader.finish();
    signal.phases.push_back(std::move(phase));
}

void TrafficReader::readGreen(const JsonNode& node, Phase& phase) {
    if (const auto lit = litBy(node)) (lit->is_lane ? phase.lanes : phase.crossings).push_back(lit->index);
}

std::optional<Lit> TrafficReader::litBy(const JsonNode& node) const {
    const bool is_text = node.kind == JsonNode::Kind::text;
    if (const auto known = crossings_.find(node.text); is_text && known != crossings_.end())
        return Lit{false, known->second};
    if (const auto known = lanes_.find(node.text); is_text && known != lanes_.end())
        return Lit{true, known->second};
    std::vector<std::string> names = namesOf(crossings_);
    std::ranges::copy(namesOf(lanes_), std::back_inserter(names));
    diagnostics_.error(node.where, fmt::format("there is no crossing or lane `{}`", node.text),
                       names.empty() ? "list it under `crossings` or `lanes`" : hintFor(node.text, names));
    return std::nullopt;
}

void TrafficReader::readVehicles(const JsonNode& node) {
    VehicleFlow flow;
    flow.where = node.where;
    flow.end = layout_.simulation.duration;
    ObjectReader reader(node, schema_.definition("vehicle_flow"), "a flow of vehicles", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "its name in the bake", flow.id);
    const JsonNode* lane = reader.require("lane", "the lane that they follow");
    Meanings<VehicleKind> kinds;
    for (std::size_t i = 0; i < kVehicleTypes.size(); ++i)
        kinds.emplace_back(kVehicleTypes[i].name, static_cast<VehicleKind>(i));
    reader.choice("kind", kinds, flow.kind);
    readAmount(reader, node, flow);
    boarding_.readVehicle(reader, flow);
    reader.finish();
    claimId(node, flow.id, flows_, layout_.traffic.vehicles.size(), "a flow of vehicles", diagnostics_);
    if (!lane) return;
    const auto known = lanes_.find(lane->text);
    if (lane->kind != JsonNode::Kind::text || known == lanes_.end()) {
        diagnostics_.error(lane->where, fmt::format("there is no lane `{}`", lane->text),
                           lanes_.empty() ? "list it under `lanes`" : hintFor(lane->text, namesOf(lanes_)));
        return;
    }
    flow.lane = known->second;
    layout_.traffic.vehicles.push_back(std::move(flow));
}

void TrafficReader::readAmount(ObjectReader& reader, const JsonNode& node, VehicleFlow& flow) {
    const JsonNode* times = reader.get("times");
    reader.number("rate", flow.rate);
    reader.number("start", flow.start);
    reader.number("end", flow.end);
    if ((times != nullptr) == (node.find("rate") != nullptr))
        diagnostics_.error(node.where,
                           fmt::format("a flow of vehicles needs exactly one of `rate` (vehicles per second) "
                                       "and `times` (s), this one has {}",
                                       times ? "both" : "neither"));
    if (flow.end <= flow.start && !times)
        diagnostics_.error(node.where,
                           fmt::format("the flow ends ({:.6g} s) {} it starts ({:.6g} s)", flow.end,
                                       flow.end < flow.start ? "before" : "when", flow.start));
    const Limits limits = reader.rule("times").item().limits();
    eachOf(reader, "times", [&](const JsonNode& item) {
        if (const auto time = numberOf(item, limits, diagnostics_)) flow.times.push_back(*time);
    });
    std::ranges::sort(flow.times);
}

void TrafficReader::finish() {
    for (const NamedSignal& each : named_) {
        const auto known = signals_.find(each.name->text);
        if (each.name->kind == JsonNode::Kind::text && known != signals_.end()) {
            layout_.traffic.lanes[each.lane].stops[each.stop].signal = known->second;
            continue;
        }
        diagnostics_.error(
            each.name->where, fmt::format("there is no signal `{}`", each.name->text),
            signals_.empty() ? "list it under `signals`" : hintFor(each.name->text, namesOf(signals_)));
    }
    if (diagnostics_.hasErrors()) return;
    for (const Signal& signal : layout_.traffic.signals)
        checkSignal(signal);
    checkLights();
}

/// What cannot end: red for ever, or a crossing that is green while vehicles are.
void TrafficReader::checkSignal(const Signal& signal) const {
    const Traffic& traffic = layout_.traffic;
    if (std::ranges::all_of(
            signal.phases, [](const Phase& phase) { return phase.crossings.empty() && phase.lanes.empty(); }))
        diagnostics_.error(signal.where,
                           fmt::format("signal `{}` holds nobody: no phase is green for anything", signal.id),
                           "name crossings and lanes in `green` of its phases");
    for (const Phase& phase : signal.phases)
        for (const std::size_t lane : phase.lanes)
            if (std::ranges::none_of(traffic.lanes[lane].stops, [&](const LaneStop& stop) {
                    return stop.signal && &traffic.signals[*stop.signal] == &signal;
                })) {
                diagnostics_.error(
                    signal.where,
                    fmt::format("lane `{}` has no stop at signal `{}`: nothing holds its vehicles",
                                traffic.lanes[lane].id, signal.id),
                    fmt::format(R"(write in its `stops` {{"at": [x, y], "signal": "{}"}})", signal.id));
                break;
            }
}

void TrafficReader::checkLights() {
    const Traffic& traffic = layout_.traffic;
    for (std::size_t crossing = 0; crossing < traffic.crossings.size(); ++crossing) {
        const auto count = std::ranges::count_if(traffic.signals, [&](const Signal& signal) {
            return signal.holds({false, crossing});
        });
        if (count > 1)
            diagnostics_.error(
                traffic.crossings[crossing].where,
                fmt::format("{} signals have crossing `{}`", count, traffic.crossings[crossing].id),
                "let one of them have it");
    }
    for (const Lane& lane : traffic.lanes)
        for (const LaneStop& stop : lane.stops) {
            if (!stop.signal) continue;
            const Signal& signal = traffic.signals[*stop.signal];
            const auto index = static_cast<std::size_t>(&lane - traffic.lanes.data());
            if (!signal.holds({true, index}))
                diagnostics_.error(stop.where,
                                   fmt::format("signal `{}` is never green for lane `{}`: its vehicles would "
                                               "stand there for ever",
                                               signal.id, lane.id),
                                   "name the lane in `green` of one of its phases");
        }
}

}  // namespace throng::authoring
