// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <span>
#include <stdexcept>

#include "sim/simulation_parts.h"

namespace throng::sim {
namespace {

constexpr const char* kStreamBlock = "StreamBlock";

/// A stream may look at everything, and writes nothing but itself.
gl::Declaration packingOf(const StreamInfo& info, const gl::ShaderLibrary& library,
                          const gl::Definitions& definitions) {
    gl::Declaration declaration = {
        "stream " + std::string(info.name), {std::string(info.shader)}, {}, {kStreamBlock}};
    std::vector<std::string> files;
    for (const gl::Access& access :
         gl::accessIn(library.load(declaration.shaders.front(), definitions, files)))
        if (access.name != kStreamBlock) declaration.reads.push_back(access.name);
    return declaration;
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
        const bool is_given = (person.flags & gpu::PERSON_IS_GIVEN) != 0;
        const bool called_off = person.change_count > 0 && end > person.spawn_time;
        outcome.reason = (person.flags & gpu::PERSON_ALIGHTS) != 0
                             ? "it could not get off before the bake ended, or before its vehicle went on"
                         : person.spawn_time > end              ? "the bake ended before its time to enter"
                         : is_given && person.spawn_time > 0.0f ? "its way lies between two steps"
                         : is_given                             ? "its way ends before the bake begins"
                         : called_off ? "no free room at its entry before it was told to go elsewhere"
                                      : "no free room at its entry before the bake ended";
    } else {
        const bool under_way = state.status == gpu::STATUS_WALKING ||
                               (state.status == gpu::STATUS_SEATED && state.arrival_step == gpu::NO_INDEX);
        outcome.status = under_way ? AgentStatus::walking : AgentStatus::arrived;
    }
    return outcome;
}

}  // namespace

std::uint32_t warmupSteps(const authoring::SimulationSettings& settings) {
    return static_cast<std::uint32_t>(std::lround(settings.warmup * settings.fps)) *
           static_cast<std::uint32_t>(settings.substeps);
}

Simulation::Simulation(const authoring::Scene& scene, const gl::ShaderLibrary& library,
                       const CostModel& costs)
    : parts_(std::make_unique<Parts>(scene, library, costs)) {
    std::optional<LookedAtCount> looked_at = lookedAtCount();
    std::uint32_t present = 0;
    if (looked_at) looked_at->begin();
    for (const gpu::Person& person : scene.people) {
        if ((person.flags & gpu::PERSON_PRESENT_AT_START) == 0) continue;
        ++present;
        if (looked_at) looked_at->add(person.spawn_position);
    }
    adaptTo(present, looked_at ? looked_at->pixels() : 0.0);
}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

bool Simulation::step() {
    parts_->stopped = false;
    parts_->beginStep();
    for (const Pass& pass : parts_->passes) {
        pass.run();
        if (parts_->stopped) return false;
    }
    return true;
}

void Simulation::stopWhen(std::function<bool()> stop) {
    parts_->diagram.stopWhen(std::move(stop));
}

bool Simulation::canStopWithinStep() const {
    return parts_->diagram.buildsInPieces();
}

namespace {
constexpr const char* kRoutesClock = "routes clock";
}  // namespace

Simulation::State Simulation::save() const {
    State state;
    state.steps_done = parts_->steps_done;
    parts_->kept.takeBack();
    for (const auto& [name, buffer] : parts_->remembered(state.steps_done))
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
    // Ground as the last step left it: which of its news has spread, the state tells.
    p.steps_done = std::max(state.steps_done, 1u) - 1;
    if (state.steps_done > 0) p.congestion.chargeGround(p.now());
    for (const auto& [name, buffer] : p.remembered(state.steps_done))
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
    p.kept.forget();
}

std::optional<LookedAtCount> Simulation::lookedAtCount() const {
    const Parts& p = *parts_;
    const DiagramMethod method = p.settings.method;
    const bool chooses = method == DiagramMethod::automatic || method == DiagramMethod::binned;
    if (!chooses || !p.sensing.needsDiagram() || p.diagram.paged() || p.buffers.hasCharts()) return {};
    return LookedAtCount(p.parameters, p.look);
}

void Simulation::adaptTo(std::uint32_t people_present, double pixels_looked_at) {
    Parts& p = *parts_;
    p.load.sites = people_present;
    p.load.looked_at = pixels_looked_at;
    if (p.diagram.paged() || p.settings.method == DiagramMethod::binned) {
        const bool listed = p.diagram.paged() || isWorthListing(p.load, p.look);
        p.extent = listed ? Extent::near_people : Extent::everywhere;
        return;
    }
    if (p.settings.method != DiagramMethod::automatic) return;
    const DiagramPlan best = p.costs.plan(p.load, p.look, p.chosen);
    if (best == p.chosen) return;
    p.chosen = best;
    p.extent = best.extent;
    p.diagram.use(best.cost->method, best.cost->gather);
}

DiagramMethod Simulation::diagramMethod() const {
    return parts_->diagram.method();
}
bool Simulation::diagramIsPaged() const {
    return parts_->diagram.paged();
}

std::vector<std::pair<std::string, double>> Simulation::profile(int steps) {
    using Milliseconds = std::chrono::duration<double, std::milli>;
    std::vector<std::pair<std::string, double>> times;
    const auto time_of = [&](const std::string& name) -> double& {
        auto known = std::ranges::find(times, name, &std::pair<std::string, double>::first);
        if (known == times.end()) known = times.insert(known, {name, 0.0});
        return known->second;
    };
    for (int i = 0; i < steps; ++i) {
        parts_->beginStep();
        for (const Pass& pass : parts_->passes) {
            const auto start = std::chrono::steady_clock::now();
            pass.run();
            glFinish();
            time_of(pass.name) += Milliseconds(std::chrono::steady_clock::now() - start).count() / steps;
        }
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
    return bytesOfFrame(parts_->rows);
}

void Simulation::packFrame(const gl::Buffer& buffer) {
    parts_->pack.bind("FrameBlock", buffer);
    parts_->pack.dispatch(parts_->rows);
}

bool Simulation::buildDiagramNow(Extent extent) {
    // Who looks for room before people are sorted anew (seats) does so among the slots of the last decision.
    if (!parts_->decidesAfter(parts_->steps_done) || parts_->seats) parts_->kept.putAside();
    parts_->cells.run(CellSort::SiteIds::rows);
    return parts_->diagram.build(extent);
}

Diagram& Simulation::diagram() {
    return parts_->diagram;
}

void Simulation::packStream(Stream stream, const gl::Buffer& buffer) {
    Parts& p = *parts_;
    const StreamInfo& info = infoOf(stream);
    std::optional<gl::ComputeProgram>& program = p.pack_streams[stream];
    if (!program) {
        const gl::Definitions definitions = p.buffers.definitions();
        program = p.buffers.connect(p.library, packingOf(info, p.library, definitions), definitions);
    }
    if (info.needs_diagram) program->bind("PixelCounts", p.diagram.countPixels());
    program->bind(kStreamBlock, buffer);
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
std::size_t Simulation::vehicles() const {
    return parts_->traffic ? parts_->traffic->vehicles() : 0;
}
std::size_t Simulation::lifts() const {
    return parts_->lifts ? parts_->lifts->count() : 0;
}
bool Simulation::hasDoors() const {
    return parts_->boarding.has_value();
}
Simulation::Parts& Simulation::parts() {
    return *parts_;
}

}  // namespace throng::sim
