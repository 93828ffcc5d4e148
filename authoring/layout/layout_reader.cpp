// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/layout_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "authoring/layout/object_reader.h"
#include "authoring/layout/people_reader.h"
#include "authoring/layout/place_reader.h"
#include "authoring/layout/polygon_check.h"

namespace throng::authoring {
namespace {

constexpr double kMostPeople = 4'000'000.0;
constexpr Limits kAnyLength{0.0, 1.0e6, true};

class Reader {
  public:
    Reader(const JsonNode& root, Diagnostics& diagnostics) : root_(root), diagnostics_(diagnostics) {}

    Layout read() {
        ObjectReader reader(root_, "the layout", diagnostics_);
        if (!reader.isObject()) return {};
        reader.get("$schema");
        readVersion(reader);
        reader.text("name", layout_.name);
        if (const JsonNode* node = reader.get("simulation")) readSimulation(*node);
        if (const JsonNode* node = reader.get("motion")) readMotion(*node);
        eachOf(reader, "roads", [this](const JsonNode& node) { readRoad(node); });
        eachOf(reader, "areas", [this](const JsonNode& node) { readArea(node); });
        eachOf(reader, "walls", [this](const JsonNode& node) { readWall(node); });
        nameWalls();
        if (const JsonNode* node = reader.get("terrain")) readTerrain(*node);
        eachOf(reader, "flows", [this](const JsonNode& node) { readFlow(node); });
        eachOf(reader, "formations", [this](const JsonNode& node) { readFormation(node); });
        eachOf(reader, "events", [this](const JsonNode& node) { readEvent(node); });
        sortEvents();
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

    template <class Read>
    void eachOf(ObjectReader& reader, const std::string& key, Read read) {
        const JsonNode* list = reader.get(key);
        if (!list) return;
        if (list->kind != JsonNode::Kind::array) {
            diagnostics_.error(list->where,
                               fmt::format("expected an array of {}, found {}", key, list->kindName()));
            return;
        }
        for (const JsonNode& item : list->items)
            read(item);
    }

    void readSimulation(const JsonNode& node) {
        SimulationSettings& s = layout_.simulation;
        ObjectReader reader(node, "`simulation`", diagnostics_);
        reader.number("duration", {0.0, 86400.0, true}, s.duration);
        reader.number("warmup", {0.0, 3600.0}, s.warmup);
        reader.number("fps", {1.0, 240.0}, s.fps);
        reader.integer("substeps", {1, 64}, s.substeps);
        reader.integer("seed", {0, 9007199254740992.0}, s.seed);
        reader.number("tile_radius", {0.05, 10.0}, s.tile_radius);
        reader.number("field_of_view", {0.0, 360.0, true}, s.field_of_view);
        reader.integer("samples_per_ray", {1, 64}, s.samples_per_ray);
        reader.number("pixels_per_metre", {0.0, 100.0}, s.pixels_per_metre);
        if (const JsonNode* resolution = node.find("pixels_per_metre"))
            s.pixels_per_metre_where = resolution->where;
        std::vector<std::string> methods = {"auto"};
        for (const DiagramMethodEntry& entry : kDiagramMethods)
            methods.emplace_back(entry.word);
        if (const auto method = reader.choice("method", methods))
            s.method = *diagramMethodNamed(methods[*method]);
        reader.integer("cone_sides", {3, 256}, s.cone_sides);
        if (const auto proximity = reader.choice("proximity", {"voronoi", "grid", "brute"}))
            s.proximity = static_cast<Proximity>(*proximity);
        reader.integer("neighbours", {1, 32}, s.neighbours);
        reader.number("time_horizon", {0.1, 20.0}, s.time_horizon);
        reader.number("wall_time_horizon", {0.05, 20.0}, s.wall_time_horizon);
        reader.number("contact_range", {0.5, 3.0}, s.contact_range);
        reader.integer("contact_iterations", {1, 32}, s.contact_iterations);
        reader.number("smoothing", {0.0, 1.0}, s.smoothing);
        reader.boolean("avoid_congestion", s.avoid_congestion);
        reader.number("maximum_acceleration", {0.1, 100.0}, s.maximum_acceleration);
        reader.finish();
        simulation_where_ = node.where;
    }

    void readMotion(const JsonNode& node) {
        ObjectReader motion(node, "`motion`", diagnostics_);
        if (!motion.isObject()) return;
        const auto rows = motionParameters();
        for (std::size_t first = 0, end = 0; first < rows.size(); first = end) {
            while (end < rows.size() && rows[end].rule == rows[first].rule)
                ++end;
            const std::string rule(rows[first].rule);
            if (const JsonNode* told = motion.get(rule)) readRule(*told, rule, first, end);
        }
        motion.finish();
    }

    /// Its parameters are the rows from `first` to before `end`.
    void readRule(const JsonNode& node, const std::string& rule, std::size_t first, std::size_t end) {
        ObjectReader reader(node, fmt::format("the rule `{}`", rule), diagnostics_);
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
                reader.number(name, {parameter.least, parameter.most}, value);
            settings.set(row, parameter.is_switch ? (on ? 1.0 : 0.0) : value);
        }
        reader.finish();
    }

