// SPDX-License-Identifier: Apache-2.0
#include "sim/seams.h"

namespace throng::sim {
namespace {

const gl::Declaration kCross = {"seams",
                                {"shaders/charts/cross_seams.comp"},
                                {"ParametersBlock", "States", "ChartCells", "ChartShifts", "Belts",
                                 "LiftPlans", "LiftStops", "CabinStops", "LiftStates"},
                                {"States"}};
const gl::Declaration kFollow = {
    "seams",
    {"shaders/charts/follow.comp"},
    {"LiveDispatch", "RowSlots", "SlotImages", "Bodies", "Walkers", "PreferredVelocities", "TouchWords",
     "Targets", "TargetsAfter", "ParametersBlock", "ChartCells", "ChartShifts", "Belts"},
    {"Bodies", "Walkers", "PreferredVelocities", "TouchWords", "Targets", "TargetsAfter"}};

gl::Definitions whatFollows(Seams::After pass) {
    switch (pass) {
        case Seams::After::steering:
            return {{"FOLLOW_WALKERS", "1"}, {"FOLLOW_WISHES", "1"}, {"FOLLOW_TOUCH", "1"}};
        case Seams::After::avoiding:
            return {{"FOLLOW_TOUCH", "1"}, {"FOLLOW_TARGETS", "1"}};
        case Seams::After::carrying_on:
            return {{"FOLLOW_BODIES", "1"}, {"FOLLOW_WALKERS", "1"}, {"FOLLOW_TARGETS", "1"}};
        default:
            return {{"FOLLOW_ROUND", "1"}};
    }
}

}  // namespace

Seams::Seams(const gl::ShaderLibrary& library, Buffers& buffers, const MotionSettings& rules)
    : buffers_(buffers), cross_(buffers.connect(library, kCross, buffers.definitions())) {
    for (std::size_t pass = 0; pass < kPasses; ++pass) {
        gl::Definitions definitions = buffers.definitions(rules);
        for (const auto& definition : whatFollows(static_cast<After>(pass)))
            definitions.push_back(definition);
        follow_[pass] = buffers.connect(library, kFollow, definitions);
    }
    // A round of contact leaves its result where the next one begins.
    follow_[static_cast<std::size_t>(After::round_forth)].bind("TargetsAfter", buffers.targets_after);
    follow_[static_cast<std::size_t>(After::round_back)].bind("TargetsAfter", buffers.targets);
}

void Seams::cross() {
    cross_.dispatch(buffers_.states.bytes() / sizeof(gpu::AgentState));
}

void Seams::takeAlong(After pass) {
    follow_[static_cast<std::size_t>(pass)].dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

}  // namespace throng::sim
