// SPDX-License-Identifier: Apache-2.0
#include "sim/passes.h"

#include <string>

namespace throng::sim {
namespace {

const gl::Declaration kPropose = {
    "spawn",
    {"shaders/motion/spawn_propose.comp"},
    {"ParametersBlock", "LiveDispatch", "People", "PlanChanges", "Queues", "Entries", "EntryPoints", "Bodies",
     "StripStarts", "CellOffsets", "States", "QueueHeads"},
    {"States", "QueueHeads", "Proposals"}};
const gl::Declaration kAccept = {"spawn",
                                 {"shaders/motion/spawn_accept.comp"},
                                 {"ParametersBlock", "People", "Stages", "field_cells", "DetourSlopes",
                                  "WaitingLines", "LinePoints", "Proposals", "States"},
                                 {"States", "Chests"}};
const gl::Declaration kLines = {"motion",
                                {"shaders/motion/lines.comp"},
                                {"Stages", "WaitingLines", "Tickets", "States"},
                                {"WaitingLines", "Tickets", "States"}};
const gl::Declaration kSteer = {
    "avoidance",
    {"shaders/motion/steer.comp"},
    {"ParametersBlock", "LiveDispatch", "States", "Bodies", "Walkers", "Stages", "field_cells",
     "DetourSlopes", "WaitingLines", "LinePoints", "NeighbourCounts", "TouchWords", "TerrainNodes",
     "ChartCells", "ChartShifts", "Belts", "Crossings", "CrossingPoints", "Lights"},
    {"Walkers", "PreferredVelocities"}};
const gl::Declaration kAvoid = {
    "avoidance",
    {"shaders/motion/avoid.comp"},
    {"ParametersBlock", "LiveDispatch", "States", "Bodies", "Walkers", "PreferredVelocities", "Neighbours",
     "NeighbourCounts", "TouchWords", "WallSegments", "WallStarts", "WallItems", "RoadDistances", "Belts",
     "VehicleBoxes"},
    {"TouchWords", "Targets", "TargetsAfter", "Decisions", "Ways"}};
const gl::Declaration kCarryOn = {
    "avoidance",
    {"shaders/motion/carry_on.comp"},
    {"ParametersBlock", "LiveDispatch", "States", "Chests", "Decisions", "Bodies", "Walkers", "Belts"},
    {"Bodies", "Walkers", "Targets", "TargetsAfter", "Ways"}};
const gl::Declaration kWeigh = {"contacts",
                                {"shaders/motion/weigh.comp"},
                                {"LiveDispatch", "Bodies", "Walkers", "PreferredVelocities", "TouchWords"},
                                {"Weights"}};
const gl::Declaration kContact = {
    "contacts",
    {"shaders/motion/contact.comp"},
    {"ParametersBlock", "TouchDispatch", "TouchSlots", "Bodies", "Walkers", "PreferredVelocities",
     "TouchWords", "Weights", "TouchLists", "NearLists", "WallSegments", "WallStarts", "WallItems",
     "StripStarts", "CellOffsets", "TargetsBefore", "TargetsAfter"},
    {"NearLists", "TargetsAfter"}};
const gl::Declaration kMove = {
    "motion",
    {"shaders/motion/move.comp"},
    {"ParametersBlock", "LiveDispatch", "People", "Bodies", "Walkers", "PreferredVelocities", "TouchWords",
     "Decisions", "Ways", "Targets", "Stages", "field_cells", "DetourSlopes", "PlanChanges", "WaitingLines",
     "LinePoints", "States", "Belts"},
    {"WaitingLines", "States", "Chests"}};

gl::Definitions together(gl::Definitions some, const gl::Definitions& others) {
    some.insert(some.end(), others.begin(), others.end());
    return some;
}

}  // namespace

gl::ComputeProgram makeSteer(const gl::ShaderLibrary& library, const Buffers& buffers,
                             const TerrainSlopes* ground, const MotionSettings& rules) {
    gl::ComputeProgram steer = buffers.connect(
        library, kSteer,
        together(buffers.definitions(rules), ground ? gl::Definitions{{"TERRAIN", "1"}} : gl::Definitions{}));
    if (ground) ground->describeTo(steer);
    return steer;
}

gl::ComputeProgram makeAvoid(const gl::ShaderLibrary& library, const Buffers& buffers, int neighbours,
                             const MotionSettings& rules) {
    gl::ComputeProgram avoid = buffers.connect(
        library, kAvoid, together(buffers.definitions(rules), {{"NEIGHBOURS", std::to_string(neighbours)}}));
    avoid.set("slot_capacity", buffers.slotCapacity());
    return avoid;
}

gl::ComputeProgram makeCarryOn(const gl::ShaderLibrary& library, const Buffers& buffers,
                               const MotionSettings& rules) {
    return buffers.connect(library, kCarryOn, buffers.definitions(rules));
}

gl::ComputeProgram makeMove(const gl::ShaderLibrary& library, const Buffers& buffers,
                            const MotionSettings& rules) {
    return buffers.connect(library, kMove, buffers.definitions(rules));
}

Spawner::Spawner(const gl::ShaderLibrary& library, Buffers& buffers, const gpu::Parameters& parameters,
                 const MotionSettings& rules)
    : invocations_(std::uint64_t{parameters.queue_count} * gpu::SPAWN_GROUP_SIZE),
      propose_(buffers.connect(library, kPropose, buffers.definitions(rules))),
      accept_(buffers.connect(library, kAccept, buffers.definitions(rules))) {}

void Spawner::run(float now, std::uint32_t steps_done) {
    propose_.set("now", now);
    propose_.set("steps_done", steps_done);
    accept_.set("steps_done", steps_done);
    propose_.dispatch(invocations_);
    accept_.dispatch(invocations_);
}

WaitingLines::WaitingLines(const gl::ShaderLibrary& library, Buffers& buffers, std::uint32_t count)
    : count_(count), program_(buffers.connect(library, kLines)) {
    program_.set("line_count", count);
}

void WaitingLines::run() {
    if (count_ > 0) program_.dispatch(count_);
}

Avoidance::Avoidance(const gl::ShaderLibrary& library, Buffers& buffers, int neighbours,
                     const TerrainSlopes* ground, const MotionSettings& rules, Seams* seams)
    : buffers_(buffers),
      seams_(seams),
      steer_(makeSteer(library, buffers, ground, rules)),
      avoid_(makeAvoid(library, buffers, neighbours, rules)),
      carry_on_(makeCarryOn(library, buffers, rules)) {}

void Avoidance::run(std::uint32_t steps_done, const std::function<void()>& change_wishes) {
    steer_.setIfUsed("steps_done", steps_done);
    steer_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
    change_wishes();
    if (seams_) seams_->takeAlong(Seams::After::steering);
    avoid_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
    if (seams_) seams_->takeAlong(Seams::After::avoiding);
}

void Avoidance::carryOn() {
    carry_on_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
    if (seams_) seams_->takeAlong(Seams::After::carrying_on);
}

Contacts::Contacts(const gl::ShaderLibrary& library, Buffers& buffers, int iterations,
                   const MotionSettings& rules, Seams* seams)
    : Contacts(library, buffers, iterations, rules,
               {buffers.targets, buffers.targets_after, buffers.touch_words}) {
    seams_ = seams;
}

Contacts::Contacts(const gl::ShaderLibrary& library, const Buffers& buffers, int iterations,
                   const MotionSettings& rules, const Places& places)
    : buffers_(buffers),
      places_(places),
      iterations_(iterations),
      braced_(static_cast<int>(iterations * rules.number("standing_fast", "rounds"))),
      spectral_radius_(rules.isOn("contact_momentum")
                           ? static_cast<float>(rules.number("contact_momentum", "spectral_radius"))
                           : 0.0f),
      weigh_(buffers.connect(library, kWeigh, buffers.definitions(rules))),
      forth_(buffers.connect(library, kContact, buffers.definitions(rules))),
      back_(buffers.connect(library, kContact, buffers.definitions(rules))) {
    forth_.bind("TargetsBefore", places.targets);
    forth_.bind("TargetsAfter", places.targets_after);
    back_.bind("TargetsBefore", places.targets_after);
    back_.bind("TargetsAfter", places.targets);
    for (gl::ComputeProgram* program : {&weigh_, &forth_, &back_})
        program->bind("TouchWords", places.touch_words);
    makeFirstRounds(library, rules);
}

void Contacts::makeFirstRounds(const gl::ShaderLibrary& library, const MotionSettings& rules) {
    const bool bodies = buffers_.hasBodies();
    for (int iteration = 0; iteration < std::clamp(braced_, bodies ? 1 : 0, 3); ++iteration) {
        gl::Definitions own;
        if (bodies && iteration == 0) own.emplace_back("FIRST_ROUND", "1");
        if (iteration < braced_) own.emplace_back("BRACED", "1");
        first_rounds_.push_back(
            buffers_.connect(library, kContact, together(buffers_.definitions(rules), own)));
        const bool forth = iteration % 2 == 0;
        first_rounds_.back().bindAll({{"TargetsBefore", forth ? &places_.targets : &places_.targets_after},
                                      {"TargetsAfter", forth ? &places_.targets_after : &places_.targets},
                                      {"TouchWords", &places_.touch_words}});
    }
}

gl::ComputeProgram& Contacts::programOf(int iteration) {
    const bool forth = iteration % 2 == 0;
    if (first_rounds_.empty() || (iteration > 0 && iteration >= braced_)) return forth ? forth_ : back_;
    return first_rounds_[iteration == 0 ? 0 : forth ? 2 : 1];
}

void Contacts::run(const std::function<void(const gl::Buffer&)>& hold) {
    if (braced_ > 0) weigh_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
    const float squared = spectral_radius_ * spectral_radius_;
    float momentum = 1.0f;
    for (int iteration = 0; iteration < iterations_; ++iteration) {
        // Two plain rounds first: momentum needs something to go on.
        if (iteration == 2) momentum = 2.0f / (2.0f - squared);
        if (iteration > 2) momentum = 4.0f / (4.0f - squared * momentum);
        gl::ComputeProgram& round = programOf(iteration);
        round.set("momentum", momentum);
        round.dispatchUpTo(buffers_.slotCapacity(), buffers_.touch_dispatch);
        hold(iteration % 2 ? places_.targets : places_.targets_after);
        if (seams_) seams_->takeAlong(iteration % 2 ? Seams::After::round_back : Seams::After::round_forth);
    }
}

Motion::Motion(const gl::ShaderLibrary& library, Buffers& buffers, const gl::Buffer& targets,
               const MotionSettings& rules)
    : buffers_(buffers), program_(makeMove(library, buffers, rules)) {
    program_.bind("Targets", targets);
}

void Motion::run(std::uint32_t steps_done) {
    program_.set("steps_done", steps_done);
    program_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

}  // namespace throng::sim
