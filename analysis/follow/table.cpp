// SPDX-License-Identifier: Apache-2.0
#include "analysis/follow/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>

#include "analysis/follow/account.h"

namespace throng::analysis {
namespace {

constexpr const char* kInfluences =
    "row,step,time_s,pass,rule,changed,before_x,before_y,after_x,after_y,along_wish,left_of_wish\n";
constexpr const char* kSteps =
    "row,step,time_s,decides,doing,stage,goal_x_m,goal_y_m,x_m,y_m,facing_x,facing_y,chest_x,chest_y,"
    "wish_x_m_s,wish_y_m_s,velocity_x_m_s,velocity_y_m_s,along_wish_m_s,pace_m_s,backward,nervousness,"
    "sensed,nearest_row,nearest_gap_m,touch_row,touch_s,free_ahead_m,wall_gap_m,touching,in_narrows\n";

constexpr const char* kWords[] = {"walking", "stopping", "queueing", "arrived"};
constexpr const char* kChanged[] = {"wish", "velocity", "heading", "chest"};

OutputFile fresh(const std::filesystem::path& path) {
    removeFile(path);
    return OutputFile(path);
}

/// Nothing where there is none.
std::string orNothing(float value) {
    return value < 0.0f ? "" : fmt::format("{:.4f}", value);
}

void tellInfluences(std::string& text, const FollowedStep& step) {
    const glm::dvec2 way = wayOf(step);
    for (const Influence& each : step.influences) {
        const glm::dvec2 change = glm::dvec2(each.after) - glm::dvec2(each.before);
        fmt::format_to(std::back_inserter(text),
                       "{},{},{:.4f},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", step.row,
                       step.step, step.time, each.pass, each.rule, kChanged[static_cast<int>(each.changed)],
                       each.before.x, each.before.y, each.after.x, each.after.y, glm::dot(change, way),
                       way.x * change.y - way.y * change.x);
    }
}

void tellSensed(std::string& text, const FollowedStep& step) {
    const SensedPerson* soonest = nullptr;
    for (const SensedPerson& other : step.sensed)
        if (other.seconds_to_touch >= 0.0f &&
            (!soonest || other.seconds_to_touch < soonest->seconds_to_touch))
            soonest = &other;
    const auto nearest = std::ranges::min_element(step.sensed, {}, &SensedPerson::gap);
    const bool senses = nearest != step.sensed.end();
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},", step.sensed.size(),
                   senses ? fmt::format("{}", nearest->row) : "",
                   senses ? fmt::format("{:.4f}", nearest->gap) : "",
                   soonest ? fmt::format("{}", soonest->row) : "",
                   soonest ? fmt::format("{:.4f}", soonest->seconds_to_touch) : "");
}

void tellStep(std::string& text, const FollowedStep& step, glm::dvec2 origin) {
    const glm::dvec2 goal = origin + glm::dvec2(step.goal);
    const glm::dvec2 place = origin + glm::dvec2(step.place);
    fmt::format_to(std::back_inserter(text), "{},{},{:.4f},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},", step.row,
                   step.step, step.time, step.decides ? 1 : 0, kWords[static_cast<int>(step.doing)],
                   step.stage, goal.x, goal.y, place.x, place.y);
    fmt::format_to(std::back_inserter(text),
                   "{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{:.4f},",
                   step.facing.x, step.facing.y, step.chest.x, step.chest.y, step.wish.x, step.wish.y,
                   step.velocity.x, step.velocity.y, glm::dot(glm::dvec2(step.velocity), wayOf(step)),
                   step.pace, isBackward(step) ? 1 : 0, step.nervousness);
    tellSensed(text, step);
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", orNothing(step.free_ahead),
                   orNothing(step.wall_gap), step.touching, step.in_narrows ? 1 : 0);
}

}  // namespace

FollowTables::FollowTables(const std::filesystem::path& folder, glm::dvec2 origin)
    : origin_(origin), influences_(fresh(folder / "follow.csv")), steps_(fresh(folder / "follow-steps.csv")) {
    influences_.write(kInfluences);
    steps_.write(kSteps);
}

void FollowTables::write(std::span<const FollowedStep> steps) {
    std::string influences, lines;
    for (const FollowedStep& step : steps) {
        tellInfluences(influences, step);
        tellStep(lines, step, origin_);
    }
    influences_.write(influences);
    steps_.write(lines);
}

void FollowTables::finish() {
    influences_.finish();
    steps_.finish();
}

}  // namespace throng::analysis
