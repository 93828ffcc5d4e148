// SPDX-License-Identifier: Apache-2.0
#include "sim/lifts.h"

namespace throng::sim {
namespace {

const gl::Declaration kCensus = {
    "lifts",
    {"shaders/lifts/census.comp"},
    {"ParametersBlock", "States", "Stages", "field_cells", "DetourSlopes", "WaitingLines", "LinePoints",
     "ChartCells", "ChartShifts", "LiftPlans", "LiftStops", "CabinStops", "LiftStates", "LiftWishesBlock",
     "LiftQueues", "Riders"},
    {"LiftWishesBlock", "LiftQueues", "Riders"}};
const gl::Declaration kMoveLifts = {"lifts",
                                    {"shaders/lifts/move.comp"},
                                    {"ParametersBlock", "LiftPlans", "LiftStops", "CabinStops", "LiftStates"},
                                    {"LiftStates"}};
const gl::Declaration kControl = {"lifts",
                                  {"shaders/lifts/control.comp"},
                                  {"LiftPlans", "LiftStops", "CabinStops", "LiftStates", "LiftWishesBlock",
                                   "Riders", "States", "ChartShifts"},
                                  {"LiftStates", "Riders"}};
const gl::Declaration kWishForLifts = {
    "avoidance",
    {"shaders/lifts/wish.comp"},
    {"ParametersBlock", "LiveDispatch", "Bodies", "Walkers", "ChartCells", "ChartShifts", "LiftPlans",
     "LiftStops", "CabinStops", "LiftStates", "LiftQueues", "Riders"},
    {"Walkers", "PreferredVelocities"}};
const gl::Declaration kKeepOut = {
    "contacts",
    {"shaders/lifts/keep_out.comp"},
    {"ParametersBlock", "LiveDispatch", "Bodies", "Walkers", "States", "Targets", "ChartCells", "ChartShifts",
     "LiftPlans", "LiftStops", "CabinStops", "LiftStates", "Riders"},
    {"Targets", "States"}};

}  // namespace

Lifts::Lifts(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
             const MotionSettings& rules)
    : buffers_(buffers),
      count_(scene.chart_map.lifts.plans.size()),
      rows_(static_cast<std::uint32_t>(scene.people.size())),
      move_(buffers.connect(library, kMoveLifts, buffers.definitions())),
      census_(buffers.connect(library, kCensus, buffers.definitions(rules))),
      control_(buffers.connect(library, kControl, buffers.definitions())),
      wish_(buffers.connect(library, kWishForLifts, buffers.definitions(rules))),
      keep_out_(buffers.connect(library, kKeepOut, buffers.definitions(rules))) {}

void Lifts::move() {
    move_.dispatch(1);
}

void Lifts::serve() {
    buffers_.lift_wishes.fill(0);
    buffers_.lift_queues.fill(0);
    census_.dispatch(rows_);
    control_.dispatch(1);
}

void Lifts::wish() {
    wish_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

void Lifts::keepOut(const gl::Buffer& targets) {
    keep_out_.bind("Targets", targets);
    keep_out_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

}  // namespace throng::sim
