// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>
#include <stdexcept>

#include "sim/simulation_parts.h"

namespace throng::sim {
namespace {

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

/// Pages where one buffer or texture cannot hold the window, and where most of a large window is empty: then
/// clearing and gathering only what exists makes up for looking up where it is.
bool isBestPaged(const DiagramOptions& options, std::size_t wall_sites) {
    constexpr double kMostWholePixels = 33'554'432.0;  // 128 MiB: what every device's storage blocks hold
    constexpr std::uint32_t kMostWholeSide = 16'384;
    constexpr double kWorthwhilePixels = 4'194'304.0;
    const double pixels = static_cast<double>(options.width) * options.height;
    if (pixels > kMostWholePixels || std::max(options.width, options.height) > kMostWholeSide) return true;
    if (pixels < kWorthwhilePixels || options.method != DiagramMethod::binned) return false;
    const double paged_pixels =
        static_cast<double>(Pages::pagesNeeded(options.width, options.height, options.largest_radius,
                                               options.live_capacity + wall_sites)) *
        gpu::PAGE_SIDE * gpu::PAGE_SIDE;
    return paged_pixels < 0.25 * pixels;
}

std::uint32_t presentAtStart(const authoring::Scene& scene) {
    return static_cast<std::uint32_t>(std::count_if(
        scene.people.begin(), scene.people.end(),
        [](const gpu::Person& person) { return (person.flags & gpu::PERSON_PRESENT_AT_START) != 0; }));
}

Diagram diagramFor(const authoring::Scene& scene, const gpu::Parameters& parameters,
                   const gl::ShaderLibrary& library) {
    DiagramOptions options;
    options.method = scene.settings.method;
    if (options.method == DiagramMethod::automatic) options.method = DiagramMethod::binned;
    options.cone_sides = static_cast<std::uint32_t>(scene.settings.cone_sides);
    options.width = parameters.diagram_width;
    options.height = parameters.diagram_height;
    options.live_capacity = parameters.row_count;
    options.largest_radius =
        std::max(parameters.tile_radius, scene.largest_radius) * parameters.pixels_per_metre;
    options.paged = isBestPaged(options, scene.wall_tiles.size());
    return Diagram(library, options, wallSites(scene, parameters));
}

/// The first frame that shows what was so after `steps` steps.
std::uint32_t frameOfStep(std::uint32_t steps, std::uint32_t warmup_steps, std::uint32_t substeps) {
    if (steps == gpu::NO_INDEX) return kNone;
    if (steps <= warmup_steps) return 0;
    return (steps - warmup_steps + substeps - 1) / substeps;
}

AgentOutcome outcomeOf(const gpu::AgentState& state, const gpu::Person& person, float end,
                       std::uint32_t warmup_steps, std::uint32_t substeps) {
    AgentOutcome outcome;
    outcome.spawn_frame = frameOfStep(state.spawn_step, warmup_steps, substeps);
    outcome.arrival_frame = frameOfStep(state.arrival_step, warmup_steps, substeps);
    outcome.distance_walked = state.walked;
    outcome.shortest_way = state.shortest_way;
    if (state.status == gpu::STATUS_WAITING) {
        outcome.status = AgentStatus::refused;
        const bool called_off = person.change_count > 0 && end > person.spawn_time;
        outcome.reason = person.spawn_time > end ? "the bake ended before its time to enter"
                         : called_off ? "no free room at its entry before it was told to go elsewhere"
                                      : "no free room at its entry before the bake ended";
    } else {
        outcome.status = state.status == gpu::STATUS_WALKING ? AgentStatus::walking : AgentStatus::arrived;
    }
    return outcome;
}

}  // namespace

std::uint32_t warmupSteps(const authoring::SimulationSettings& settings) {
    return static_cast<std::uint32_t>(std::lround(settings.warmup * settings.fps)) *
           static_cast<std::uint32_t>(settings.substeps);
}

Simulation::Parts::Parts(const authoring::Scene& scene, const gl::ShaderLibrary& shader_library,
                         const CostModel& cost_model)
    : library(shader_library),
      settings(scene.settings),
      parameters(makeParameters(scene)),
      buffers(scene, parameters),
      diagram(diagramFor(scene, parameters, library)),
      cells(library, buffers, parameters),
      congestion(library, buffers, scene, parameters),
      spawner(library, buffers, parameters),
      sensing(library, buffers, diagram, sensingFor(scene, parameters), scene, parameters),
      slopes(scene.terrain ? std::optional<TerrainSlopes>(scene.terrain) : std::nullopt),
      avoidance(library, buffers, settings.neighbours, slopes ? &*slopes : nullptr),
      contacts(library, buffers, settings.contact_iterations),
      motion(library, buffers, contacts.result()),
      lines(library, buffers, static_cast<std::uint32_t>(scene.lines.size())),
      gates(scene, buffers, diagram, parameters),
      pack(library, "shaders/frame/pack_frame.comp"),
      costs(cost_model),
      fixed_sites(static_cast<std::uint32_t>(scene.wall_tiles.size())),
      rows(parameters.row_count) {
    // Slots are in the order of the cells, and cells and diagram have one origin.
    const BinGrid cell_grid(parameters.cell_size * parameters.pixels_per_metre,
                            {parameters.cells_width, parameters.cells_height});
    diagram.connect({&buffers.sites, &buffers.live_dispatch, &buffers.site_slots,
                     DiagramInput::Sorted{&buffers.strip_starts, &buffers.cell_offsets, cell_grid}});
    pack.bindAll(buffers.named());
    anybody_enters_later = std::any_of(
        scene.people.begin(), scene.people.end(),
        [](const gpu::Person& person) { return (person.flags & gpu::PERSON_PRESENT_AT_START) == 0; });
}

float Simulation::Parts::now() const {
    const auto warmup = static_cast<double>(warmupSteps(settings));
    return static_cast<float>((static_cast<double>(steps_done) - warmup) /
                              (settings.fps * settings.substeps));
}

std::vector<std::pair<std::string, gl::Buffer*>> Simulation::Parts::remembered() {
    std::vector<std::pair<std::string, gl::Buffer*>> found = {{"states", &buffers.states},
                                                              {"waiting lines", &buffers.lines},
                                                              {"tickets", &buffers.tickets},
                                                              {"queue heads", &buffers.queue_heads},
                                                              {"detour slopes", &buffers.detour_slopes}};
    for (const auto& each : congestion.remembered())
        found.push_back(each);
    return found;
}

Simulation::Simulation(const authoring::Scene& scene, const gl::ShaderLibrary& library,
                       const CostModel& costs)
    : parts_(std::make_unique<Parts>(scene, library, costs)) {
    const gpu::Parameters& parameters = parts_->parameters;
    parts_->load.radius =
        double{std::max(parameters.tile_radius, parameters.largest_radius)} * parameters.pixels_per_metre;
    parts_->load.pixels = static_cast<double>(parameters.diagram_width) * parameters.diagram_height;
    adaptTo(presentAtStart(scene));
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

void Simulation::step() {
    Parts& p = *parts_;
    const float now = p.now();
    ++p.steps_done;
    p.gates.move(now);
    p.cells.run();
    p.congestion.run();
    if (p.anybody_enters_later) p.spawner.run(now, p.steps_done);
    if (p.sensing.needsDiagram()) p.diagram.build();
    p.sensing.run();
    p.avoidance.run(p.steps_done);
    p.contacts.run();
    p.motion.run(p.steps_done);
    p.lines.run();
}

namespace {
constexpr const char* kRoutesClock = "routes clock";
}  // namespace

Simulation::State Simulation::save() const {
    State state;
    state.steps_done = parts_->steps_done;
    for (const auto& [name, buffer] : parts_->remembered())
        state.parts.emplace_back(name, buffer->download<std::byte>(buffer->bytes()));
    const Congestion::Clock clock = parts_->congestion.clock();
    const auto bytes = std::as_bytes(std::span(&clock, 1));
    state.parts.emplace_back(kRoutesClock, std::vector(bytes.begin(), bytes.end()));
    return state;
}

void Simulation::restore(const State& state) {
    Parts& p = *parts_;
    const auto part = [&](const std::string& name, std::size_t bytes) -> const std::vector<std::byte>& {
        for (const auto& [known, content] : state.parts)
            if (known == name && content.size() == bytes) return content;
        throw std::runtime_error("this is the state of another scene: its `" + name + "` does not fit");
    };
    for (const auto& [name, buffer] : p.remembered())
        buffer->upload(part(name, buffer->bytes()));
    Congestion::Clock clock;
    std::memcpy(&clock, part(kRoutesClock, sizeof clock).data(), sizeof clock);
    p.congestion.setClock(clock);
    // Gates stand as the last step left them.
    if (state.steps_done > 0) {
        p.steps_done = state.steps_done - 1;
        p.gates.move(p.now());
    }
    p.steps_done = state.steps_done;
}

void Simulation::adaptTo(std::uint32_t people_present) {
    Parts& p = *parts_;
    if (p.settings.method != DiagramMethod::automatic || p.diagram.paged()) return;
    p.load.sites = static_cast<double>(people_present) + p.fixed_sites;
    const MethodCost& best = p.costs.choose(p.load, p.chosen);
    if (&best == p.chosen) return;
    p.chosen = &best;
    p.diagram.use(best.method, best.gather);
}

DiagramMethod Simulation::diagramMethod() const {
    return parts_->diagram.method();
}
bool Simulation::diagramIsPaged() const {
    return parts_->diagram.paged();
}

std::vector<std::pair<std::string, double>> Simulation::profile(int steps) {
    Parts& p = *parts_;
    std::vector<std::pair<std::string, double>> times;
    const auto timed = [&](std::size_t index, const char* name, auto&& pass) {
        if (index == times.size()) times.emplace_back(name, 0.0);
        const auto start = std::chrono::steady_clock::now();
        pass();
        glFinish();
        times[index].second +=
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() /
            steps;
    };
    for (int i = 0; i < steps; ++i) {
        const float now = p.now();
        ++p.steps_done;
        p.gates.move(now);
        timed(0, "cells", [&] { p.cells.run(); });
        timed(1, "routes", [&] { p.congestion.run(); });
        timed(2, "spawn", [&] {
            if (p.anybody_enters_later) p.spawner.run(now, p.steps_done);
        });
        timed(3, "diagram", [&] {
            if (p.sensing.needsDiagram()) p.diagram.build();
        });
        timed(4, "sensing", [&] { p.sensing.run(); });
        timed(5, "avoidance", [&] { p.avoidance.run(p.steps_done); });
        timed(6, "contacts", [&] { p.contacts.run(); });
        timed(7, "motion", [&] {
            p.motion.run(p.steps_done);
            p.lines.run();
        });
    }
    return times;
}

std::uint32_t Simulation::stepsDone() const {
    return parts_->steps_done;
}

void Simulation::wait() const {
    glFinish();
}

std::size_t Simulation::frameBytes() const {
    return std::size_t{parts_->rows} * 9 * sizeof(float);
}

void Simulation::packFrame(const gl::Buffer& buffer) {
    parts_->pack.bind("FrameBlock", buffer);
    parts_->pack.dispatch(parts_->rows);
}

Diagram& Simulation::buildDiagramNow() {
    parts_->cells.run(CellSort::SiteIds::rows);
    parts_->diagram.build();
    return parts_->diagram;
}

Diagram& Simulation::diagram() {
    return parts_->diagram;
}

void Simulation::packStream(Stream stream, const gl::Buffer& buffer) {
    Parts& p = *parts_;
    const StreamInfo& info = infoOf(stream);
    std::optional<gl::ComputeProgram>& program = p.pack_streams[stream];
    if (!program) {
        program.emplace(p.library, std::string(info.shader));
        program->bindAll(p.buffers.named());
    }
    if (info.needs_diagram) program->bind("PixelCounts", p.diagram.countPixels());
    program->bind("StreamBlock", buffer);
    program->dispatch(p.rows);
}

Account Simulation::account() const {
    const Parts& p = *parts_;
    const std::vector<gpu::AgentState> states = p.buffers.states.download<gpu::AgentState>(p.rows);
    const std::vector<gpu::Person> people = p.buffers.people.download<gpu::Person>(p.rows);
    Account account;
    account.agents.reserve(p.rows);
    for (std::uint32_t row = 0; row < p.rows; ++row) {
        account.agents.push_back(outcomeOf(states[row], people[row], p.now(), warmupSteps(p.settings),
                                           static_cast<std::uint32_t>(p.settings.substeps)));
        const AgentStatus status = account.agents.back().status;
        account.spawned += status == AgentStatus::walking || status == AgentStatus::arrived ? 1 : 0;
        account.walking += status == AgentStatus::walking ? 1 : 0;
        account.arrived += status == AgentStatus::arrived ? 1 : 0;
        account.refused += status == AgentStatus::refused ? 1 : 0;
    }
    return account;
}

const gpu::Parameters& Simulation::parameters() const {
    return parts_->parameters;
}
Simulation::Parts& Simulation::parts() {
    return *parts_;
}

}  // namespace throng::sim
