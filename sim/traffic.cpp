// SPDX-License-Identifier: Apache-2.0
#include "sim/traffic.h"

namespace throng::sim {
namespace {

static_assert(gpu::MOST_VEHICLES < gpu::HEEDED_NONE && gpu::MOST_HEEDED * gpu::HEEDED_BITS <= 32);

const gl::Declaration kLook = {
    "vehicles",
    {"shaders/traffic/people_ahead.comp"},
    {"ParametersBlock", "People", "States", "Vehicles", "Lanes", "LanePoints", "TrafficStops", "Crossings",
     "CrossingPoints", "Lights", "InTheWay", "Platforms", "PlatformPoints"},
    {"InTheWay"}};
const gl::Declaration kDrive = {"vehicles",
                                {"shaders/traffic/drive.comp"},
                                {"ParametersBlock", "Vehicles", "Lanes", "LanePoints", "TrafficStops",
                                 "Lights", "InTheWay", "Platforms", "VehicleServices", "VehicleDoors"},
                                {"Vehicles", "VehicleBoxesMade"}};
const gl::Declaration kKeepOff = {
    "contacts",
    {"shaders/motion/keep_off.comp"},
    {"ParametersBlock", "LiveDispatch", "Bodies", "TouchWords", "WallSegments", "WallStarts", "WallItems",
     "VehicleBoxes", "Crossings", "CrossingPoints", "Lights", "Targets", "VehicleDoors", "Platforms",
     "VehicleServices", "Passengers"},
    {"Targets"}};

}  // namespace

Traffic::Traffic(const gl::ShaderLibrary& library, const authoring::Scene& scene, Buffers& buffers,
                 const gl::Buffer& targets)
    : buffers_(buffers),
      plans_(scene.traffic.lights),
      rows_(static_cast<std::uint32_t>(scene.people.size())),
      vehicles_(scene.traffic.vehicles.size()),
      keep_off_(buffers.connect(library, kKeepOff, buffers.definitions())) {
    keep_off_.bind("Targets", targets);
    if (vehicles_ == 0) return;
    look_ = buffers.connect(library, kLook, buffers.definitions());
    drive_ = buffers.connect(library, kDrive, buffers.definitions());
}

void Traffic::switchLights(double now) {
    std::vector<std::uint32_t> lights;
    lights.reserve(plans_.size());
    for (const authoring::LightPlan& plan : plans_)
        lights.push_back(plan.isGreen(now) ? gpu::LIGHT_GREEN : gpu::LIGHT_RED);
    if (lights == lights_) return;
    lights_ = std::move(lights);
    buffers_.lights.upload(lights_);
}

void Traffic::drive(float now) {
    if (vehicles_ == 0) return;
    buffers_.in_the_way.fill(gpu::NO_INDEX);
    look_.dispatch(rows_);
    drive_.set("now", now);
    drive_.dispatch(1);
}

void Traffic::keepOff() {
    keep_off_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

}  // namespace throng::sim
