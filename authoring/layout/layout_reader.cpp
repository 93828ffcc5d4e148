// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/layout_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "authoring/layout/amounts.h"
#include "authoring/layout/behaviour_reader.h"
#include "authoring/layout/boarding_reader.h"
#include "authoring/layout/given_reader.h"
#include "authoring/layout/level_reader.h"
#include "authoring/layout/object_reader.h"
#include "authoring/layout/patch_reader.h"
#include "authoring/layout/people_reader.h"
#include "authoring/layout/place_reader.h"
#include "authoring/layout/plan.h"
#include "authoring/layout/polygon_check.h"
#include "authoring/layout/seat_reader.h"
#include "authoring/layout/seat_rows.h"
#include "authoring/layout/traffic_reader.h"

namespace throng::authoring {
namespace {

class Reader {
  public:
    Reader(const JsonNode& root, const Schema& schema, Diagnostics& diagnostics)
        : root_(root), schema_(schema), diagnostics_(diagnostics) {}

    Layout read() {
        ObjectReader reader(root_, schema_.rule(), "the layout", diagnostics_);
        if (!reader.isObject()) return {};
        reader.get("$schema");
        readVersion(reader);
        reader.text("name", layout_.name);
        if (const JsonNode* node = reader.get("simulation")) readSimulation(*node, reader.rule("simulation"));
        if (const JsonNode* node = reader.get("motion")) readMotion(*node, reader.rule("motion"));
        eachOf(reader, "levels", [this](const JsonNode& node) { levels_.readLevel(node); });
        eachOf(reader, "links", [this](const JsonNode& node) { levels_.readLink(node); });
        eachOf(reader, "roads", [this](const JsonNode& node) { readRoad(node); });
        eachOf(reader, "areas", [this](const JsonNode& node) { readArea(node); });
        eachOf(reader, "walls", [this](const JsonNode& node) { readWall(node); });
        nameWalls();
        eachOf(reader, "patches", [this](const JsonNode& node) { patches_.read(node); });
        eachOf(reader, "crossings", [this](const JsonNode& node) { traffic_.readCrossing(node); });
        eachOf(reader, "lanes", [this](const JsonNode& node) { traffic_.readLane(node); });
        eachOf(reader, "signals", [this](const JsonNode& node) { traffic_.readSignal(node); });
        eachOf(reader, "vehicles", [this](const JsonNode& node) { traffic_.readVehicles(node); });
        traffic_.finish();
        if (const JsonNode* node = reader.get("terrain")) readTerrain(*node);
        eachOf(reader, "behaviours", [this](const JsonNode& node) { behaviours_.read(node); });
        eachOf(reader, "flows", [this](const JsonNode& node) { readFlow(node); });
        eachOf(reader, "formations", [this](const JsonNode& node) { readFormation(node); });
        eachOf(reader, "given", [this](const JsonNode& node) { given_.read(node); });
        eachOf(reader, "seats", [this](const JsonNode& node) { seats_.readBlock(node); });
        eachOf(reader, "events", [this](const JsonNode& node) { readEvent(node); });
        eachOf(reader, "shows", [this](const JsonNode& node) { seats_.readShow(node); });
        eachOf(reader, "attractions", [this](const JsonNode& node) { readAttraction(node); });
        sortEvents();
        seats_.open();
        behaviours_.finish();
        if (const JsonNode* node = reader.get("expect")) readExpectations(*node);
        reader.finish();
        checkWhole();
        return std::move(layout_);
    }

  private:
    void readVersion(ObjectReader& reader) {
        const JsonNode* node = reader.require("throng", "the format's version, 1");
        if (node && (node->kind != JsonNode::Kind::number || node->number != 1.0))
            diagnostics_.error(node->where, "this program reads layouts of version 1", "write \"throng\": 1");
    }

