// SPDX-License-Identifier: Apache-2.0
#include "sim/boarding.h"

namespace throng::sim {
namespace {

const gl::Declaration kBoardingCensus = {
    "boarding",
    {"shaders/boarding/census.comp"},
    {"ParametersBlock", "People", "States", "Stages", "VehicleBoxes", "VehicleDoors", "Platforms",
     "PlatformPoints", "PlatformVehicles", "VehicleServices", "Passengers", "DoorStates", "DoorWishesBlock",
     "NewAboard"},
    {"States", "Passengers", "DoorWishesBlock", "NewAboard"}};
const gl::Declaration kBoardingMove = {
    "boarding", {"shaders/boarding/move.comp"}, {"ParametersBlock", "VehicleServices"}, {"VehicleServices"}};
const gl::Declaration kBoardingControl = {
    "boarding",
    {"shaders/boarding/control.comp"},
    {"ParametersBlock", "People", "States", "Vehicles", "TrafficStops", "VehicleBoxes", "VehicleDoors",
     "Platforms", "AlightingCalls", "CallHeads", "PlatformVehicles", "VehicleServices", "Passengers",
     "DoorWishesBlock", "DoorStates", "NewAboard"},
    {"States", "Vehicles", "CallHeads", "PlatformVehicles", "VehicleServices", "Passengers", "DoorStates",
     "Chests"}};
const gl::Declaration kBoardingWish = {
    "avoidance",
    {"shaders/boarding/wish.comp"},
    {"ParametersBlock", "LiveDispatch", "Bodies", "Walkers", "VehicleBoxes", "VehicleDoors", "Platforms",
     "PlatformPoints", "VehicleServices", "DoorStates", "Passengers"},
    {"Walkers", "PreferredVelocities"}};

}  // namespace

Boarding::Boarding(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
                   const MotionSettings& rules)
    : buffers_(buffers),
      rows_(static_cast<std::uint32_t>(scene.people.size())),
      move_(buffers.connect(library, kBoardingMove, buffers.definitions())),
      census_(buffers.connect(library, kBoardingCensus, buffers.definitions())),
      control_(buffers.connect(library, kBoardingControl, buffers.definitions())),
      wish_(buffers.connect(library, kBoardingWish, buffers.definitions(rules))) {}

void Boarding::move() {
    move_.dispatch(1);
}

void Boarding::serve(float now, std::uint32_t steps_done) {
    buffers_.door_wishes.fill(0);
    buffers_.new_aboard.fill(0);
    census_.set("steps_done", steps_done);
    census_.dispatch(rows_);
    control_.set("now", now);
    control_.set("steps_done", steps_done);
    control_.dispatch(1);
}

void Boarding::wish() {
    wish_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

}  // namespace throng::sim
