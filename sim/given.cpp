// SPDX-License-Identifier: Apache-2.0
#include "sim/given.h"

namespace throng::sim {
namespace {

const gl::Declaration kWish = {
    "avoidance",
    {"shaders/given/wish.comp"},
    {"LiveDispatch", "Bodies", "Walkers", "GivenWays", "GivenPlaces", "ParametersBlock", "Belts"},
    {"Walkers", "PreferredVelocities"}};
const gl::Declaration kHold = {
    "contacts",
    {"shaders/given/hold.comp"},
    {"LiveDispatch", "Bodies", "Walkers", "States", "Targets", "GivenWays", "GivenPlaces"},
    {"Targets"}};
const gl::Declaration kPlace = {
    "motion",
    {"shaders/given/place.comp"},
    {"States", "Chests", "GivenWays", "GivenPlaces", "ParametersBlock", "ChartCells", "ChartShifts", "Belts"},
    {"States", "Chests"}};

}  // namespace

Given::Given(const gl::ShaderLibrary& library, const Buffers& buffers, const authoring::Scene& scene)
    : buffers_(buffers),
      count_(static_cast<std::uint32_t>(scene.given.ways.size())),
      ways_(gl::makeBuffer("given ways", scene.given.ways, "given person")),
      places_(gl::makeBuffer("places of given ways", scene.given.places, "place of a given way")),
      wish_(buffers.connect(library, kWish, buffers.definitions())),
      hold_(buffers.connect(library, kHold, buffers.definitions())),
      place_(buffers.connect(library, kPlace, buffers.definitions())) {
    for (gl::ComputeProgram* program : {&wish_, &hold_, &place_}) {
        program->bind("GivenWays", ways_);
        program->bind("GivenPlaces", places_);
        program->set("first_given", scene.given.first_row);
    }
    place_.set("given_count", count_);
}

void Given::wish(float now, float until) {
    wish_.set("now", now);
    wish_.set("until", until);
    wish_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

void Given::hold(const gl::Buffer& targets, float until) {
    hold_.bind("Targets", targets);
    hold_.set("until", until);
    hold_.dispatchUpTo(buffers_.slotCapacity(), buffers_.live_dispatch);
}

void Given::place(std::uint32_t steps_done, float until, float step_seconds) {
    place_.set("steps_done", steps_done);
    place_.set("until", until);
    place_.set("step_seconds", step_seconds);
    place_.dispatch(count_);
}

}  // namespace throng::sim
