// SPDX-License-Identifier: Apache-2.0
#include "sim/buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <stdexcept>

#include "base/wide_site.h"
#include "sim/wall_index.h"

namespace throng::sim {
namespace {

// How fast contact may move somebody between two decisions (m/s), and how far at the least (m), for it still
// to be sure to meet everybody it is moved into.
constexpr float kPushedAt = 1.8f, kLeastPush = 0.05f;

constexpr const char* kSitter = "person with a seat";

float fastest(const authoring::Scene& scene) {
    float speed = 0.0f;
    for (const gpu::Person& person : scene.people)
        speed = std::max(speed, person.maximum_speed);
    return speed;
}

float beltSpeed(const authoring::Scene& scene) {
    float speed = 0.0f;
    for (const gpu::Belt& belt : scene.chart_map.belts)
        speed = std::max(speed, glm::length(belt.velocity));
    return speed;
}

std::vector<gpu::AgentState> initialStates(const authoring::Scene& scene) {
    std::vector<gpu::AgentState> states;
    states.reserve(scene.people.size());
    for (const gpu::Person& person : scene.people) {
        gpu::AgentState state{};
        const bool fixed = person.flags & gpu::PERSON_FIXED_SPAWN;
        const bool present = person.flags & gpu::PERSON_PRESENT_AT_START;
        state.position =
            fixed ? person.spawn_position : scene.entry_points.at(scene.entries.at(person.entry).first_point);
        state.heading = person.heading;
        state.status = present ? gpu::STATUS_WALKING : gpu::STATUS_WAITING;
        if (person.flags & gpu::PERSON_SITS_AT_START) state.status = gpu::STATUS_SEATED;
        state.spawn_step = present ? 0 : gpu::NO_INDEX;
        state.arrival_step = gpu::NO_INDEX;
        state.stage = person.first_stage;
        state.stage_end = person.first_stage + person.stage_count;
        state.ticket = gpu::NO_INDEX;
        states.push_back(state);
    }
    return states;
}

bool isDisc(const gpu::Person& person) {
    return person.half_axis == 0.0f;
}

std::vector<gpu::Chest> initialChests(const authoring::Scene& scene) {
    std::vector<gpu::Chest> chests;
    if (std::ranges::all_of(scene.people, isDisc)) return chests;  // no program asks for them
    chests.reserve(scene.people.size());
    for (const gpu::Person& person : scene.people)
        chests.push_back({person.heading, 0.0f, person.half_axis, person.half_axis});
    return chests;
}

std::vector<std::uint32_t> initialSiteSlots(const authoring::Scene& scene, std::size_t rows) {
    std::vector<std::uint32_t> slots(rows + scene.wall_tiles.size(), gpu::NO_INDEX);
    for (std::size_t tile = 0; tile < scene.wall_tiles.size(); ++tile)
        slots[rows + tile] = static_cast<std::uint32_t>(rows + tile);
    return slots;
}

std::uint32_t pixels(float extent, float per_metre) {
    return static_cast<std::uint32_t>(std::ceil(extent * per_metre));
}

/// Two pixels per radius of the smallest tile, and never less than one per radius of the smallest body: below
/// that, bodies that stand together hide each other from the rays.
float defaultPixelsPerMetre(const authoring::Scene& scene) {
    const float smallest_tile = static_cast<float>(scene.settings.tile_radius);
    return std::max(2.0f / smallest_tile, 1.0f / std::max(scene.smallest_radius, 0.05f));
}

/// Two to the power of something, or half as much again, so that places in pixels are exact: a little less
/// will do.
float roundPixels(float per_metre) {
    constexpr float kEnough = 0.85f;
    const float power = std::exp2(std::floor(std::log2(kEnough * per_metre)));
    for (const float factor : {1.0f, 1.5f})
        if (factor * power >= kEnough * per_metre) return factor * power;
    return 2.0f * power;
}

/// Cells that one storage block of every device holds, whole strips of them.
constexpr double kMostCells = 33'554'432.0 - gpu::CELLS_PER_STRIP;

void checkCells(glm::vec2 extent, float cell_size) {
    const auto across = [&](float metres) { return std::ceil(double{metres} / double{cell_size}); };
    if (across(extent.x) * across(extent.y) <= kMostCells) return;
    throw std::runtime_error(fmt::format(
        "the layout covers {:.1f} x {:.1f} km: at most {:.0f} square kilometres fit one bake. Split the "
        "layout.",
        extent.x / 1000.0, extent.y / 1000.0, kMostCells * double{cell_size} * double{cell_size} / 1e6));
}

/// Field by field: together they may be large.
gl::Buffer makeFields(const authoring::FieldStore& store) {
    const std::size_t count = store.block_table.size() + store.fields.size() * store.cells_per_field;
    gl::Buffer buffer("distance fields", gl::Room{count, sizeof(gpu::FieldCell), "cell of a field"},
                      gl::Buffer::Use::in_ranges);
    if (count == 0) buffer.fill(0);
    if (!store.block_table.empty()) buffer.upload(store.block_table);
    std::size_t first = store.block_table.size();
    for (const auto& field : store.fields) {
        buffer.upload(std::span<const gpu::FieldCell>(*field), first);
        first += store.cells_per_field;
    }
    return buffer;
}

/// Rows behind the last one that has a behaviour have none either.
std::vector<gpu::Mind> mindsOf(const authoring::Scene& scene) {
    std::vector<gpu::Mind> minds = scene.behaviours.minds;
    gpu::Mind none{};
    none.state = gpu::NO_INDEX;
    if (!minds.empty()) minds.resize(scene.people.size(), none);
    return minds;
}

/// What only some scenes have: programs are compiled without what theirs lacks, as most devices work through
/// code that applies to nobody, too.
gl::Definitions peculiaritiesOf(const authoring::Scene& scene) {
    const auto anybody = [&](const auto& is) { return std::ranges::any_of(scene.people, is); };
    const bool may_climb = scene.terrain || !scene.chart_map.empty();
    gl::Definitions found;
    if (isWideSite(scene.minimum, scene.maximum) && scene.chart_map.empty())
        found.emplace_back("WIDE_SITE", "1");  // places are too coarse for steps
    if (!scene.road_distance.empty()) found.emplace_back("ROADS", "1");
    if (!scene.plan_changes.empty()) found.emplace_back("PLAN_CHANGES", "1");
    if (!scene.lines.empty()) found.emplace_back("WAITING_LINES", "1");
    if (anybody([](const gpu::Person& person) { return person.party_size > 1; }))
        found.emplace_back("PARTIES", "1");
    if (may_climb || !scene.traffic.empty() ||
        anybody([](const gpu::Person& person) { return person.headway > 0.0f; }))
        found.emplace_back("HEADWAYS", "1");
    return found;
}

/// As large as programs have it that are compiled with these.
std::size_t bytesOfAWalker(const gl::Definitions& definitions) {
    const std::map<std::string, std::size_t> more = {{"HEADWAYS", gl::kWord},
                                                     {"PARTIES", 2 * gl::kWord},
                                                     {"PLAN_CHANGES", gl::kWord},
                                                     {"WAITING_LINES", gl::kWord},
                                                     {"BODIES", gpu::MORE_OF_A_BODY}};
    std::size_t bytes = sizeof(gpu::Walker);
    for (const auto& [name, value] : definitions)
        if (const auto found = more.find(name); found != more.end()) bytes += found->second;
    return bytes;
}

/// A uniform block is as large as its shader says.
std::vector<gpu::Belt> roomForAll(std::vector<gpu::Belt> belts) {
    if (!belts.empty()) belts.resize(gpu::NO_CHART);
    return belts;
}

}  // namespace

gpu::Parameters makeParameters(const authoring::Scene& scene) {
    const authoring::SimulationSettings& settings = scene.settings;
    const glm::vec2 extent = glm::max(scene.maximum - scene.minimum, glm::vec2(1.0f));
    gpu::Parameters parameters{};
    parameters.step_seconds = static_cast<float>(1.0 / (settings.fps * settings.substeps));
    parameters.decision_seconds = parameters.step_seconds * static_cast<float>(settings.stepsPerDecision());
    parameters.largest_radius = scene.largest_radius;
    const float pushed = std::max(kPushedAt * parameters.decision_seconds, kLeastPush);
    parameters.contact_push = pushed + beltSpeed(scene) * parameters.decision_seconds;
    // Whose ways are given may set out as fast as they like.
    parameters.contact_gain =
        scene.given.empty() ? static_cast<float>(settings.maximum_acceleration) * parameters.decision_seconds
                            : fastest(scene);
    // Both may walk, and both may be pushed.
    const float of_each = fastest(scene) * parameters.decision_seconds + parameters.contact_push;
    parameters.contact_range =
        std::max(static_cast<float>(settings.contact_range), 2.0f * (scene.largest_radius + of_each));
    parameters.cells_minimum = scene.minimum;
    parameters.cell_size = parameters.contact_range;
    // Of charts, whole numbers of cells make a shift.
    const auto step = gpu::SHIFT_STEP;
    if (!scene.chart_map.empty()) parameters.cell_size = step / std::floor(step / parameters.cell_size);
    checkCells(extent, parameters.cell_size);
    parameters.cells_width = std::max(1u, pixels(extent.x, 1.0f / parameters.cell_size));
    parameters.cells_height = std::max(1u, pixels(extent.y, 1.0f / parameters.cell_size));
    parameters.row_count = static_cast<std::uint32_t>(scene.people.size());
    parameters.diagram_minimum = scene.minimum;
    parameters.pixels_per_metre = settings.pixels_per_metre > 0.0
                                      ? static_cast<float>(settings.pixels_per_metre)
                                      : defaultPixelsPerMetre(scene);
    // Pixels of all charts fit together, too: shifts are multiples of four metres.
    if (!scene.chart_map.empty() && settings.pixels_per_metre <= 0.0)
        parameters.pixels_per_metre = roundPixels(parameters.pixels_per_metre);
    parameters.diagram_width = pixels(extent.x, parameters.pixels_per_metre);
    parameters.diagram_height = pixels(extent.y, parameters.pixels_per_metre);
    parameters.tile_radius = static_cast<float>(settings.tile_radius);
    parameters.time_horizon = static_cast<float>(settings.time_horizon);
    parameters.wall_time_horizon = static_cast<float>(settings.wall_time_horizon);
    parameters.maximum_acceleration = static_cast<float>(settings.maximum_acceleration);
    parameters.seed = static_cast<std::uint32_t>(settings.seed ^ (settings.seed >> 32));
    parameters.queue_count = static_cast<std::uint32_t>(scene.queues.size());
    parameters.grid_minimum = scene.grid.minimum;
    parameters.grid_cell = scene.grid.cell_size;
    parameters.grid_width = scene.grid.width;
    parameters.grid_height = scene.grid.height;
    parameters.field_cell = scene.fields.block_cell;
    parameters.field_blocks_across = scene.fields.blocks_across;
    parameters.field_blocks_up = scene.fields.blocks_up;
    parameters.cells_per_field = static_cast<std::uint32_t>(scene.fields.cells_per_field);
    parameters.detour_cell = scene.detours.grid.cell_size;
    parameters.detour_width = scene.detours.grid.width;
    parameters.detour_height = scene.detours.grid.height;
    const authoring::ChartMap& charts = scene.chart_map;
    parameters.site_rows = parameters.row_count * (1 + charts.most_images);
    parameters.chart_cell = charts.grid.cell_size;
    parameters.chart_width = charts.grid.width;
    parameters.chart_height = charts.grid.height;
    return parameters;
}

std::vector<gpu::DiagramSite> wallSites(const authoring::Scene& scene, const gpu::Parameters& parameters) {
    std::vector<gpu::DiagramSite> sites;
    sites.reserve(scene.wall_tiles.size());
    for (const gpu::WallTile& tile : scene.wall_tiles) {
        gpu::DiagramSite site{};
        site.position = (tile.position - parameters.diagram_minimum) * parameters.pixels_per_metre;
        site.radius = tile.tile_radius * parameters.pixels_per_metre;
        site.id = static_cast<std::uint32_t>(parameters.site_rows + sites.size());
        sites.push_back(site);
    }
    return sites;
}

Buffers::Buffers(const authoring::Scene& scene, const gpu::Parameters& parameter_values)
    : parameters(gl::makeBuffer("parameters", std::vector{parameter_values})),
      people(gl::makeBuffer("people", scene.people, kPerson)),
      states(gl::makeBuffer<gpu::AgentState>("states", scene.people.size(), kPerson,
                                             [&] { return initialStates(scene); })),
      chests(gl::makeBuffer("chests", initialChests(scene), kPerson)),
      stages(gl::makeBuffer("stages", scene.stages, "stage")),
      plan_changes(gl::makeBuffer("plan changes", scene.plan_changes, "change of plans")),
      fields(makeFields(scene.fields)),
      field_cells(fields, gl::WordTexture::Texel::two_words),
      road_distances(gl::makeBuffer("road distances", scene.road_distance, "cell of the fields")),
      lines(gl::makeBuffer("waiting lines", scene.lines, "line")),
      line_points(gl::makeBuffer("line points", scene.line_points, "point of a line")),
      tickets("tickets", {scene.ticket_count, gl::kWord, "ticket"}),
      behaviour_states(gl::makeBuffer("behaviour states", scene.behaviours.states, "state of a behaviour")),
      behaviour_rules(gl::makeBuffer("behaviour rules", scene.behaviours.rules, "rule of a behaviour")),
      behaviour_places(gl::makeBuffer("behaviour places", scene.behaviours.places, "place of a behaviour")),
      behaviour_points(gl::makeBuffer("behaviour points", scene.behaviours.points, "point of a behaviour")),
      censuses(gl::makeBuffer("censuses", scene.behaviours.censuses, "census")),
      tallies("tallies", {scene.behaviours.censuses.size(), sizeof(gpu::Tally), "census"}),
      minds(gl::makeBuffer("minds", mindsOf(scene), kPerson)),
      seat_ways(gl::makeBuffer("ways to seats", scene.seats.ways, kSitter)),
      seat_points(gl::makeBuffer("points of ways to seats", scene.seats.points, "point of a way to a seat")),
      sitters(gl::makeBuffer("sitters", scene.seats.sitters, kSitter)),
      sitter_of_row(gl::makeBuffer("sitters by row", scene.seats.sitter_of_row, kPerson)),
      detour_slopes("detour slopes",
                    {scene.detours.distances.size(), sizeof(glm::vec2), "cell of a detour field"}),
      queues(gl::makeBuffer("queues", scene.queues, "queue")),
      queue_heads("queue heads", {scene.queues.size(), gl::kWord, "queue"}),
      entries(gl::makeBuffer("entries", scene.entries, "entry")),
      entry_points(gl::makeBuffer("entry points", scene.entry_points, "point of an entry")),
      proposals("spawn proposals",
                {scene.queues.size(), sizeof(gpu::SpawnProposal) * gpu::SPAWN_GROUP_SIZE, "queue"}),
      wall_segments(gl::makeBuffer("wall segments", scene.wall_segments, "wall segment")),
      wall_tiles(gl::makeBuffer("wall tiles", scene.wall_tiles, "wall tile")),
      chart_cells(gl::makeBuffer("chart cells", scene.chart_map.cells, "cell of a chart")),
      chart_shifts(gl::makeBuffer("chart shifts", scene.chart_map.shifts, "chart")),
      belts(gl::makeBuffer("belts", roomForAll(scene.chart_map.belts), "chart")),
      has_bodies_(!std::ranges::all_of(scene.people, isDisc)),
      has_charts_(!scene.chart_map.empty()),
      has_belts_(!scene.chart_map.belts.empty()),
      has_seats_(!scene.seats.empty()),
      peculiarities_(peculiaritiesOf(scene)) {
    const std::size_t rows = parameter_values.site_rows;
    const std::size_t cells = std::size_t{parameter_values.cells_width} * parameter_values.cells_height;
    const WallIndex walls = indexWalls(scene.wall_segments, parameter_values,
                                       parameter_values.contact_range + scene.largest_radius);
    wall_starts = gl::makeBuffer("wall starts", startsOfMarked(walls), "32 cells");
    wall_items = gl::makeBuffer("wall items", walls.items, "wall near a cell");
    const auto before_narrows = static_cast<float>(scene.settings.motion.number("nearest_first", "before"));
    narrow_cells = gl::makeBuffer(
        "narrow cells", markCells(scene.narrow_places, parameter_values, before_narrows), "32 cells");

    // One cell more than there are belongs to the last strip: where it starts is how many people there are.
    const std::size_t strips = cells / gpu::CELLS_PER_STRIP + 1;
    const auto zeros = [](const char* name, std::size_t words, const char* per) {
        gl::Buffer buffer(name, {words, gl::kWord, per});
        buffer.fill(0);
        return buffer;
    };
    cell_counts = zeros("cell counts", gpu::CELLS_PER_STRIP * strips, "cell");
    cell_offsets = zeros("cell offsets", gpu::CELLS_PER_STRIP * strips, "cell");
    strip_counts = zeros("strip counts", strips, "strip");
    strip_marks = zeros("strip marks", strips, "strip");
    strip_starts = zeros("strip starts", strips, "strip");
    const std::size_t strips_per_group = std::size_t{gpu::SCAN_GROUP_SIZE} * gpu::COUNTS_PER_THREAD;
    strip_group_sums =
        gl::Buffer("strip group sums", {strips / strips_per_group + 1, gl::kWord, "group of strips"});
    strip_list = gl::Buffer("listed strips", {std::min(strips, 2 * rows), gl::kWord, "strip"});
    strip_list_end = gl::makeBuffer("end of listed strips", std::vector<std::uint32_t>{0});
    fill_dispatch = gl::Buffer("fill dispatch", gl::kWord * 4);
    row_cells = gl::Buffer("row cells", {rows, gl::kWord, kPerson});
    row_cells.fill(gpu::NO_INDEX);
    live_dispatch = gl::Buffer("live dispatch", gl::kWord * 4);
    live_dispatch.fill(0);

    site_slots = gl::makeBuffer("site slots", initialSiteSlots(scene, rows), kSite);
    bodies = gl::Buffer("bodies", {rows, sizeof(gpu::Body), kPerson});
    walkers = gl::Buffer("walkers", {rows, bytesOfAWalker(definitions()), kPerson});
    sites = gl::Buffer("sites", {rows + scene.wall_tiles.size(), sizeof(gpu::DiagramSite), kSite});
    const std::vector<gpu::DiagramSite> fixed = wallSites(scene, parameter_values);
    if (!fixed.empty()) sites.upload(std::span<const gpu::DiagramSite>(fixed), rows);

    // And a word for the vehicles that somebody heeds.
    const std::size_t heeded = scene.traffic.empty() ? 0 : 1;
    neighbours = gl::Buffer(
        "neighbours",
        {rows, gl::kWord * (static_cast<std::size_t>(scene.settings.neighbours) + heeded), kPerson});
    neighbours.fill(gpu::NO_INDEX);
    neighbour_counts = gl::Buffer("neighbour counts", {rows, gl::kWord, kPerson});
    touch_words = gl::Buffer("touch words", {rows, gl::kWord, kPerson});
    touch_lists = gl::Buffer("touch lists", {rows, gl::kWord * gpu::TOUCH_WORDS, kPerson});
    if (has_bodies_) near_lists = gl::Buffer("near lists", {rows, gl::kWord * gpu::NEAR_WORDS, kPerson});
    touch_slots = gl::Buffer("touch slots", {rows, gl::kWord, kPerson});
    touch_dispatch = gl::Buffer("touch dispatch", gl::kWord * 4);
    weights = gl::Buffer("weights", {rows, sizeof(glm::vec2), kPerson});
    preferred_velocities = gl::Buffer("preferred velocities", {rows, sizeof(glm::vec2), kPerson});
    decisions = gl::Buffer(
        "decisions", {rows, sizeof(gpu::Decision) + (has_bodies_ ? gpu::MORE_OF_A_DECISION : 0), kPerson});
    ways = gl::Buffer("ways", {rows, sizeof(glm::vec2), kPerson});
    const std::size_t target_bytes = has_bodies_ ? sizeof(glm::vec4) : sizeof(glm::vec2);
    targets = gl::Buffer("targets", {rows, target_bytes, kPerson});
    targets_after = gl::Buffer("targets after contact", {rows, target_bytes, kPerson});
    if (hasCharts()) {
        slot_images = gl::Buffer("slot images", {rows, sizeof(gpu::SlotImage), kPerson});
        row_slots = gl::Buffer("row slots", {scene.people.size(), gl::kWord, kPerson});
    }
    if (!scene.chart_map.lifts.empty()) makeLifts(scene.chart_map.lifts, scene.people.size());
    if (!scene.traffic.empty()) makeTraffic(scene.traffic);
    if (scene.traffic.hasDoors()) makeBoarding(scene.traffic, scene.people.size());
    queue_heads.fill(0);
    tickets.fill(0);
    detour_slopes.fill(0);
}

void Buffers::makeLifts(const authoring::LiftMap& lifts, std::size_t people_count) {
    std::vector<gpu::LiftState> states_at_start;
    for (const gpu::LiftPlan& plan : lifts.plans) {
        gpu::LiftState state{};
        state.height = lifts.stops.at(plan.first_stop).height;
        states_at_start.push_back(state);
    }
    lift_plans = gl::makeBuffer("lifts", lifts.plans, "lift");
    lift_stops = gl::makeBuffer("stops of lifts", lifts.stops, "stop of a lift");
    cabin_stops = gl::makeBuffer("cabins", lifts.stop_of, "chart");
    lift_states = gl::makeBuffer("states of lifts", states_at_start, "lift");
    lift_wishes = gl::Buffer("wishes of lifts", {lifts.plans.size(), sizeof(gpu::LiftWishes), "lift"});
    lift_queues = gl::Buffer("queues before lifts", {lifts.stops.size(), gl::kWord, "stop of a lift"});
    riders = gl::Buffer("riders", {people_count, gl::kWord, kPerson});
    for (gl::Buffer* each : {&lift_wishes, &lift_queues, &riders})
        each->fill(0);
    lifts_ = {{"LIFTS", fmt::format("{}u", lifts.plans.size())},
              {"LIFT_STOPS", fmt::format("{}u", lifts.stops.size())}};
}

void Buffers::makeTraffic(const authoring::SceneTraffic& traffic) {
    // Room for some that never come: programs are compiled anew for a few numbers of vehicles only.
    std::vector<gpu::Vehicle> all = traffic.vehicles;
    gpu::Vehicle gone{};
    gone.status = gpu::VEHICLE_GONE;
    if (!all.empty()) all.resize(std::bit_ceil(all.size()), gone);
    vehicles = gl::makeBuffer("vehicles", all, "vehicle");
    vehicle_boxes = gl::Buffer("vehicle boxes", {gpu::MOST_VEHICLES, sizeof(gpu::VehicleBox), "vehicle"});
    vehicle_boxes.fill(0);
    lanes = gl::makeBuffer("lanes", traffic.lanes, "lane");
    lane_points = gl::makeBuffer("lane points", traffic.lane_points, "point of a lane");
    traffic_stops = gl::makeBuffer("traffic stops", traffic.stops, "stop of a lane");
    crossings = gl::makeBuffer("crossings", traffic.crossings, "crossing");
    crossing_points = gl::makeBuffer("crossing points", traffic.crossing_points, "point of a crossing");
    lights = gl::Buffer("lights", {traffic.lights.size(), gl::kWord, "light"});
    lights.fill(gpu::LIGHT_RED);
    in_the_way =
        gl::Buffer("people in the way", {all.size() + traffic.stops.size(), gl::kWord, "vehicle or stop"});
    traffic_ = {{"TRAFFIC", "1"},
                {"VEHICLES", fmt::format("{}u", all.size())},
                {"LANES", fmt::format("{}u", traffic.lanes.size())},
                {"CROSSINGS", fmt::format("{}u", traffic.crossings.size())}};
}

void Buffers::makeBoarding(const authoring::SceneTraffic& traffic, std::size_t people_count) {
    std::vector<gpu::VehicleService> services = traffic.services;
    services.resize(std::bit_ceil(services.size()));
    vehicle_services = gl::makeBuffer("services of vehicles", services, "vehicle");
    vehicle_doors = gl::makeBuffer("doors of vehicles", traffic.doors, "door of a vehicle");
    platforms = gl::makeBuffer("platforms", traffic.platforms, "platform");
    platform_points = gl::makeBuffer("platform points", traffic.platform_points, "point of a platform");
    calls = gl::makeBuffer("calls", traffic.calls, "call of those who get off");
    door_states = gl::Buffer("states of doors", {traffic.doors.size(), sizeof(gpu::DoorState), "door"});
    door_wishes = gl::Buffer("wishes of doors", {traffic.doors.size(), sizeof(gpu::DoorWishes), "door"});
    new_aboard = gl::Buffer("new aboard", {services.size(), gl::kWord, "vehicle"});
    call_heads = gl::Buffer("heads of calls", {traffic.calls.size(), gl::kWord, "call"});
    passengers = gl::Buffer("passengers", {people_count, gl::kWord, kPerson});
    platform_vehicles =
        gl::Buffer("vehicles at platforms", {traffic.platforms.size(), gl::kWord, "platform"});
    for (gl::Buffer* each : {&door_states, &door_wishes, &new_aboard, &call_heads, &passengers})
        each->fill(0);
    platform_vehicles.fill(gpu::NO_INDEX);
    traffic_.emplace_back("DOORS", "1");
    traffic_.emplace_back("PLATFORMS", fmt::format("{}u", traffic.platforms.size()));
}

gl::ComputeProgram Buffers::connect(const gl::ShaderLibrary& library, const gl::Declaration& declaration,
                                    const gl::Definitions& definitions) const {
    gl::ComputeProgram program(library, declaration, definitions);
    program.bindAll(named());
    if (program.hasUniform("field_cells")) program.bind("field_cells", field_cells);
    return program;
}

gl::Definitions Buffers::definitions(const MotionSettings& rules) const {
    gl::Definitions all = rules.definitions();
    for (const auto& definition : definitions())
        all.push_back(definition);
    return all;
}

gl::Definitions Buffers::definitions() const {
    gl::Definitions all;
    if (has_bodies_) all.emplace_back("BODIES", "1");
    if (hasCharts()) all.emplace_back("CHARTS", "1");
    if (has_belts_) all.emplace_back("BELTS", "1");
    if (has_seats_) all.emplace_back("SEATS", "1");
    all.insert(all.end(), peculiarities_.begin(), peculiarities_.end());
    all.insert(all.end(), lifts_.begin(), lifts_.end());
    all.insert(all.end(), traffic_.begin(), traffic_.end());
    return all;
}

std::vector<std::pair<std::string, const gl::Buffer*>> Buffers::named() const {
    return {{"ParametersBlock", &parameters},
            {"People", &people},
            {"States", &states},
            {"Chests", &chests},
            {"Stages", &stages},
            {"PlanChanges", &plan_changes},
            {"WaitingLines", &lines},
            {"LinePoints", &line_points},
            {"Tickets", &tickets},
            {"RoadDistances", &road_distances},
            {"ChartCells", &chart_cells},
            {"ChartShifts", &chart_shifts},
            {"Belts", &belts},
            {"SlotImages", &slot_images},
            {"LiftPlans", &lift_plans},
            {"LiftStops", &lift_stops},
            {"CabinStops", &cabin_stops},
            {"LiftStates", &lift_states},
            {"LiftWishesBlock", &lift_wishes},
            {"LiftQueues", &lift_queues},
            {"Riders", &riders},
            {"Vehicles", &vehicles},
            {"VehicleBoxes", &vehicle_boxes},
            {"VehicleBoxesMade", &vehicle_boxes},
            {"Lanes", &lanes},
            {"LanePoints", &lane_points},
            {"TrafficStops", &traffic_stops},
            {"Crossings", &crossings},
            {"CrossingPoints", &crossing_points},
            {"Lights", &lights},
            {"InTheWay", &in_the_way},
            {"VehicleServices", &vehicle_services},
            {"VehicleDoors", &vehicle_doors},
            {"DoorStates", &door_states},
            {"DoorWishesBlock", &door_wishes},
            {"NewAboard", &new_aboard},
            {"Passengers", &passengers},
            {"Platforms", &platforms},
            {"PlatformPoints", &platform_points},
            {"PlatformVehicles", &platform_vehicles},
            {"AlightingCalls", &calls},
            {"CallHeads", &call_heads},
            {"RowSlots", &row_slots},
            {"BehaviourStates", &behaviour_states},
            {"BehaviourRules", &behaviour_rules},
            {"BehaviourPlaces", &behaviour_places},
            {"BehaviourPoints", &behaviour_points},
            {"Censuses", &censuses},
            {"Tallies", &tallies},
            {"Minds", &minds},
            {"SeatWays", &seat_ways},
            {"SeatPoints", &seat_points},
            {"Sitters", &sitters},
            {"SitterOfRow", &sitter_of_row},
            {"DetourSlopes", &detour_slopes},
            {"Queues", &queues},
            {"QueueHeads", &queue_heads},
            {"Entries", &entries},
            {"EntryPoints", &entry_points},
            {"Proposals", &proposals},
            {"WallSegments", &wall_segments},
            {"WallTiles", &wall_tiles},
            {"WallStarts", &wall_starts},
            {"WallItems", &wall_items},
            {"NarrowCells", &narrow_cells},
            {"CellCounts", &cell_counts},
            {"CellOffsets", &cell_offsets},
            {"StripCounts", &strip_counts},
            {"StripMarks", &strip_marks},
            {"StripStarts", &strip_starts},
            {"Counts", &strip_counts},
            {"StripList", &strip_list},
            {"StripListEnd", &strip_list_end},
            {"FillDispatch", &fill_dispatch},
            {"GroupSums", &strip_group_sums},
            {"RowCells", &row_cells},
            {"LooseRows", &touch_slots},
            {"LiveDispatch", &live_dispatch},
            {"SiteSlots", &site_slots},
            {"Bodies", &bodies},
            {"Walkers", &walkers},
            {"Sites", &sites},
            {"Neighbours", &neighbours},
            {"NeighbourCounts", &neighbour_counts},
            {"TouchWords", &touch_words},
            {"TouchLists", &touch_lists},
            {"NearLists", &near_lists},
            {"TouchSlots", &touch_slots},
            {"TouchDispatch", &touch_dispatch},
            {"Weights", &weights},
            {"PreferredVelocities", &preferred_velocities},
            {"Decisions", &decisions},
            {"Ways", &ways},
            {"Targets", &targets},
            {"TargetsAfter", &targets_after}};
}

}  // namespace throng::sim