    void readExpectations(const JsonNode& node) {
        ObjectReader reader(node, "`expect`", diagnostics_);
        if (!reader.isObject()) return;
        if (const JsonNode* line = node.find("line")) layout_.flow_line = lineOf(reader, "line", *line);
        for (const std::string_view figure : kExpectableFigures) {
            const JsonNode* bar = reader.get(std::string(figure));
            if (!bar) continue;
            ObjectReader limits(*bar, fmt::format("the bar on `{}`", figure), diagnostics_);
            if (!limits.isObject()) continue;
            Expectation expectation{std::string(figure), {}, {}};
            for (const auto& [key, value] :
                 {std::pair{"min", &expectation.minimum}, std::pair{"max", &expectation.maximum}})
                if (const JsonNode* limit = limits.get(key))
                    *value = limits.numberOf(*limit, {-1.0e9, 1.0e9});
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
        const std::vector<glm::dvec2> points = reader.points(key, 2);
        if (points.size() == 2) return Line{points[0], points[1]};
        if (points.size() > 2)
            diagnostics_.error(blamed.where, fmt::format("`{}` is a line of two points", key));
        return std::nullopt;
    }

    void claimId(const JsonNode& node, const std::string& id, std::map<std::string, std::size_t>& ids,
                 std::size_t index, const char* kind) {
        if (id.empty()) return;
        const JsonNode* where = node.find("id");
        if (!ids.emplace(id, index).second && where)
            diagnostics_.error(where->where, fmt::format("there already is {} `{}`", kind, id),
                               "ids have to differ");
    }

    void readRoad(const JsonNode& node) {
        Road road;
        road.where = node.where;
        ObjectReader reader(node, "a road", diagnostics_);
        if (!reader.isObject()) return;
        reader.requiredText("id", "the name that flows use", road.id);
        road.centreline = reader.points("centreline", 2);
        reader.number("width", {0.5, 1000.0}, road.width);
        reader.boolean("one_way", road.one_way);
        reader.finish();
        claimId(node, road.id, roads_, layout_.roads.size(), "a road");
        layout_.roads.push_back(std::move(road));
    }

    void readArea(const JsonNode& node) {
        Area area;
        area.where = node.where;
        ObjectReader reader(node, "an area", diagnostics_);
        if (!reader.isObject()) return;
        reader.requiredText("id", "the name that flows use", area.id);
        area.polygon = reader.points("polygon", 3);
        reader.finish();
        checkPolygon(area.polygon, node.find("polygon"));
        claimId(node, area.id, areas_, layout_.areas.size(), "an area");
        layout_.areas.push_back(std::move(area));
    }

    void readWall(const JsonNode& node) {
        Wall wall;
        wall.where = node.where;
        ObjectReader reader(node, "a wall", diagnostics_);
        if (!reader.isObject()) return;
        reader.text("id", wall.id);
        if (const JsonNode* id = node.find("id"); id && id->kind == JsonNode::Kind::text && wall.id.empty())
            diagnostics_.error(id->where, "`id` is empty", "name the wall, or leave `id` out");
        reader.boolean("closed", wall.closed);
        wall.points = reader.points("points", wall.closed ? 3 : 2);
        const JsonNode* thickness = reader.get("thickness");
        reader.number("thickness", {0.0, 100.0}, wall.thickness);
        if (thickness && wall.closed)
            diagnostics_.warning(thickness->where, "a closed wall is solid: its thickness has no effect");
        reader.number("height", {0.01, 1000.0}, wall.height);
        reader.finish();
        if (wall.closed) checkPolygon(wall.points, node.find("points"));
        claimId(node, wall.id, walls_, layout_.walls.size(), "a wall");
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
        ObjectReader reader(node, "`terrain`", diagnostics_);
        if (!reader.isObject()) return;
        reader.requiredText("file", "a .glb or .gltf file, relative to the layout", terrain.file);
        if (const JsonNode* file = node.find("file")) terrain.file_where = file->where;
        reader.text("node", terrain.node);
        if (const JsonNode* name = node.find("node")) {
            terrain.node_where = name->where;
            if (name->kind == JsonNode::Kind::text && name->text.empty())
                diagnostics_.error(name->where, "`node` is empty", "name a node, or leave `node` out");
        }
        if (const JsonNode* offset = reader.get("offset")) readOffset(reader, *offset, terrain.offset);
        reader.number("scale", {0.0, 1.0e6, true}, terrain.scale);
        if (const auto surface = reader.choice("surface", {"highest", "lowest"}))
            terrain.highest = *surface == 0;
        reader.finish();
        layout_.terrain = std::move(terrain);
    }

    void readOffset(ObjectReader& reader, const JsonNode& node, glm::dvec3& offset) {
        if (node.kind != JsonNode::Kind::array || node.items.size() != 3) {
            diagnostics_.error(node.where, fmt::format("expected an offset [x, y, z] in metres, found {}",
                                                       node.kind == JsonNode::Kind::array
                                                           ? fmt::format("an array of {}", node.items.size())
                                                           : std::string(node.kindName())));
            return;
        }
        for (int i = 0; i < 3; ++i)
            offset[i] =
                reader.numberOf(node.items[static_cast<std::size_t>(i)], {-1.0e8, 1.0e8}).value_or(0.0);
    }

    void checkPolygon(std::vector<glm::dvec2>& polygon, const JsonNode* node) {
        if (!node || polygon.size() < 3) return;
        if (polygon.front() == polygon.back()) polygon.pop_back();  // closed by hand, as many tools write it
        if (const auto crossing = selfCrossing(polygon))
            diagnostics_.error(node->where,
                               fmt::format("the polygon crosses itself at [{:.6g}, {:.6g}] (edges {} and {})",
                                           crossing->point.x, crossing->point.y, crossing->first_edge,
                                           crossing->second_edge),
                               "reorder its points so that they run once round the outline");
        else if (std::abs(signedArea(polygon)) < 1.0e-6)
            diagnostics_.error(node->where, "the polygon has no area");
    }

    void readArrival(ObjectReader& reader, Arrival& arrival) {
        if (const auto choice = reader.choice("arrival", {"leave", "stay"}))
            arrival = *choice == 0 ? Arrival::leave : Arrival::stay;
    }

    void readFlow(const JsonNode& node) {
        Flow flow;
        flow.where = node.where;
        flow.end = layout_.simulation.duration;
        ObjectReader reader(node, "a flow", diagnostics_);
        if (!reader.isObject()) return;
        reader.requiredText("id", "its name in the account", flow.id);
        const JsonNode* from = reader.require("from", "where people come from");
        const JsonNode* to = reader.require("to", "where people go");
        const std::optional<Place> from_place = from ? places_.place(*from) : std::nullopt;
        const std::optional<Destination> destination = to ? places_.destination(*to) : std::nullopt;
        eachOf(reader, "via", [&](const JsonNode& item) {
            if (auto stop = places_.stop(item)) flow.via.push_back(std::move(*stop));
        });
        readAmount(reader, node, flow);
        reader.number("start", {0.0, 86400.0}, flow.start);
        reader.number("end", {0.0, 86400.0}, flow.end);
        if (flow.end <= flow.start)
            diagnostics_.error(node.find("end") ? node.find("end")->where : node.where,
                               fmt::format("the flow ends ({:.6g} s) {} it starts ({:.6g} s)", flow.end,
                                           flow.end < flow.start ? "before" : "when", flow.start));
        flow.people = readPeople(reader, diagnostics_);
        readArrival(reader, flow.arrival);
        reader.finish();
        claimId(node, flow.id, groups_, layout_.flows.size(), "a flow or formation");
        if (!from_place || !destination) return;
        flow.from = *from_place;
        flow.to = *destination;
        checkEnds(flow);
        layout_.flows.push_back(std::move(flow));
    }

    void readAmount(ObjectReader& reader, const JsonNode& node, Flow& flow) {
        const JsonNode* count = reader.get("count");
        const JsonNode* rate = reader.get("rate");
        if ((count != nullptr) == (rate != nullptr))
            diagnostics_.error(node.where, fmt::format("a flow needs exactly one of `count` (people in all) "
                                                       "and `rate` (people per second), this one has {}",
                                                       count ? "both" : "neither"));
        std::uint64_t people = 0;
        double per_second = 0.0;
        reader.integer("count", {0, kMostPeople}, people);
        reader.number("rate", {0.0, 1.0e5}, per_second);
        if (count) flow.count = people;
        if (rate) flow.rate = per_second;
    }

    void checkEnds(const Flow& flow) {
        if (!flow.via.empty()) return;
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
        ObjectReader reader(node, "an event", diagnostics_);
        if (!reader.isObject()) return;
        reader.require("at", "when, in seconds");
        reader.number("at", {0.0, 86400.0}, event.at);
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
            reader.number("rate", {0.0, 1.0e5}, event.rate);
        }
        reader.finish();
        if (event.kind != Event::Kind::go_to && !findSubject(*what, event)) return;
        if (event.kind != Event::Kind::go_to || !event.to.places.empty())
            layout_.events.push_back(std::move(event));
    }

