// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "sim/sensing_pattern.h"
#include "sim/simulation_parts.h"

namespace throng::sim {
namespace {

std::vector<glm::vec2> patternFor(const authoring::Scene& scene, const gpu::Parameters& parameters) {
    SensingGeometry geometry;
    geometry.body_radius = scene.smallest_radius;
    geometry.tile_radius = static_cast<float>(scene.settings.tile_radius);
    geometry.samples_per_ray = scene.settings.samples_per_ray;
    geometry.field_of_view = static_cast<float>(scene.settings.field_of_view * std::numbers::pi / 180.0);
    return thinnedPattern(geometry, parameters.contact_range);
}

Diagram diagramFor(const authoring::Scene& scene, const gpu::Parameters& parameters,
                   const gl::ShaderLibrary& library) {
    DiagramOptions options;
    options.method =
        scene.settings.method == DiagramMethod::automatic ? DiagramMethod::binned : scene.settings.method;
    options.width = parameters.diagram_width;
    options.height = parameters.diagram_height;
    options.live_capacity = parameters.row_count;
    options.largest_radius =
        std::max(parameters.tile_radius, scene.largest_radius) * parameters.pixels_per_metre;
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
    if (state.status == gpu::STATUS_WAITING) {
        outcome.status = AgentStatus::refused;
        outcome.reason = person.spawn_time > end ? "the bake ended before its time to enter"
                                                 : "no free room at its entry before the bake ended";
    } else {
        outcome.status = static_cast<AgentStatus>(state.status);
    }
    return outcome;
}

}  // namespace

std::uint32_t warmupSteps(const authoring::SimulationSettings& settings) {
    return static_cast<std::uint32_t>(std::lround(settings.warmup * settings.fps)) *
           static_cast<std::uint32_t>(settings.substeps);
}

Simulation::Parts::Parts(const authoring::Scene& scene, const gl::ShaderLibrary& library)
    : settings(scene.settings),
      parameters(makeParameters(scene)),
      buffers(scene, parameters),
      diagram(diagramFor(scene, parameters, library)),
      cells(library, buffers, parameters),
      spawner(library, buffers, parameters),
      sensing(library, buffers, diagram, patternFor(scene, parameters), settings.neighbours),
      avoidance(library, buffers, settings.neighbours),
      contacts(library, buffers, settings.contact_iterations),
      motion(library, buffers, contacts.result()),
      pack(library, "shaders/pack_frame.comp"),
      rows(parameters.row_count) {
    diagram.connect({&buffers.sites, &buffers.live_dispatch, &buffers.row_slots});
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

Simulation::Simulation(const authoring::Scene& scene, const gl::ShaderLibrary& library)
    : parts_(std::make_unique<Parts>(scene, library)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

void Simulation::step() {
    Parts& p = *parts_;
    const float now = p.now();
    ++p.steps_done;
    p.cells.run();
    if (p.anybody_enters_later) p.spawner.run(now, p.steps_done);
    p.diagram.build();
    p.sensing.run();
    p.avoidance.run();
    p.contacts.run();
    p.motion.run(p.steps_done);
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
        timed(0, "cells", [&] { p.cells.run(); });
        timed(1, "spawn", [&] {
            if (p.anybody_enters_later) p.spawner.run(now, p.steps_done);
        });
        timed(2, "diagram", [&] { p.diagram.build(); });
        timed(3, "sensing", [&] { p.sensing.run(); });
        timed(4, "avoidance", [&] { p.avoidance.run(); });
        timed(5, "contacts", [&] { p.contacts.run(); });
        timed(6, "motion", [&] { p.motion.run(p.steps_done); });
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
    parts_->cells.run();
    parts_->diagram.build();
    return parts_->diagram;
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
