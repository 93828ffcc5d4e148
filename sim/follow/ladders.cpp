// SPDX-License-Identifier: Apache-2.0
#include "sim/follow/ladders.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {
namespace {

constexpr const char* kWalls = "out_of_walls";
constexpr const char* kJams = "routes_round_jams";

gl::Buffer alike(const gl::Buffer& model) {
    const gl::Contents& contents = *model.contents();
    const std::size_t bytes = std::max<std::size_t>(contents.element_bytes, 1);
    return {"followed " + contents.name, gl::Room{model.bytes() / bytes, bytes, contents.per}};
}

}  // namespace

Ladders::Ladders(Simulation::Parts& parts, const authoring::Scene& scene)
    : parts_(parts), ground_(scene.terrain && parts.slopes ? &*parts.slopes : nullptr) {
    const Buffers& all = parts.buffers;
    walkers_ = alike(all.walkers);
    wishes_ = alike(all.preferred_velocities);
    touch_words_ = alike(all.touch_words);
    touched_ = alike(all.touch_words);
    targets_ = alike(all.targets);
    targets_after_ = alike(all.targets_after);
    ways_ = alike(all.ways);
    decisions_ = alike(all.decisions);
    no_jams_ = alike(all.detour_slopes);
    no_jams_.fill(0);
    kept_targets_ = alike(all.targets);
    kept_states_ = alike(all.states);
    states_ = alike(all.states);
    kept_lines_ = alike(all.lines);
    lines_ = alike(all.lines);
    chests_ = alike(all.chests);
    makeDecisions();
    makeContacts();
    makeMotion();
}

void Ladders::makeDecisions() {
    const MotionSettings& told = parts_.settings.motion;
    const gl::ShaderLibrary& library = parts_.library;
    const std::vector<std::string> on_slopes =
        ground_ ? std::vector<std::string>{"slope_pace"} : std::vector<std::string>{};
    const auto steer = [&](const std::string& rule, const MotionSettings& rules) -> gl::ComputeProgram& {
        steer_.push_back(
            {rule, makeSteer(library, parts_.buffers, rules.isOn("slope_pace") ? ground_ : nullptr, rules)});
        steer_.back().program.bindAll({{"Walkers", &walkers_},
                                       {"PreferredVelocities", &wishes_},
                                       {"TouchWords", &touch_words_},
                                       {"DetourSlopes", &no_jams_}});
        return steer_.back().program;
    };
    for (const Rung& rung : rungsOf(library, "shaders/motion/steer.comp", told, "route", on_slopes))
        steer(rung.rule, rung.rules);
    // Jams are not a switch of the program: without them, the map of what they add is empty.
    steer(kJams, told).bindAll({{"DetourSlopes", &parts_.buffers.detour_slopes}});

    for (const Rung& rung : rungsOf(library, "shaders/motion/avoid.comp", told, "drive"))
        avoid_.push_back(
            {rung.rule, makeAvoid(library, parts_.buffers, parts_.settings.neighbours, rung.rules)});
    for (const Rung& rung : rungsOf(library, "shaders/motion/carry_on.comp", told, "carry_on"))
        carry_on_.push_back({rung.rule, makeCarryOn(library, parts_.buffers, rung.rules)});
    for (std::vector<Step>* ladder : {&avoid_, &carry_on_})
        for (Step& step : *ladder)
            step.program.bindAll({{"TouchWords", &touched_},
                                  {"Targets", &targets_},
                                  {"TargetsAfter", &targets_after_},
                                  {"Ways", &ways_}});
    for (Step& step : avoid_)
        step.program.bind("Decisions", decisions_);
}

Climb Ladders::climbTo(const std::string& rule, const gl::Buffer& targets, std::uint32_t slots) const {
    Climb climb{rule, targets.downloadParts<glm::vec2>(slots)};
    if (parts_.buffers.hasBodies())
        climb.axes = targets.downloadParts<glm::vec2>(slots, 0, sizeof(glm::vec2));
    return climb;
}