    void readSimulation(const JsonNode& node, SchemaRule rule) {
        SimulationSettings& s = layout_.simulation;
        ObjectReader reader(node, rule, "`simulation`", diagnostics_);
        reader.number("duration", s.duration);
        reader.number("warmup", s.warmup);
        reader.number("fps", s.fps);
        reader.integer("substeps", s.substeps);
        reader.number("decision_interval", s.decision_interval);
        reader.integer("seed", s.seed);
        reader.number("tile_radius", s.tile_radius);
        reader.number("field_of_view", s.field_of_view);
        reader.integer("samples_per_ray", s.samples_per_ray);
        reader.number("pixels_per_metre", s.pixels_per_metre);
        if (const JsonNode* resolution = node.find("pixels_per_metre"))
            s.pixels_per_metre_where = resolution->where;
        Meanings<DiagramMethod> methods = {{"auto", DiagramMethod::automatic}};
        for (const DiagramMethodEntry& entry : kDiagramMethods)
            methods.emplace_back(entry.word, entry.method);
        reader.choice("method", methods, s.method);
        reader.integer("cone_sides", s.cone_sides);
        reader.choice(
            "proximity",
            {{"voronoi", Proximity::voronoi}, {"grid", Proximity::grid}, {"brute", Proximity::brute}},
            s.proximity);
        reader.integer("neighbours", s.neighbours);
        reader.number("time_horizon", s.time_horizon);
        reader.number("wall_time_horizon", s.wall_time_horizon);
        reader.number("contact_range", s.contact_range);
        reader.integer("contact_iterations", s.contact_iterations);
        reader.number("smoothing", s.smoothing);
        reader.boolean("walls_hide", s.walls_hide);
        reader.boolean("avoid_congestion", s.avoid_congestion);
        reader.number("maximum_acceleration", s.maximum_acceleration);
        reader.finish();
        simulation_where_ = node.where;
    }

    void readMotion(const JsonNode& node, SchemaRule schema_rule) {
        ObjectReader motion(node, schema_rule, "`motion`", diagnostics_);
        if (!motion.isObject()) return;
        const auto rows = motionParameters();
        for (std::size_t first = 0, end = 0; first < rows.size(); first = end) {
            while (end < rows.size() && rows[end].rule == rows[first].rule)
                ++end;
            const std::string rule(rows[first].rule);
            if (const JsonNode* told = motion.get(rule)) readRule(*told, motion.rule(rule), rule, first, end);
        }
        motion.finish();
    }

    /// Its parameters are the rows from `first` to before `end`.
    void readRule(const JsonNode& node, SchemaRule schema_rule, const std::string& rule, std::size_t first,
                  std::size_t end) {
        ObjectReader reader(node, schema_rule, fmt::format("the rule `{}`", rule), diagnostics_);
        if (!reader.isObject()) return;
        MotionSettings& settings = layout_.simulation.motion;
        for (std::size_t row = first; row < end; ++row) {
            const MotionParameter& parameter = motionParameters()[row];
            const std::string name(parameter.name);
            double value = settings.number(rule, name);
            bool on = value != 0.0;
            if (parameter.is_switch)
                reader.boolean(name, on);
            else
                reader.number(name, value);
            settings.set(row, parameter.is_switch ? (on ? 1.0 : 0.0) : value);
        }
        reader.finish();
    }

    void readExpectations(const JsonNode& node) {
        const SchemaRule rule = schema_.definition("expect");
        ObjectReader reader(node, rule, "`expect`", diagnostics_);
        if (!reader.isObject()) return;
        if (const JsonNode* line = node.find("line")) layout_.flow_line = lineOf(reader, "line", *line);
        for (const std::string& figure : rule.keys()) {
            if (!rule.property(figure).refersTo("bar")) continue;
            const JsonNode* bar = reader.get(figure);
            if (!bar) continue;
            ObjectReader limits(*bar, rule.property(figure), fmt::format("the bar on `{}`", figure),
                                diagnostics_);
            if (!limits.isObject()) continue;
            Expectation expectation{figure, {}, {}};
            limits.number("min", expectation.minimum);
            limits.number("max", expectation.maximum);
            limits.finish();
            if (!expectation.minimum && !expectation.maximum)
                diagnostics_.error(bar->where,
                                   fmt::format("the bar on `{}` says neither `min` nor `max`", figure),
                                   R"(write for example {"min": 0.99})");
            layout_.expectations.push_back(std::move(expectation));
        }
        if (const JsonNode* flow = node.find("flow"); flow && !node.find("line"))
            diagnostics_.error(flow->where, "a bar on `flow` needs the `line` that people are counted at",
                               R"(write beside it for example "line": [[0, -1], [0, 1]])");
        reader.finish();
    }

