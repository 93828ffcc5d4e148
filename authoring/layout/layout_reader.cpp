// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/layout_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "authoring/layout/object_reader.h"
#include "authoring/layout/polygon_check.h"
#include "authoring/layout/profiles.h"

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
        eachOf(reader, "roads", [this](const JsonNode& node) { readRoad(node); });
        eachOf(reader, "areas", [this](const JsonNode& node) { readArea(node); });
        eachOf(reader, "walls", [this](const JsonNode& node) { readWall(node); });
        nameWalls();
        eachOf(reader, "flows", [this](const JsonNode& node) { readFlow(node); });
        eachOf(reader, "formations", [this](const JsonNode& node) { readFormation(node); });
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
        reader.boolean("avoid_congestion", s.avoid_congestion);
        reader.number("maximum_acceleration", {0.1, 100.0}, s.maximum_acceleration);
        reader.finish();
        simulation_where_ = node.where;
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

    std::optional<Place> placeOf(const JsonNode& node) {
        if (node.kind != JsonNode::Kind::text) {
            diagnostics_.error(node.where, fmt::format("expected a place, found {}", node.kindName()),
                               "\"road:start\", \"road:end\" or an area's id");
            return std::nullopt;
        }
        if (const auto area = areas_.find(node.text); area != areas_.end())
            return Place{Place::Kind::area, area->second, node.where};
        const std::size_t colon = node.text.rfind(':');
        const std::string id = node.text.substr(0, colon);
        const std::string end = colon == std::string::npos ? "" : node.text.substr(colon + 1);
        const auto road = roads_.find(id);
        if (road != roads_.end() && (end == "start" || end == "end"))
            return Place{end == "start" ? Place::Kind::road_start : Place::Kind::road_end, road->second,
                         node.where};
        std::vector<std::string> known;
        for (const auto& [name, index] : areas_)
            known.push_back(name);
        for (const auto& [name, index] : roads_) {
            known.push_back(name + ":start");
            known.push_back(name + ":end");
        }
        const std::string what = road != roads_.end()
                                     ? fmt::format("`{}` names a road, not one of its ends", node.text)
                                     : fmt::format("there is no place `{}`", node.text);
        diagnostics_.error(node.where, what, hintFor(node.text, known));
        return std::nullopt;
    }

    Distribution distributionOf(ObjectReader& people, const std::string& key, Limits limits,
                                Distribution standard) {
        const JsonNode* node = people.get(key);
        if (!node) return standard;
        if (node->kind == JsonNode::Kind::number) {
            const double value = people.numberOf(*node, limits).value_or(standard.mean);
            return {Distribution::Kind::constant, value, 0.0, value, value};
        }
        if (node->kind != JsonNode::Kind::object) {
            diagnostics_.error(node->where,
                               fmt::format("expected a number or a distribution, found {}", node->kindName()),
                               "for example 1.3, {\"uniform\": [1.0, 1.6]} or {\"normal\": [1.34, 0.26]}");
            return standard;
        }
        ObjectReader reader(*node, "a distribution", diagnostics_);
        const JsonNode* uniform = reader.get("uniform");
        const JsonNode* normal = reader.get("normal");
        Distribution result = standard;
        if ((uniform != nullptr) == (normal != nullptr)) {
            diagnostics_.error(node->where, "a distribution needs exactly one of `uniform` and `normal`");
        } else {
            const JsonNode& pair = uniform ? *uniform : *normal;
            if (pair.kind != JsonNode::Kind::array || pair.items.size() != 2) {
                diagnostics_.error(pair.where, uniform ? "expected [minimum, maximum]"
                                                       : "expected [mean, standard deviation]");
            } else if (uniform) {
                const auto least = reader.numberOf(pair.items[0], limits);
                const auto most = reader.numberOf(pair.items[1], limits);
                if (least && most && *least > *most)
                    diagnostics_.error(pair.where, "the minimum is above the maximum", "swap the two");
                if (least && most)
                    result = {Distribution::Kind::uniform, 0.5 * (*least + *most), 0.0, *least, *most};
            } else {
                const auto mean = reader.numberOf(pair.items[0], limits);
                const auto deviation = reader.numberOf(pair.items[1], {0.0, 100.0});
                result = {Distribution::Kind::normal, mean.value_or(standard.mean), deviation.value_or(0.0),
                          limits.least, limits.most};
                if (mean && deviation) {
                    result.minimum = std::max(limits.least, *mean - 3.0 * *deviation);
                    result.maximum = std::min(limits.most, *mean + 3.0 * *deviation);
                }
            }
        }
        if (normal) {
            reader.number("min", limits, result.minimum);
            reader.number("max", limits, result.maximum);
            if (result.minimum > result.maximum)
                diagnostics_.error(
                    node->where,
                    fmt::format("`min` ({:.6g}) is above `max` ({:.6g})", result.minimum, result.maximum),
                    "what is not written is three deviations from the mean");
        }
        reader.finish();
        return result;
    }

    People peopleOf(ObjectReader& owner) {
        People people;
        const JsonNode* node = owner.get("people");
        if (!node) return people;
        ObjectReader reader(*node, "`people`", diagnostics_);
        if (const JsonNode* profile = reader.get("profile")) readProfile(reader, *profile, people);
        PersonSettings common;
        const bool has_speed = node->find("speed") != nullptr;
        const bool has_radius = node->find("radius") != nullptr;
        common.speed = distributionOf(reader, "speed", {0.05, 10.0}, common.speed);
        common.radius = distributionOf(reader, "radius", {0.1, 1.0}, common.radius);
        reader.number("maximum_speed_factor", {1.0, 3.0}, common.maximum_speed_factor);
        reader.number("headway", {0.0, 5.0}, common.headway);
        reader.finish();
        for (PeopleShare& share : people.kinds) {
            if (has_speed) share.settings.speed = common.speed;
            if (has_radius) share.settings.radius = common.radius;
            share.settings.maximum_speed_factor = common.maximum_speed_factor;
            share.settings.headway = common.headway;
        }
        return people;
    }

    void readProfile(ObjectReader& people_reader, const JsonNode& node, People& people) {
        std::vector<std::string> names;
        names.reserve(kProfiles.size());
        for (const Profile& profile : kProfiles)
            names.emplace_back(profile.name);
        people.kinds.clear();
        if (node.kind == JsonNode::Kind::object) {
            ObjectReader reader(node, "`profile`", diagnostics_);
            for (const Profile& profile : kProfiles) {
                if (!node.find(std::string(profile.name))) continue;
                double weight = 0.0;
                reader.number(std::string(profile.name), {0.0, 1.0e6, true}, weight);
                people.kinds.push_back({weight, profile.settings});
            }
            reader.finish();
            if (people.kinds.empty())
                diagnostics_.error(node.where, "`profile` names nobody",
                                   R"(for example {"adult": 0.8, "child": 0.2})");
        } else if (const auto chosen = people_reader.choice("profile", names)) {
            people.kinds.push_back({1.0, kProfiles[*chosen].settings});
        }
        if (people.kinds.empty()) people.kinds.emplace_back();
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
        const std::optional<Place> from_place = from ? placeOf(*from) : std::nullopt;
        const std::optional<Place> to_place = to ? placeOf(*to) : std::nullopt;
        eachOf(reader, "via", [&](const JsonNode& item) {
            if (const auto place = placeOf(item)) flow.via.push_back(*place);
        });
        readAmount(reader, node, flow);
        reader.number("start", {0.0, 86400.0}, flow.start);
        reader.number("end", {0.0, 86400.0}, flow.end);
        if (flow.end <= flow.start)
            diagnostics_.error(node.find("end") ? node.find("end")->where : node.where,
                               fmt::format("the flow ends ({:.6g} s) {} it starts ({:.6g} s)", flow.end,
                                           flow.end < flow.start ? "before" : "when", flow.start));
        flow.people = peopleOf(reader);
        readArrival(reader, flow.arrival);
        reader.finish();
        claimId(node, flow.id, groups_, 0, "a flow or formation");
        if (!from_place || !to_place) return;
        flow.from = *from_place;
        flow.to = *to_place;
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
        reader.number("rate", {0.0, 1.0e5, true}, per_second);
        if (count) flow.count = people;
        if (rate) flow.rate = per_second;
    }

    void checkEnds(const Flow& flow) {
        if (flow.from.kind == flow.to.kind && flow.from.index == flow.to.index && flow.via.empty()) {
            diagnostics_.error(flow.to.where, fmt::format("flow `{}` goes to where it comes from", flow.id));
            return;
        }
        const bool same_road = flow.from.kind == Place::Kind::road_end &&
                               flow.to.kind == Place::Kind::road_start && flow.from.index == flow.to.index;
        if (same_road && flow.via.empty() && layout_.roads[flow.from.index].one_way)
            diagnostics_.error(flow.from.where,
                               fmt::format("flow `{}` walks against the one-way road `{}`", flow.id,
                                           layout_.roads[flow.from.index].id),
                               "swap `from` and `to`, or drop the road's `one_way`");
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
        formation.people = peopleOf(reader);
        readArrival(reader, formation.arrival);
        reader.number("goal_tolerance", {0.01, 100.0}, formation.goal_tolerance);
        if (type) reader.finish();
        claimId(node, formation.id, groups_, 0, "a flow or formation");
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
        if (goal->kind != JsonNode::Kind::object) {
            if (const auto place = placeOf(*goal)) grid.goal = *place;
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
    std::map<std::string, std::size_t> roads_, areas_, walls_, groups_;
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
