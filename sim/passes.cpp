// SPDX-License-Identifier: Apache-2.0
#include "sim/passes.h"

#include <utility>

#include "sim/wall_index.h"

namespace throng::sim {
namespace {

gl::ComputeProgram connected(const gl::ShaderLibrary& library, const std::string& path,
                             const Buffers& buffers, const gl::Definitions& definitions = {}) {
    gl::ComputeProgram program(library, path, definitions);
    program.bindAll(buffers.named());
    if (program.hasUniform("field_cells")) program.bind("field_cells", buffers.field_cells);
    return program;
}

gl::Definitions together(gl::Definitions some, const gl::Definitions& others) {
    some.insert(some.end(), others.begin(), others.end());
    return some;
}

gl::Definitions listLength(int neighbours) {
    return {{"NEIGHBOURS", std::to_string(neighbours)}};
}

}  // namespace

CellSort::CellSort(const gl::ShaderLibrary& library, Buffers& buffers, const gpu::Parameters& parameters)
    : buffers_(buffers),
      rows_(parameters.row_count),
      count_(connected(library, "shaders/cells/cells_count.comp", buffers)),
      sum_(connected(library, "shaders/cells/counts_sum.comp", buffers)),
      scan_(connected(library, "shaders/cells/strips_scan.comp", buffers)),
      fill_(connected(library, "shaders/cells/strips_fill.comp", buffers)),
      scatter_(connected(library, "shaders/cells/cells_scatter.comp", buffers)),
      gather_(connected(library, "shaders/cells/bodies_gather.comp", buffers)) {
    const auto strips = static_cast<std::uint32_t>(buffers.strip_counts.bytes() / sizeof(std::uint32_t));
    sum_.set("count_total", strips);
    scan_.set("count_total", strips);
    scan_threads_ = (strips + gpu::COUNTS_PER_THREAD - 1) / gpu::COUNTS_PER_THREAD;
}

void CellSort::run(SiteIds ids) {
    for (gl::ComputeProgram* program : {&scatter_, &gather_})
        program->set("ids_are_rows", ids == SiteIds::rows ? 1u : 0u);
    count_.dispatch(rows_);
    sum_.dispatch(scan_threads_);
    scan_.dispatch(scan_threads_);
    fill_.dispatchIndirect(buffers_.fill_dispatch);
    scatter_.dispatch(rows_);
    gather_.dispatchIndirect(buffers_.live_dispatch);
}

Spawner::Spawner(const gl::ShaderLibrary& library, Buffers& buffers, const gpu::Parameters& parameters,
                 const MotionSettings& rules)
    : invocations_(std::uint64_t{parameters.queue_count} * gpu::SPAWN_GROUP_SIZE),
      propose_(connected(library, "shaders/motion/spawn_propose.comp", buffers, rules.definitions())),
      accept_(connected(library, "shaders/motion/spawn_accept.comp", buffers, rules.definitions())) {}

void Spawner::run(float now, std::uint32_t steps_done) {
    propose_.set("now", now);
    propose_.set("steps_done", steps_done);
    accept_.set("steps_done", steps_done);
    propose_.dispatch(invocations_);
    accept_.dispatch(invocations_);
}

WaitingLines::WaitingLines(const gl::ShaderLibrary& library, Buffers& buffers, std::uint32_t count)
    : count_(count), program_(connected(library, "shaders/motion/lines.comp", buffers)) {
    program_.set("line_count", count);
}

void WaitingLines::run() {
    if (count_ > 0) program_.dispatch(count_);
}

Sensing::Sensing(const gl::ShaderLibrary& library, Buffers& buffers, const Diagram& diagram,
                 const SensingOptions& options, const authoring::Scene& scene,
                 const gpu::Parameters& parameters)
    : buffers_(buffers), proximity_(options.proximity) {
    if (needsDiagram())
        marchRays(library, diagram, options);
    else
        compareExactly(library, options, scene, parameters);
    program_.set("slot_capacity", buffers.slotCapacity());
}

void Sensing::marchRays(const gl::ShaderLibrary& library, const Diagram& diagram,
                        const SensingOptions& options) {
    const std::vector<glm::vec2> pattern = thinnedPattern(options.geometry, options.felt_range);
    gl::Definitions definitions = listLength(options.neighbours);
    definitions.emplace_back("SENSING_SAMPLES", std::to_string(pattern.size()));
    program_ = connected(library, "shaders/sensing/sense.comp", buffers_,
                         together(definitions, diagram.lookupDefinitions()));
    diagram.describeTo(program_);
    program_.set("pattern", pattern);
}

void Sensing::compareExactly(const gl::ShaderLibrary& library, const SensingOptions& options,
                             const authoring::Scene& scene, const gpu::Parameters& parameters) {
    const float reach = sensingReach(options.geometry);
    const bool everybody = proximity_ == authoring::Proximity::brute;
    gl::Definitions definitions = listLength(options.neighbours);
    if (everybody) definitions.emplace_back("EVERYBODY", "1");
    program_ = connected(library, "shaders/sensing/sense_exact.comp", buffers_, definitions);
    program_.set("reach", reach);
    program_.set("half_view", 0.5f * options.geometry.field_of_view);
    if (everybody) {
        program_.set("wall_count", static_cast<std::uint32_t>(scene.wall_segments.size()));
        return;
    }
    const WallIndex walls = indexWalls(scene.wall_segments, parameters, reach);
    far_wall_starts_ = gl::makeBuffer("walls within reach, starts", walls.starts);
    far_wall_items_ = gl::makeBuffer("walls within reach", walls.items);
    program_.bind("FarWallStarts", far_wall_starts_);
    program_.bind("FarWallItems", far_wall_items_);
}

void Sensing::run() {
    program_.dispatchIndirect(buffers_.live_dispatch);
}

Avoidance::Avoidance(const gl::ShaderLibrary& library, Buffers& buffers, int neighbours,
                     const TerrainSlopes* ground, const MotionSettings& rules)
    : buffers_(buffers),
      steer_(connected(
          library, "shaders/motion/steer.comp", buffers,
          together(rules.definitions(), ground ? gl::Definitions{{"TERRAIN", "1"}} : gl::Definitions{}))),
      avoid_(connected(library, "shaders/motion/avoid.comp", buffers,
                       together(rules.definitions(), listLength(neighbours)))) {
    avoid_.set("slot_capacity", buffers.slotCapacity());
    if (ground) ground->describeTo(steer_);
}

void Avoidance::run(std::uint32_t steps_done) {
    steer_.setIfUsed("steps_done", steps_done);
    steer_.dispatchIndirect(buffers_.live_dispatch);
    avoid_.dispatchIndirect(buffers_.live_dispatch);
}

Contacts::Contacts(const gl::ShaderLibrary& library, Buffers& buffers, int iterations,
                   const MotionSettings& rules)
    : buffers_(buffers),
      iterations_(iterations),
      braced_(static_cast<int>(iterations * rules.number("standing_fast", "rounds"))),
      spectral_radius_(rules.isOn("contact_momentum")
                           ? static_cast<float>(rules.number("contact_momentum", "spectral_radius"))
                           : 0.0f),
      forth_(connected(library, "shaders/motion/contact.comp", buffers, rules.definitions())),
      back_(connected(library, "shaders/motion/contact.comp", buffers, rules.definitions())) {
    forth_.bind("TargetsBefore", buffers.targets);
    forth_.bind("TargetsAfter", buffers.targets_after);
    back_.bind("TargetsBefore", buffers.targets_after);
    back_.bind("TargetsAfter", buffers.targets);
}

void Contacts::run() {
    const float squared = spectral_radius_ * spectral_radius_;
    float momentum = 1.0f;
    for (int iteration = 0; iteration < iterations_; ++iteration) {
        // Two plain rounds first: momentum needs something to go on.
        if (iteration == 2) momentum = 2.0f / (2.0f - squared);
        if (iteration > 2) momentum = 4.0f / (4.0f - squared * momentum);
        gl::ComputeProgram& round = iteration % 2 ? back_ : forth_;
        round.set("momentum", momentum);
        round.setIfUsed("bracing", iteration < braced_ ? 1.0f : 0.0f);
        round.dispatchIndirect(buffers_.touch_dispatch);
    }
}

Motion::Motion(const gl::ShaderLibrary& library, Buffers& buffers, const gl::Buffer& targets,
               const MotionSettings& rules)
    : buffers_(buffers),
      program_(connected(library, "shaders/motion/move.comp", buffers, rules.definitions())) {
    program_.bind("Targets", targets);
}

void Motion::run(std::uint32_t steps_done) {
    program_.set("steps_done", steps_done);
    program_.dispatchIndirect(buffers_.live_dispatch);
}

}  // namespace throng::sim