    /// A line of exactly two points; more are an error at `blamed`.
    std::optional<Line> lineOf(ObjectReader& reader, const std::string& key, const JsonNode& blamed) {
        const std::vector<glm::dvec2> points = reader.points(key);
        if (points.size() == 2) return Line{points[0], points[1]};
        if (points.size() > 2)
            diagnostics_.error(blamed.where, fmt::format("`{}` is a line of two points", key));
        return std::nullopt;
    }

    void readRoad(const JsonNode& node) {
        Road road;
        road.where = node.where;
        ObjectReader reader(node, schema_.definition("road"), "a road", diagnostics_);
        if (!reader.isObject()) return;
        reader.requiredText("id", "the name that flows use", road.id);
        road.centreline = reader.points("centreline");
        reader.number("width", road.width);
        reader.boolean("one_way", road.one_way);
        road.level = levels_.levelOf(reader);
        reader.finish();
        claimId(node, road.id, roads_, layout_.roads.size(), "a road", diagnostics_);
        layout_.roads.push_back(std::move(road));
    }

    void readArea(const JsonNode& node) {
        Area area;
        area.where = node.where;
        ObjectReader reader(node, schema_.definition("area"), "an area", diagnostics_);
        if (!reader.isObject()) return;
        reader.requiredText("id", "the name that flows use", area.id);
        area.polygon = reader.points("polygon");
        area.level = levels_.levelOf(reader);
        reader.point("facing", area.facing);
        reader.finish();
        checkPolygon(area.polygon, node.find("polygon"), diagnostics_);
        claimId(node, area.id, areas_, layout_.areas.size(), "an area", diagnostics_);
        layout_.areas.push_back(std::move(area));
    }

    void readAttraction(const JsonNode& node) {
        Attraction attraction;
        attraction.where = node.where;
        ObjectReader reader(node, schema_.definition("attraction"), "an attraction", diagnostics_);
        if (!reader.isObject()) return;
        reader.requiredText("id", "its name", attraction.id);
        reader.require("at", "where it is, [x, y] in metres");
        reader.point("at", "where it is, [x, y] in metres", attraction.at);
        attraction.level = levels_.levelOf(reader);
        reader.number("height", attraction.height);
        reader.number("weight", attraction.weight);
        reader.number("reach", attraction.reach);
        reader.number("from", attraction.from);
        reader.number("until", attraction.until);
        reader.boolean("loud", attraction.loud);
        reader.finish();
        if (attraction.until && *attraction.until < attraction.from)
            diagnostics_.error(node.find("until")->where,
                               fmt::format("attraction `{}` ends before it begins", attraction.id),
                               "`until` is a time of the shot, as `from` is");
        claimId(node, attraction.id, attractions_, layout_.attractions.size(), "an attraction", diagnostics_);
        layout_.attractions.push_back(std::move(attraction));
    }

    void readWall(const JsonNode& node) {
        Wall wall;
        wall.where = node.where;
        ObjectReader reader(node, schema_.definition("wall"), "a wall", diagnostics_);
        if (!reader.isObject()) return;
        reader.text("id", wall.id);
        if (const JsonNode* id = node.find("id"); id && id->kind == JsonNode::Kind::text && wall.id.empty())
            diagnostics_.error(id->where, "`id` is empty", "name the wall, or leave `id` out");
        reader.boolean("closed", wall.closed);
        wall.points =
            reader.points("points", wall.closed ? 3 : 0,
                          wall.closed ? ObjectReader::Repeated::kept : ObjectReader::Repeated::refused);
        const JsonNode* thickness = reader.get("thickness");
        reader.number("thickness", wall.thickness);
        if (thickness && wall.closed)
            diagnostics_.warning(thickness->where, "a closed wall is solid: its thickness has no effect");
        reader.number("height", wall.height);
        wall.level = levels_.levelOf(reader);
        reader.finish();
        if (wall.closed) mendObstacle(wall, node.find("points"));
        claimId(node, wall.id, walls_, layout_.walls.size(), "a wall", diagnostics_);
        layout_.walls.push_back(std::move(wall));
    }

