// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/applied_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace throng::io {
namespace {

class RowEdit {
  public:
    RowEdit(LayeredCrowd& crowd, const ChangedRow& each)
        : crowd_(crowd), each_(each), plan_(crowd.plan(each.row)), table_(crowd.table()) {}

    void write() {
        const std::uint32_t row = each_.row;
        table_.set(row, "overrides", fmt::format("{}", fmt::join(plan_.words, " ")));
        for (const Step& step : plan_.steps) {
            const authoring::PersonChange& change = step.change;
            if (change.scale) table_.set(row, "scale", fmt::format("{}", *change.scale));
            if (change.tint) table_.set(row, "tint", change.tint->text);
            if (change.character) table_.set(row, "variation", fmt::format("{}", *change.character));
            if (change.moves()) moveGoal(step);
        }
        const auto hides = [](const Step& step) { return step.change.hides(); };
        const auto hider = std::ranges::find_if(plan_.steps, hides);
        const auto is_retimed = [](const Step& step) { return step.change.retimes() && step.first; };
        const auto is_hidden = [](const Step& step) { return step.hidden.has_value(); };
        if (hider != plan_.steps.end())
            refuse(!hider->change.hide  ? "a hero outside the crowd"
                   : hider->is_of_layer ? "hidden by a layer"
                                        : "hidden by an override");
        else if (std::ranges::any_of(plan_.steps, is_retimed))
            retime();
        else if (std::ranges::any_of(plan_.steps, is_hidden))
            setEntry("hidden by a layer");
    }

  private:
    void refuse(const std::string& reason) {
        table_.set(each_.row, "outcome", "refused");
        table_.set(each_.row, "reason", reason);
        table_.set(each_.row, "spawn_frame", "");
        table_.set(each_.row, "arrival_frame", "");
    }

    /// Who was never there before is none the worse. @returns whether it is there at all
    bool setEntry(const char* reason) {
        if (each_.first_alive == kNever) {
            if (!table_.at(each_.row, "spawn_frame").empty()) refuse(reason);
            return false;
        }
        table_.set(each_.row, "spawn_frame", std::to_string(each_.first_alive));
        return true;
    }

    void retime() {
        if (!setEntry("retimed out of the shot")) return;
        const std::optional<std::uint32_t> arrival = table_.frame(each_.row, "arrival_frame");
        if (!arrival) return;
        double frame = *arrival;
        for (const Step& step : plan_.steps)
            if (step.change.retimes() && step.first)
                frame = *step.first + step.change.delay + (frame - *step.first) / step.change.speed;
        frame = std::ceil(frame - 1.0e-9);
        const bool is_in_shot = frame < static_cast<double>(crowd_.frames());
        table_.set(each_.row, "arrival_frame", is_in_shot ? fmt::format("{:.0f}", std::max(frame, 0.0)) : "");
        if (!is_in_shot) table_.set(each_.row, "outcome", "walking");
    }

    /// Goals are the world's, where the streams start from the bake's origin.
    void moveGoal(const Step& step) {
        const glm::dvec2 pivot = crowd_.bake().origin + glm::dvec2(step.pivot[0], step.pivot[1]);
        const glm::dvec2 goal(table_.number(each_.row, "goal_x"), table_.number(each_.row, "goal_y"));
        const double angle = step.change.turn * std::numbers::pi / 180.0;
        const glm::dvec2 arm = goal - pivot;
        const double x = pivot.x + std::cos(angle) * arm.x - std::sin(angle) * arm.y + step.change.move.x;
        const double y = pivot.y + std::sin(angle) * arm.x + std::cos(angle) * arm.y + step.change.move.y;
        table_.set(each_.row, "goal_x", fmt::format("{}", x));
        table_.set(each_.row, "goal_y", fmt::format("{}", y));
    }

    LayeredCrowd& crowd_;
    const ChangedRow& each_;
    const RowPlan& plan_;
    AgentTableEdit& table_;
};

}  // namespace

void writeAppliedRow(LayeredCrowd& crowd, const ChangedRow& each) {
    RowEdit(crowd, each).write();
}

}  // namespace throng::io