void Ladders::makeContacts() {
    const auto add = [&](const std::string& rule, const MotionSettings& rules,
                         const gl::Buffer& touch_words) {
        contacts_.push_back(
            {rule, Contacts(parts_.library, parts_.buffers, parts_.settings.contact_iterations, rules,
                            {targets_, targets_after_, touch_words})});
    };
    for (const Rung& rung :
         rungsOf(parts_.library, "shaders/motion/contact.comp", parts_.settings.motion, "contact",
                 {"contact_momentum", "standing_fast", "headway", "impatience", "climbing"}))
        add(rung.rule, rung.rules, touched_);
    add(kWalls, parts_.settings.motion, parts_.buffers.touch_words);
}

void Ladders::makeMotion() {
    for (const Rung& rung :
         rungsOf(parts_.library, "shaders/motion/move.comp", parts_.settings.motion, "turning")) {
        move_.push_back({rung.rule, makeMove(parts_.library, parts_.buffers, rung.rules)});
        move_.back().program.bindAll(
            {{"Targets", &parts_.contacts.result()}, {"States", &states_}, {"WaitingLines", &lines_}});
        if (parts_.buffers.hasBodies()) move_.back().program.bind("Chests", chests_);
    }
}

void Ladders::keepTouchWords() {
    touch_words_.copyFrom(parts_.buffers.touch_words);
    walkers_.copyFrom(parts_.buffers.walkers);
}

std::vector<Climb> Ladders::wishes(std::uint32_t slots) {
    std::vector<Climb> climbs;
    for (Step& step : steer_) {
        step.program.setIfUsed("steps_done", parts_.steps_done);
        step.program.dispatch(slots);
        climbs.push_back({step.rule, wishes_.download<glm::vec2>(slots)});
    }
    return climbs;
}

std::vector<ClimbToDecide> Ladders::decided(std::uint32_t slots) {
    std::vector<ClimbToDecide> climbs;
    for (Step& step : avoid_) {
        touched_.copyFrom(touch_words_);
        step.program.dispatch(slots);
        climbs.push_back({climbTo(step.rule, targets_, slots), decisions_.downloadParts<glm::vec2>(slots)});
    }
    return climbs;
}

std::vector<Climb> Ladders::carriedOn(std::uint32_t slots) {
    std::vector<Climb> climbs;
    for (Step& step : carry_on_) {
        step.program.dispatch(slots);
        climbs.push_back(climbTo(step.rule, targets_, slots));
    }
    return climbs;
}

void Ladders::keepTargets() {
    kept_targets_.copyFrom(parts_.buffers.targets);
}

std::vector<Climb> Ladders::pushed(std::uint32_t slots, const std::vector<std::uint32_t>& followed) {
    touched_.copyFrom(parts_.buffers.touch_words);
    for (const std::uint32_t slot : followed) {
        std::vector<std::uint32_t> word = touched_.download<std::uint32_t>(1, slot);
        word.front() &= ~gpu::TOUCH_WALL_NEAR;
        touched_.upload(std::span<const std::uint32_t>(word), slot);
    }
    std::vector<Climb> climbs;
    for (Round& round : contacts_) {
        targets_.copyFrom(kept_targets_);
        targets_after_.copyFrom(kept_targets_);
        round.contacts.run();
        climbs.push_back(climbTo(round.rule, round.contacts.result(), slots));
    }
    return climbs;
}

void Ladders::keepStates() {
    kept_states_.copyFrom(parts_.buffers.states);
    kept_lines_.copyFrom(parts_.buffers.lines);
}

std::vector<Climb> Ladders::turned(std::uint32_t slots, std::uint32_t steps_done,
                                   const std::vector<std::uint32_t>& rows) {
    std::vector<Climb> climbs;
    for (Step& step : move_) {
        states_.copyFrom(kept_states_);
        lines_.copyFrom(kept_lines_);
        step.program.set("steps_done", steps_done);
        step.program.dispatch(slots);
        Climb climb{step.rule, {}};
        for (const std::uint32_t row : rows) {
            const float heading = states_.download<gpu::AgentState>(1, row).front().heading;
            climb.values.emplace_back(std::cos(heading), std::sin(heading));
        }
        climbs.push_back(std::move(climb));
    }
    return climbs;
}

}  // namespace throng::sim