    /// Only once all written names are known, so that a name of ours never takes one of the author's.
    void nameWalls() {
        for (std::size_t i = 0; i < layout_.walls.size(); ++i) {
            std::string& id = layout_.walls[i].id;
            if (!id.empty()) continue;
            id = fmt::format("wall{}", i);
            while (!walls_.emplace(id, i).second)
                id += "_";
        }
    }

    void readTerrain(const JsonNode& node) {
        TerrainSettings terrain;
        terrain.where = node.where;
        ObjectReader reader(node, schema_.definition("terrain"), "`terrain`", diagnostics_);
        if (!reader.isObject()) return;
        reader.requiredText("file", "a .glb or .gltf file, relative to the layout", terrain.file);
        if (const JsonNode* file = node.find("file")) terrain.file_where = file->where;
        reader.text("node", terrain.node);
        if (const JsonNode* name = node.find("node")) {
            terrain.node_where = name->where;
            if (name->kind == JsonNode::Kind::text && name->text.empty())
                diagnostics_.error(name->where, "`node` is empty", "name a node, or leave `node` out");
        }
        reader.offset("offset", terrain.offset);
        reader.number("scale", terrain.scale);
        reader.choice("surface", {{"highest", true}, {"lowest", false}}, terrain.highest);
        terrain.is_single = node.find("surface") != nullptr;
        reader.finish();
        layout_.terrain = std::move(terrain);
    }

    /// Obstacles that other tools export now and then: what bounds nothing has no effect, so it does no harm.
    void mendObstacle(Wall& wall, const JsonNode* node) {
        if (!node || wall.points.size() < 3) return;
        if (wall.points.front() == wall.points.back()) wall.points.pop_back();
        std::vector<glm::dvec2> mended = wall.points;
        const std::size_t removed = removeSpikes(mended);
        if (mended.size() < 3 || std::abs(signedArea(mended)) < 1.0e-6) {
            if (selfCrossing(wall.points, false)) return checkPolygon(wall.points, node, diagnostics_);
            wall.closed = false;
            wall.thickness = 0.0;
            wall.points.push_back(wall.points.front());
            diagnostics_.warning(node->where,
                                 "the obstacle has no area: it is taken for a wall without thickness");
            return;
        }
        wall.points = std::move(mended);
        if (removed > 0)
            diagnostics_.warning(node->where, fmt::format("the outline runs back over itself: {} of its "
                                                          "points are left out",
                                                          removed));
        if (selfCrossing(wall.points, false)) return checkPolygon(wall.points, node, diagnostics_);
        if (const auto touching = selfCrossing(wall.points))
            diagnostics_.warning(
                node->where,
                fmt::format("the outline touches itself at [{:.6g}, {:.6g}] (edges {} and {})",
                            touching->point.x, touching->point.y, touching->first_edge,
                            touching->second_edge),
                "what lies between is solid all the same, but may not be what was meant");
    }

    void readArrival(ObjectReader& reader, Arrival& arrival) {
        reader.choice("arrival", {{"leave", Arrival::leave}, {"stay", Arrival::stay}}, arrival);
    }

