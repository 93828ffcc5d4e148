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
#include "authoring/layout/event_reader.h"
#include "authoring/layout/flow_reader.h"
#include "authoring/layout/formation_reader.h"
#include "authoring/layout/given_reader.h"
#include "authoring/layout/goal_reader.h"
#include "authoring/layout/level_reader.h"
#include "authoring/layout/object_reader.h"
#include "authoring/layout/patch_reader.h"
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
        eachOf(reader, "flows", [this](const JsonNode& node) { flows_.read(node); });
        eachOf(reader, "formations", [this](const JsonNode& node) { formations_.read(node); });
        eachOf(reader, "given", [this](const JsonNode& node) { given_.read(node); });
        eachOf(reader, "seats", [this](const JsonNode& node) { seats_.readBlock(node); });
        eachOf(reader, "events", [this](const JsonNode& node) { events_.read(node); });
        eachOf(reader, "shows", [this](const JsonNode& node) { seats_.readShow(node); });
        eachOf(reader, "attractions", [this](const JsonNode& node) { readAttraction(node); });
        events_.sort();
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
        reader.boolean("ends_when_empty", s.ends_when_empty);
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
        if (const JsonNode* line = node.find("line"))
            layout_.flow_line = lineOf(reader, "line", *line, diagnostics_);
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
    Indices roads_, areas_, walls_, attractions_;
    Indices groups_;  // flows by index, formations
    PlaceReader places_{schema_, roads_, areas_, diagnostics_};
    LevelReader levels_{schema_, layout_, diagnostics_};
    PatchReader patches_{schema_, layout_, levels_, diagnostics_};
    GivenReader given_{schema_, layout_, levels_, groups_, diagnostics_};
    SeatReader seats_{schema_, layout_, places_, levels_, groups_, walls_, diagnostics_};
    BoardingReader boarding_{schema_, layout_, areas_, diagnostics_};
    TrafficReader traffic_{schema_, layout_, levels_, boarding_, diagnostics_};
    BehaviourReader behaviours_{schema_, layout_, places_, groups_, walls_, traffic_, diagnostics_};
    FlowReader flows_{schema_, layout_, places_, behaviours_, boarding_, groups_, diagnostics_};
    FormationReader formations_{schema_, layout_, places_, levels_, behaviours_, groups_, diagnostics_};
    EventReader events_{schema_, layout_, places_, seats_, given_, groups_, walls_, diagnostics_};
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