    void readSending(ObjectReader& reader, const JsonNode& to, Event& event) {
        if (auto destination = places_.destination(to)) event.to = std::move(*destination);
        readArrival(reader, event.arrival);
        eachOf(reader, "who", [&](const JsonNode& item) {
            std::vector<std::string> known;
            known.reserve(groups_.size());
            for (const auto& [id, index] : groups_)
                known.push_back(id);
            if (item.kind == JsonNode::Kind::text && groups_.count(item.text))
                event.who.push_back(item.text);
            else
                diagnostics_.error(item.where, fmt::format("there is no flow or formation `{}`", item.text),
                                   hintFor(item.text, known));
        });
    }

    bool findSubject(const JsonNode& node, Event& event) {
        const bool is_flow = event.kind == Event::Kind::rate;
        const auto& ids = is_flow ? groups_ : walls_;
        const auto found = ids.find(node.text);
        if (node.kind != JsonNode::Kind::text || found == ids.end()) {
            std::vector<std::string> known;
            known.reserve(ids.size());
            for (const auto& [id, index] : ids)
                known.push_back(id);
            diagnostics_.error(node.where,
                               fmt::format("there is no {} `{}`", is_flow ? "flow" : "wall", node.text),
                               hintFor(node.text, known));
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

    void readFormation(const JsonNode& node) {
        Formation formation;
        formation.where = node.where;
        ObjectReader reader(node, "a formation", diagnostics_);
        if (!reader.isObject()) return;
        reader.requiredText("id", "its name in the account", formation.id);
        reader.require("type", "circle, grid or agents");
        const auto type = reader.choice("type", {"circle", "grid", "agents"});
        if (type) {
            if (*type == 0) formation.shape = readCircle(reader);
            if (*type == 1) formation.shape = readGrid(reader);
            if (*type == 2) formation.shape = readList(reader);
        }
        reader.number("start", {0.0, 86400.0}, formation.start);
        formation.wait = readDistribution(reader, "wait", {0.0, 86400.0}, formation.wait, diagnostics_);
        formation.people = readPeople(reader, diagnostics_);
        readArrival(reader, formation.arrival);
        reader.number("goal_tolerance", {0.01, 100.0}, formation.goal_tolerance);
        if (type) reader.finish();
        claimId(node, formation.id, groups_, std::string::npos, "a flow or formation");
        layout_.formations.push_back(std::move(formation));
    }

    CircleFormation readCircle(ObjectReader& reader) {
        CircleFormation circle;
        reader.point("centre", "the middle, [x, y] in metres", circle.centre);
        reader.require("radius", "metres");
        reader.number("radius", kAnyLength, circle.radius);
        reader.require("count", "people");
        reader.integer("count", {1, kMostPeople}, circle.count);
        reader.number("ring_spacing", kAnyLength, circle.ring_spacing);
        reader.number("along", kAnyLength, circle.along);
        if ((circle.ring_spacing > 0.0) != (circle.along > 0.0))
            diagnostics_.error(
                reader.where(), "`ring_spacing` and `along` go together",
                "the first is the distance between rings, the second between neighbours on a ring");
        return circle;
    }

    GridFormation readGrid(ObjectReader& reader) {
        GridFormation grid;
        reader.point("origin", "the first person, [x, y] in metres", grid.origin);
        reader.require("rows", "people along the grid's +Y");
        reader.integer("rows", {1, kMostPeople}, grid.rows);
        reader.require("columns", "people along the grid's +X");
        reader.integer("columns", {1, kMostPeople}, grid.columns);
        reader.number("spacing", kAnyLength, grid.spacing);
        reader.integer("count", {1, kMostPeople}, grid.count);
        if (grid.count > grid.rows * grid.columns)
            diagnostics_.error(reader.where(), fmt::format("`count` ({}) is more than {} rows of {} hold",
                                                           grid.count, grid.rows, grid.columns));
        reader.number("jitter", {0.0, 1000.0}, grid.jitter);
        reader.number("rotation", {-3600.0, 3600.0}, grid.rotation);
        const JsonNode* goal = reader.require("goal", "{\"offset\": [dx, dy]} or a place");
        if (!goal) return grid;
        if (goal->kind != JsonNode::Kind::object || goal->find("nearest") || goal->find("choose")) {
            if (auto destination = places_.destination(*goal)) grid.goal = std::move(*destination);
            return grid;
        }
        ObjectReader inner(*goal, "`goal`", diagnostics_);
        if (goal->find("mirror")) {
            if (const auto line = lineOf(inner, "mirror", *goal)) grid.goal = *line;
        } else if (const JsonNode* box = goal->find("anywhere")) {
            const std::vector<glm::dvec2> corners = inner.points("anywhere", 2);
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

    ListFormation readList(ObjectReader& reader) {
        ListFormation list;
        reader.require("agents", "an array of people");
        eachOf(reader, "agents", [&](const JsonNode& node) {
            ListedAgent agent;
            agent.where = node.where;
            ObjectReader inner(node, "a person", diagnostics_);
            if (!inner.isObject()) return;
            inner.point("position", "[x, y] in metres", agent.position);
            inner.point("goal", "[x, y] in metres", agent.goal);
            if (const JsonNode* speed = inner.get("speed"))
                agent.speed = inner.numberOf(*speed, {0.05, 10.0});
            if (const JsonNode* radius = inner.get("radius"))
                agent.radius = inner.numberOf(*radius, {0.1, 1.0});
            if (const JsonNode* heading = inner.get("heading"))
                agent.heading = inner.numberOf(*heading, {-3600.0, 3600.0});
            inner.finish();
            list.agents.push_back(agent);
        });
        return list;
    }

    void checkWhole() {
        double people = 0.0;
        double largest = 0.0;
        for (const Flow& flow : layout_.flows) {
            people += flow.count ? static_cast<double>(*flow.count)
                                 : flow.rate.value_or(0.0) * (flow.end - flow.start);
            largest = std::max(largest, flow.people.largestRadius());
        }
        for (const Formation& formation : layout_.formations) {
            people += countOf(formation);
            largest = std::max(largest, formation.people.largestRadius());
            if (const auto* list = std::get_if<ListFormation>(&formation.shape))
                for (const ListedAgent& agent : list->agents)
                    largest = std::max(largest, agent.radius.value_or(0.0));
        }
        if (people > kMostPeople)
            diagnostics_.error(
                root_.where,
                fmt::format("about {:.0f} people are more than the {:.0f} that one bake can hold", people,
                            kMostPeople));
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

    static double countOf(const Formation& formation) {
        if (const auto* circle = std::get_if<CircleFormation>(&formation.shape))
            return static_cast<double>(circle->count);
        if (const auto* grid = std::get_if<GridFormation>(&formation.shape))
            return grid->count ? static_cast<double>(grid->count)
                               : static_cast<double>(grid->rows) * static_cast<double>(grid->columns);
        return static_cast<double>(std::get<ListFormation>(formation.shape).agents.size());
    }

    const JsonNode& root_;
    Diagnostics& diagnostics_;
    Layout layout_;
    std::optional<SourcePosition> simulation_where_;
    std::map<std::string, std::size_t> roads_, areas_, walls_, groups_;  // groups: flows by index, formations
    PlaceReader places_{roads_, areas_, diagnostics_};
};

}  // namespace

std::optional<Layout> readLayout(std::string_view text, std::span<const std::string> overrides,
                                 Diagnostics& diagnostics) {
    JsonNode root = parseJson(text, diagnostics);
    if (diagnostics.hasErrors()) return std::nullopt;
    for (const std::string& change : overrides)
        applyOverride(root, change, diagnostics);
    Layout layout = Reader(root, diagnostics).read();
    std::stable_sort(
        diagnostics.entries.begin(), diagnostics.entries.end(), [](const Diagnostic& a, const Diagnostic& b) {
            return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
        });
    if (diagnostics.hasErrors()) return std::nullopt;
    return layout;
}

}  // namespace throng::authoring