    void readFlow(const JsonNode& node) {
        Flow flow;
        flow.where = node.where;
        flow.end = layout_.simulation.duration;
        ObjectReader reader(node, schema_.definition("flow"), "a flow", diagnostics_);
        if (!reader.isObject()) return;
        reader.requiredText("id", "its name in the account", flow.id);
        flow.behaviour = behaviours_.behaviourOf(reader, node, {"via", "to", "board", "arrival"});
        const bool behaves = node.find("behaviour") != nullptr || sits(node, "to");
        if (sits(node, "to")) flow.behaviour = seatsFor(reader, node, "to", {"via", "arrival"}, flow.id);
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

    /// Whether a goal is a seat.
    static bool sits(const JsonNode& node, const char* key) {
        const JsonNode* goal = node.find(key);
        return goal && goal->kind == JsonNode::Kind::object && goal->find("seats");
    }
    std::optional<std::size_t> seatsFor(ObjectReader& reader, const JsonNode& node, const char* key,
                                        const std::vector<std::string>& instead, const std::string& owner) {
        refuseKeys(node, instead, "who goes to a seat stays there: `{}` has no meaning",
                   "leave `{}` out, or write a behaviour", diagnostics_);
        if (node.find("behaviour")) behaviours_.refuseBeside(node, {key});
        if (node.find("board")) return std::nullopt;
        return behaviours_.sittingIn(*reader.get(key), owner);
    }

    /// Where people come from: a place, or out of vehicles.
    std::optional<Place> readBeginning(ObjectReader& reader, const JsonNode& node, Flow& flow) {
        const JsonNode* alight = reader.get("alight");
        const JsonNode* from = alight ? reader.get("from") : reader.require("from", "where people come from");
        if (!alight) return from ? places_.place(*from) : std::nullopt;
        boarding_.checkAlighting(node);
        flow.alights = boarding_.atPlatform(*alight);
        return flow.alights ? std::optional(boarding_.placeOf(*flow.alights)) : std::nullopt;
    }

    /// Where people go: a place, or into vehicles; nothing where a behaviour tells.
    std::optional<Destination> readEnd(ObjectReader& reader, const JsonNode& node, Flow& flow) {
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

    void readAmount(ObjectReader& reader, const JsonNode& node, Flow& flow) {
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
                fmt::format(
                    "a flow needs exactly one of `count` (people in all), `rate` (people per second), "
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

    void checkEnds(const Flow& flow) {
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

    /// What happens is one key; what else belongs to it depends on which.
    void readEvent(const JsonNode& node) {
        Event event;
        event.where = node.where;
        ObjectReader reader(node, schema_.definition("event"), "an event", diagnostics_);
        if (!reader.isObject()) return;
        reader.require("at", "when, in seconds");
        reader.number("at", event.at);
        const std::vector<std::string> kinds = {"open", "close", "go_to", "flow"};
        const JsonNode* what = nullptr;
        int found = 0;
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            const JsonNode* key = reader.get(kinds[i]);
            if (!key) continue;
            ++found;
            what = key;
            event.kind = static_cast<Event::Kind>(i);
        }
        if (found != 1) {
            diagnostics_.error(node.where,
                               "an event needs exactly one of `open`, `close`, `go_to` and `flow`");
            return;
        }
        if (event.kind == Event::Kind::go_to) readSending(reader, *what, event);
        if (event.kind == Event::Kind::rate) {
            reader.require("rate", "people per second from now on");
            reader.number("rate", event.rate);
        }
        reader.finish();
        if (event.kind != Event::Kind::go_to && !findSubject(*what, event)) return;
        if (event.kind != Event::Kind::go_to || !event.then.to.places.empty())
            layout_.events.push_back(std::move(event));
    }

    void readSending(ObjectReader& reader, const JsonNode& to, Event& event) {
        Arrival arrival = Arrival::leave;
        readArrival(reader, arrival);
        if (auto destination = places_.destination(to)) event.then = goalState(*destination, arrival);
        eachOf(reader, "who", [&](const JsonNode& item) {
            if (item.kind == JsonNode::Kind::text && seats_.hasBlock(item.text))
                diagnostics_.error(item.where,
                                   fmt::format("`{}` is a block of seats: its people keep them", item.text),
                                   "what they do is told under `shows`");
            else if (item.kind == JsonNode::Kind::text && given_.has(item.text))
                diagnostics_.error(item.where, fmt::format("`{}` are people whose ways are given", item.text),
                                   "nothing sends them elsewhere");
            else if (item.kind == JsonNode::Kind::text && groups_.count(item.text))
                event.who.push_back(item.text);
            else
                diagnostics_.error(item.where, fmt::format("there is no flow or formation `{}`", item.text),
                                   hintFor(item.text, namesOfSent()));
        });
    }

    /// Whom an event can send somewhere.
    std::vector<std::string> namesOfSent() const {
        std::vector<std::string> names = namesOf(groups_);
        std::erase_if(names,
                      [&](const std::string& name) { return seats_.hasBlock(name) || given_.has(name); });
        return names;
    }

    std::vector<std::string> namesOfFlows() const {
        std::vector<std::string> names;
        for (const Flow& flow : layout_.flows)
            names.push_back(flow.id);
        return names;
    }

    bool findSubject(const JsonNode& node, Event& event) {
        const bool is_flow = event.kind == Event::Kind::rate;
        const auto& ids = is_flow ? groups_ : walls_;
        const auto found = ids.find(node.text);
        if (node.kind != JsonNode::Kind::text || found == ids.end()) {
            diagnostics_.error(node.where,
                               fmt::format("there is no {} `{}`", is_flow ? "flow" : "wall", node.text),
                               hintFor(node.text, is_flow ? namesOfFlows() : namesOf(ids)));
            return false;
        }
        event.subject = found->second;
        if (is_flow && (event.subject >= layout_.flows.size() ||
                        layout_.flows[event.subject].id != node.text || !layout_.flows[event.subject].rate)) {
            diagnostics_.error(node.where, fmt::format("`{}` is no flow with a `rate`", node.text),
                               "only these can change");
            return false;
        }
        return true;
    }

    /// Gates are open or closed at first, as their first event would have it.
    void sortEvents() {
        std::stable_sort(layout_.events.begin(), layout_.events.end(),
                         [](const Event& a, const Event& b) { return a.at < b.at; });
        for (const Event& event : layout_.events) {
            if (event.kind != Event::Kind::open && event.kind != Event::Kind::close) continue;
            Wall& wall = layout_.walls[event.subject];
            if (wall.closed)
                diagnostics_.error(event.where, fmt::format("wall `{}` is a solid, not a gate", wall.id),
                                   "only walls without `closed` can open");
            const bool opens = event.kind == Event::Kind::open;
            if (wall.toggles.empty())
                wall.open_at_start = !opens;
            else if (wall.isOpen(wall.toggles.back()) == opens)
                diagnostics_.error(
                    event.where, fmt::format("wall `{}` already is {}", wall.id, opens ? "open" : "closed"));
            wall.toggles.push_back(event.at);
        }
    }

    enum class Shape { circle, grid, agents };

    void readFormation(const JsonNode& node) {
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
            formation.behaviour = seatsFor(reader, node, "goal", {"arrival"}, formation.id);
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

    CircleFormation readCircle(ObjectReader& reader) {
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
    bool isGoal(const JsonNode& goal) {
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
    GridFormation readGrid(ObjectReader& reader, bool behaves) {
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
            if (const auto line = lineOf(inner, "mirror", *goal)) grid.goal = *line;
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
    ListFormation readList(ObjectReader& reader, bool behaves, double start) {
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
    void readGoal(ObjectReader& reader, const JsonNode& node, bool behaves, ListedAgent& agent) {
        const JsonNode* goal = node.find("goal");
        if (goal && (goal->kind == JsonNode::Kind::text || goal->kind == JsonNode::Kind::object)) {
            reader.get("goal");
            agent.to = places_.destination(*goal);
        } else if (goal || !behaves) {
            reader.point("goal", "[x, y] in metres, or a place", agent.goal);
        }
    }

    void readVia(ObjectReader& reader, ListedAgent& agent) {
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

    void checkWhole() {
        double people = 0.0;
        double largest = 0.0;
        for (const Flow& flow : layout_.flows) {
            people += peopleIn(flow, layout_);
            largest = std::max(largest, flow.people.largestRadius());
        }
        for (const Formation& formation : layout_.formations) {
            people += peopleIn(formation);
            largest = std::max(largest, formation.people.largestRadius());
            if (const auto* list = std::get_if<ListFormation>(&formation.shape))
                for (const ListedAgent& agent : list->agents)
                    largest = std::max(largest, agent.radius.value_or(0.0));
        }
        for (const GivenPeople& given : layout_.given) {
            people += given.file.empty() ? static_cast<double>(given.ways.size()) : 1.0;
            largest = std::max(largest, given.people.largestRadius());
        }
        if (!diagnostics_.hasErrors())
            for (const SeatBlock& block : layout_.seats)
                people += static_cast<double>(countSeats(block)) * block.occupancy;
        const double most = schema_.definition("flow").property("count").limits().most;
        if (people > most)
            diagnostics_.error(
                root_.where,
                fmt::format("about {:.0f} people are more than the {:.0f} that one bake can hold", people,
                            most));
        checkPlans();
        if (people == 0.0 && !diagnostics_.hasErrors())
            diagnostics_.warning(root_.where, "there is nobody in this layout", "add a flow or a formation");
        const double tile = layout_.simulation.tile_radius;
        if (tile < largest)
            diagnostics_.error(
                simulation_where_.value_or(root_.where),
                fmt::format("simulation.tile_radius is {:.6g} m, smaller than the largest body ({:.6g} m)",
                            tile, largest),
                "a tile has to cover the body");
    }

    /// Everybody keeps each of their stops, and where events will send them.
    void checkPlans() {
        const auto sent = [&](const std::string& id) {
            return static_cast<double>(
                std::ranges::count_if(layout_.events, [&](const Event& event) { return sends(event, id); }));
        };
        double plans = 0.0;
        for (const Flow& flow : layout_.flows)
            plans += (1.0 + static_cast<double>(flow.via.size()) + sent(flow.id)) * peopleIn(flow, layout_);
        for (const Formation& formation : layout_.formations)
            plans += (1.0 + sent(formation.id)) * peopleIn(formation);
        if (!diagnostics_.hasErrors())
            for (const Show& show : layout_.shows)
                for (const std::size_t block : show.blocks)
                    plans += static_cast<double>(show.laps * countSeats(layout_.seats.at(block)));
        const double most = schema_.rule().remark("x-most-plans").number;
        if (plans > most)
            diagnostics_.error(
                root_.where,
                fmt::format(
                    "people make about {:.0f} stops and changes of mind together: more than the {:.0f} "
                    "that one bake can hold",
                    plans, most),
                "let fewer people make so many");
    }

    const JsonNode& root_;
    const Schema& schema_;
    Diagnostics& diagnostics_;
    Layout layout_;
    std::optional<SourcePosition> simulation_where_;
    std::map<std::string, std::size_t> roads_, areas_, walls_, attractions_;
    std::map<std::string, std::size_t> groups_;  // flows by index, formations
    PlaceReader places_{schema_, roads_, areas_, diagnostics_};
    LevelReader levels_{schema_, layout_, diagnostics_};
    PatchReader patches_{schema_, layout_, levels_, diagnostics_};
    GivenReader given_{schema_, layout_, levels_, groups_, diagnostics_};
    SeatReader seats_{schema_, layout_, places_, levels_, groups_, walls_, diagnostics_};
    BoardingReader boarding_{schema_, layout_, areas_, diagnostics_};
    TrafficReader traffic_{schema_, layout_, levels_, boarding_, diagnostics_};
    BehaviourReader behaviours_{schema_, layout_, places_, groups_, walls_, traffic_, diagnostics_};
};

}  // namespace

const Schema& layoutRules() {
    static const Schema schema(layoutSchema());
    return schema;
}

std::optional<Layout> readLayout(std::string_view text, std::span<const std::string> overrides,
                                 Diagnostics& diagnostics, const Schema& schema) {
    JsonNode root = parseJson(text, diagnostics);
    if (diagnostics.hasErrors()) return std::nullopt;
    for (const std::string& change : overrides)
        applyOverride(root, change, diagnostics);
    Layout layout = Reader(root, schema, diagnostics).read();
    std::stable_sort(
        diagnostics.entries.begin(), diagnostics.entries.end(), [](const Diagnostic& a, const Diagnostic& b) {
            return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
        });
    if (diagnostics.hasErrors()) return std::nullopt;
    return layout;
}

std::string layoutWith(std::string_view text, std::span<const std::string> overrides) {
    if (overrides.empty()) return std::string(text);
    Diagnostics known;  // readLayout() has told them
    JsonNode root = parseJson(text, known);
    for (const std::string& change : overrides)
        applyOverride(root, change, known);
    return plainJson(root).dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace throng::authoring
