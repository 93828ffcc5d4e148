// SPDX-License-Identifier: Apache-2.0
#include "sim/behaviour.h"

namespace throng::sim {
namespace {

const gl::Declaration kBehaviourCensus = {
    "behaviour",
    {"shaders/behaviour/census.comp"},
    {"LiveDispatch", "Bodies", "Walkers", "BehaviourPoints", "Censuses", "Tallies"},
    {"Tallies"}};
const gl::Declaration kTransitions = {
    "behaviour",
    {"shaders/behaviour/transitions.comp"},
    {"ParametersBlock", "LiveDispatch", "States", "Bodies", "Walkers", "Stages", "StripStarts", "CellOffsets",
     "BehaviourStates", "BehaviourRules", "BehaviourPoints", "Censuses", "Tallies", "Minds"},
    {"Stages", "Minds"}};
const gl::Declaration kGoals = {
    "behaviour",
    {"shaders/behaviour/goals.comp"},
    {"ParametersBlock", "LiveDispatch", "States", "Bodies", "Walkers", "Stages", "field_cells",
     "DetourSlopes", "StripStarts", "CellOffsets", "WallSegments", "WallStarts", "WallItems",
     "BehaviourStates", "BehaviourPlaces", "BehaviourPoints", "Minds"},
    {"States", "Walkers", "Stages", "Minds"}};

}  // namespace

Behaviour::Behaviour(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
                     const MotionSettings& rules)
    : buffers_(buffers),
      census_count_(static_cast<std::uint32_t>(scene.behaviours.censuses.size())),
      census_(buffers.connect(library, kBehaviourCensus, buffers.definitions(rules))),
      transitions_(buffers.connect(library, kTransitions, buffers.definitions(rules))),
      goals_(buffers.connect(library, kGoals, buffers.definitions(rules))) {
    census_.set("census_count", census_count_);
}

void Behaviour::run(float now, std::uint32_t steps_done) {
    if (census_count_ > 0) {
        buffers_.tallies.fill(0);
        census_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
    }
    transitions_.set("now", now);
    transitions_.set("steps_done", steps_done);
    transitions_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
    goals_.set("steps_done", steps_done);
    goals_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

std::vector<std::pair<std::string, gl::Buffer*>> Behaviour::remembered() {
    return {{"minds", &buffers_.minds}, {"stages", &buffers_.stages}};
}

}  // namespace throng::sim
