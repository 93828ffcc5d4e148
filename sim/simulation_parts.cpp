// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/diagram/bands.h"

namespace throng::sim {
namespace {

const gl::Declaration kPack = {"frame",
                               {"shaders/frame/pack_frame.comp"},
                               {"ParametersBlock", "People", "States", "Stages", "ChartCells", "ChartShifts",
                                "SitterOfRow", "SeatWays", "SeatPoints", "Sitters"},
                               {"FrameBlock"}};

SensingOptions sensingFor(const authoring::Scene& scene, const gpu::Parameters& parameters) {
    SensingOptions options;
    options.proximity = scene.settings.proximity;
    options.geometry.body_radius = scene.smallest_radius;
    options.geometry.tile_radius = static_cast<float>(scene.settings.tile_radius);
    options.geometry.samples_per_ray = scene.settings.samples_per_ray;
    options.geometry.field_of_view =
        static_cast<float>(scene.settings.field_of_view * std::numbers::pi / 180.0);
    options.neighbours = scene.settings.neighbours;
    options.felt_range = parameters.contact_range;
    return options;
}

constexpr double kMostWholePixels = 33'554'432.0;  // 128 MiB: what every device's storage blocks hold

/// Pages where neither one buffer or texture can hold the window nor bands of it do, and where most of a
/// large window is empty: then clearing and gathering only what exists makes up for looking up where it is.
bool isBestPaged(const DiagramOptions& options, const authoring::Scene& scene,
                 const gpu::Parameters& parameters) {
    constexpr std::uint32_t kMostWholeSide = 16'384;
    constexpr double kWorthwhilePixels = 4'194'304.0;
    const double pixels = static_cast<double>(options.width) * options.height;
    const bool in_bands = options.bands.areUsed();
    if (!in_bands && (pixels > kMostWholePixels || std::max(options.width, options.height) > kMostWholeSide))
        return true;
    if (pixels < kWorthwhilePixels || options.method != DiagramMethod::binned) return false;
    const std::uint64_t most =
        Pages::pagesNeeded(options.width, options.height, options.largest_radius, options.live_capacity);
    const auto is_little = [&](std::uint64_t pages) {
        return static_cast<double>(pages * kPagePixels) < 0.25 * pixels;
    };
    if (scene.wall_tiles.empty() || !is_little(most)) return is_little(most);
    const FixedSquares walls(options.width, options.height, wallSites(scene, parameters));
    return is_little(most + walls.squares.size());
}

/// A diagram of a large crowd takes nearly as much room as the crowd: a fifth of it at a time is enough.
/// Small ones do without: there is little to save, and each band takes two launches more.
BandShape bandsFor(const DiagramOptions& options, const gpu::Parameters& parameters) {
    constexpr double kWorthwhilePixels = 1'048'576.0, kMostKeptPixels = 16'777'216.0;
    constexpr double kShare = 0.2, kMostShare = 0.6;
    const double pixels = static_cast<double>(options.width) * options.height;
    const bool possible = options.method == DiagramMethod::binned && !options.vehicles;
    if (!possible || pixels < kWorthwhilePixels) return {};
    BandShape shape;
    shape.bin_side = parameters.cell_size * parameters.pixels_per_metre;
    const double lines = std::min(kShare * options.height, kMostKeptPixels / options.width);
    shape.bin_lines = std::max(1u, static_cast<std::uint32_t>(std::round(lines / double{shape.bin_side})));
    const double kept = static_cast<double>(shape.lines(options.look)) * options.width;
    return kept < std::min(kMostShare * pixels, kMostWholePixels) ? shape : BandShape{};
}

/// How far people look at the diagram, px: as far as their rays go, and themselves.
float lookOf(const authoring::Scene& scene, const gpu::Parameters& parameters) {
    const float tile = std::max(parameters.tile_radius, scene.largest_radius);
    const float reach = sensingReach(sensingFor(scene, parameters).geometry);
    return std::max(reach, tile) * parameters.pixels_per_metre;
}

std::optional<VehicleSites> vehiclesOf(const authoring::Scene& scene, const gpu::Parameters& parameters,
                                       const Buffers& buffers) {
    if (scene.traffic.vehicles.empty()) return std::nullopt;
    VehicleSites sites;
    sites.boxes = &buffers.vehicle_boxes;
    sites.definitions = buffers.trafficDefinitions();
    sites.count = static_cast<std::uint32_t>(buffers.vehicles.bytes() / sizeof(gpu::Vehicle));
    sites.first_id = parameters.site_rows + static_cast<std::uint32_t>(scene.wall_tiles.size());
    sites.pixels_per_metre = parameters.pixels_per_metre;
    sites.minimum = parameters.diagram_minimum;
    sites.reach = static_cast<float>(scene.settings.tile_radius) * sites.pixels_per_metre;
    for (const gpu::Vehicle& vehicle : scene.traffic.vehicles) {
        sites.longest = std::max(sites.longest, vehicle.length * sites.pixels_per_metre);
        sites.widest = std::max(sites.widest, vehicle.half_width * sites.pixels_per_metre);
    }
    return sites;
}

}  // namespace

DiagramOptions diagramOptions(const authoring::Scene& scene, const gpu::Parameters& parameters,
                              const Buffers& buffers) {
    DiagramOptions options;
    options.method = scene.settings.method;
    if (options.method == DiagramMethod::automatic) options.method = DiagramMethod::binned;
    options.cone_sides = static_cast<std::uint32_t>(scene.settings.cone_sides);
    options.width = parameters.diagram_width;
    options.height = parameters.diagram_height;
    options.live_capacity = parameters.site_rows;
    options.largest_radius =
        std::max(parameters.tile_radius, scene.largest_radius) * parameters.pixels_per_metre;
    options.look = lookOf(scene, parameters);
    options.vehicles = vehiclesOf(scene, parameters, buffers);
    options.bands = bandsFor(options, parameters);
    options.paged = isBestPaged(options, scene, parameters);
    if (options.paged) options.bands = {};
    return options;
}

DiagramLoad diagramLoad(const authoring::Scene& scene, const gpu::Parameters& parameters) {
    DiagramLoad load;
    load.radius =
        double{std::max(parameters.tile_radius, parameters.largest_radius)} * parameters.pixels_per_metre;
    load.pixels = static_cast<double>(parameters.diagram_width) * parameters.diagram_height;
    load.fixed_sites = static_cast<double>(scene.wall_tiles.size());
    return load;
}

Simulation::Parts::Parts(const authoring::Scene& scene, const gl::ShaderLibrary& shader_library,
                         const CostModel& cost_model)
    : library(shader_library),
      settings(scene.settings),
      parameters(makeParameters(scene)),
      buffers(scene, parameters),
      diagram(library, diagramOptions(scene, parameters, buffers), wallSites(scene, parameters)),
      cells(library, buffers, parameters),
      kept(buffers),
      behaviour(scene.behaviours.empty()
                    ? std::nullopt
                    : std::optional<Behaviour>(std::in_place, library, buffers, scene, settings.motion)),
      congestion(library, buffers, scene, parameters),
      spawner(library, buffers, parameters, settings.motion),
      sensing(library, buffers, diagram, sensingFor(scene, parameters), scene, parameters),
      hiding(scene.hiding_walls.empty()
                 ? std::nullopt
                 : std::optional<Hiding>(std::in_place, library, buffers, scene, parameters,
                                         std::max(sensingReach(sensingFor(scene, parameters).geometry),
                                                  parameters.contact_range))),
      slopes(TerrainSlopes::of(scene)),
      seams(buffers.hasCharts() ? std::optional<Seams>(std::in_place, library, buffers, settings.motion)
                                : std::nullopt),
      lifts(scene.chart_map.lifts.empty()
                ? std::nullopt
                : std::optional<Lifts>(std::in_place, library, buffers, scene, settings.motion)),
      boarding(scene.traffic.hasDoors()
                   ? std::optional<Boarding>(std::in_place, library, buffers, scene, settings.motion)
                   : std::nullopt),
      patches(scene.patches.slow.empty() ? std::nullopt
                                         : std::optional<Patches>(std::in_place, library, buffers, scene)),
      sizes(scene.patches.sized.empty() ? std::nullopt
                                        : std::optional<Sizes>(std::in_place, library, buffers, scene)),
      given(scene.given.empty() ? std::nullopt
                                : std::optional<Given>(std::in_place, library, buffers, scene)),
      seats(scene.seats.empty()
                ? std::nullopt
                : std::optional<Seats>(std::in_place, library, buffers, scene, settings.motion)),
      avoidance(library, buffers, settings.neighbours, slopes ? &*slopes : nullptr, settings.motion,
                seams ? &*seams : nullptr),
      contacts(library, buffers, settings.contact_iterations, settings.motion, seams ? &*seams : nullptr),
      motion(library, buffers, contacts.result(), settings.motion),
      lines(library, buffers, static_cast<std::uint32_t>(scene.lines.size())),
      gates(scene, buffers, diagram, parameters),
      traffic(scene.traffic.empty()
                  ? std::nullopt
                  : std::optional<Traffic>(std::in_place, library, scene, buffers, contacts.result())),
      pack(buffers.connect(library, kPack, buffers.definitions())),
      costs(cost_model),
      look(double{lookOf(scene, parameters)}),
      rows(parameters.row_count),
      anybody_enters_later(std::ranges::any_of(scene.people, [](const gpu::Person& person) {
          return (person.flags & gpu::PERSON_PRESENT_AT_START) == 0;
      })) {
    // Slots are in the order of the cells, and cells and diagram have one origin.
    const BinGrid cell_grid(parameters.cell_size * parameters.pixels_per_metre,
                            {parameters.cells_width, parameters.cells_height});
    diagram.connect({&buffers.sites, &buffers.live_dispatch, &buffers.site_slots,
                     DiagramInput::Sorted{&buffers.strip_starts, &buffers.cell_offsets, cell_grid}});
    if (diagram.bands()) {
        const bool is_known = !costs.only(DiagramMethod::binned).costs.empty();
        costs = (is_known ? costs : CostModel::builtIn()).only(DiagramMethod::binned);
    }
    load = diagramLoad(scene, parameters);
    passes = passesOfStep();
    for (const gpu::Platform& platform : scene.traffic.platforms)
        platform_sides.push_back(platform.side);
}

std::vector<Pass> Simulation::Parts::passesOfLooking() {
    const auto build = [this] { stopped = !diagram.build(extent); };
    const auto sense = [this] {
        sensing.run();
        if (hiding) hiding->run();
    };
    if (!sensing.needsDiagram()) return {{"sensing", sense}};
    if (!diagram.bands()) return {{"diagram", build}, {"sensing", sense}};
    std::vector<Pass> all = {{"diagram", build}};
    for (std::uint32_t band = 0; band < diagram.bands()->count(); ++band) {
        all.push_back({"diagram", [this, band] { diagram.buildBand(band, extent); }});
        all.push_back({"sensing", [this, band] { sensing.run(band); }});
    }
    if (hiding) all.push_back({"sensing", [this] { hiding->run(); }});
    return all;
}

void Simulation::Parts::lookRound() {
    for (const Pass& pass : passesOfLooking())
        pass.run();
}

std::vector<Pass> Simulation::Parts::passesOfStep() {
    const auto enter = [this] {
        if (anybody_enters_later) spawner.run(step_start, steps_done);
    };
    const auto decide = [this] {
        if (decides)
            avoidance.run(steps_done, [this] { changeWishes(); });
        else
            avoidance.carryOn();
    };
    const auto when_deciding = [this](auto pass) {
        return [this, pass] {
            if (decides) pass();
        };
    };
    const auto move = [this] {
        motion.run(steps_done);
        lines.run();
        if (given) given->place(steps_done, endOfStep(), parameters.step_seconds);
    };
    const auto sort = [this] {
        if (seams) seams->cross();
        cells.run();
    };
    const auto ride = [this] {
        lifts->move();
        if (decides) lifts->serve();
    };
    const auto board = [this] {
        boarding->move();
        if (decides) boarding->serve(step_start, steps_done);
    };
    const auto touch = [this] {
        const auto hold = [this](const gl::Buffer& targets) {
            if (given) given->hold(targets, endOfStep());
        };
        contacts.run(hold);
        if (traffic) traffic->keepOff();
        if (lifts) lifts->keepOut(contacts.result());
        if (traffic) hold(contacts.result());
    };
    std::vector<Pass> all = {{"cells", when_deciding(sort)},
                             {"routes", when_deciding([this] { congestion.run(); })},
                             {"spawn", when_deciding(enter)}};
    for (const Pass& pass : passesOfLooking())
        all.push_back({pass.name, when_deciding(pass.run)});
    all.insert(all.end(), {{"avoidance", decide}, {"contacts", touch}, {"motion", move}});
    // Who has come in walks on at once, and others see them: until the next decision nobody gets a slot.
    const bool sorts_again = anybody_enters_later || boarding;
    if (sorts_again) all.insert(all.begin() + 3, {"cells", when_deciding(sort)});
    // What they make of somebody's pace would not outlive another sorting, and who has come in has a goal at
    // once.
    if (behaviour)
        all.insert(all.begin() + (sorts_again ? 4 : 1), {"behaviour", when_deciding([this] {
                                                             if (seats) seats->think(step_start, steps_done);
                                                             behaviour->run(step_start, steps_done);
                                                         })});
    if (lifts) all.insert(all.begin() + 1, {"lifts", ride});
    if (boarding) all.insert(all.begin() + 1, {"boarding", board});
    if (sizes) all.insert(all.begin() + 1, {"sizes", when_deciding([this] { sizes->run(step_start); })});
    if (seats) all.insert(all.begin(), Pass{"seats", [this] { seats->lead(decides, steps_done); }});
    // Before anybody looks where they are.
    if (traffic && traffic->vehicles() > 0)
        all.insert(all.begin(), Pass{"vehicles", [this] { traffic->drive(step_start); }});
    return all;
}

void Simulation::Parts::beginStep() {
    decides = decidesAfter(steps_done);
    if (!decides || seats) kept.takeBack();
    kept.forget();
    step_start = now();
    ++steps_done;
    gates.move(step_start);
    congestion.chargeGround(step_start);
    if (traffic) traffic->switchLights(step_start);
}

float Simulation::Parts::now() const {
    return timeAfter(steps_done);
}

float Simulation::Parts::timeAfter(std::uint32_t steps) const {
    const auto warmup = static_cast<double>(warmupSteps(settings));
    return static_cast<float>((static_cast<double>(steps) - warmup) / (settings.fps * settings.substeps));
}

/// What people like who have to do with more than their way.
void Simulation::Parts::changeWishes() {
    if (patches) patches->run(step_start);
    if (lifts) lifts->wish();
    if (boarding) boarding->wish();
    if (given)
        given->wish(step_start,
                    timeAfter(steps_done - 1 + static_cast<std::uint32_t>(settings.stepsPerDecision())));
}

std::vector<std::pair<std::string, gl::Buffer*>> Simulation::Parts::remembered(std::uint32_t steps) {
    std::vector<std::pair<std::string, gl::Buffer*>> found = {{"states", &buffers.states},
                                                              {"waiting lines", &buffers.lines},
                                                              {"tickets", &buffers.tickets},
                                                              {"queue heads", &buffers.queue_heads},
                                                              {"detour slopes", &buffers.detour_slopes}};
    if (buffers.hasBodies()) found.emplace_back("chests", &buffers.chests);
    if (sizes) found.emplace_back("people", &buffers.people);
    if (traffic && traffic->vehicles() > 0) found.emplace_back("vehicles", &buffers.vehicles);
    if (boarding) {
        found.emplace_back("services of vehicles", &buffers.vehicle_services);
        found.emplace_back("states of doors", &buffers.door_states);
        found.emplace_back("passengers", &buffers.passengers);
        found.emplace_back("heads of calls", &buffers.call_heads);
        found.emplace_back("vehicles at platforms", &buffers.platform_vehicles);
    }
    if (lifts) {
        found.emplace_back("lifts", &buffers.lift_states);
        found.emplace_back("riders", &buffers.riders);
    }
    if (behaviour)
        for (const auto& each : behaviour->remembered())
            found.push_back(each);
    if (seats)
        for (const auto& each : seats->remembered())
            found.push_back(each);
    for (const auto& each : congestion.remembered())
        found.push_back(each);
    const auto is_new = [&](const std::string& name) {
        return std::ranges::none_of(found, [&](const auto& each) { return each.first == name; });
    };
    if (!decidesAfter(steps))
        for (const auto& each : kept.parts())
            if (is_new(each.first)) found.push_back(each);
    return found;
}

}  // namespace throng::sim
