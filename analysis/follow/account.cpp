// SPDX-License-Identifier: Apache-2.0
#include "analysis/follow/account.h"

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <map>

#include "shaders/shared/walking.h"

namespace throng::analysis {
namespace {

constexpr double kBackward = 0.05;  // m/s against one's facing, as `throng measure` has it
constexpr double kAstray = 0.3;     // m/s
/// s before a spell that may have brought it about: as long as drive takes to get over something.
constexpr double kBefore = 0.5;

using Amounts = std::map<std::string, double>;
/// How much of what is asked for a change in a step is.
using Asked = std::function<double(const FollowedStep&, glm::dvec2 change)>;

bool isUnderWay(const FollowedStep& step) {
    return step.doing != Doing::arrived &&
           glm::length(glm::dvec2(step.wish)) > static_cast<double>(gpu::STANDING_SPEED);
}

double along(const FollowedStep& step) {
    return glm::dot(glm::dvec2(step.velocity), wayOf(step));
}

bool stands(const FollowedStep& step) {
    return isUnderWay(step) &&
           glm::length(glm::dvec2(step.velocity)) < static_cast<double>(gpu::STANDING_SPEED);
}

/// What of a velocity does not lead along a way.
glm::dvec2 beside(glm::dvec2 velocity, glm::dvec2 way) {
    return velocity - way * std::max(glm::dot(velocity, way), 0.0);
}

bool isAstray(const FollowedStep& step) {
    return isUnderWay(step) && glm::length(beside(step.velocity, wayOf(step))) >= kAstray;
}

/// What each rule has done of it: more and less in one step cancel out.
void add(Amounts& amounts, const FollowedStep& step, const Asked& asked) {
    Amounts here;
    for (const Influence& influence : step.influences)
        if (influence.changed == Changed::velocity)
            here[influence.rule] += asked(step, glm::dvec2(influence.after) - glm::dvec2(influence.before));
    for (const auto& [rule, amount] : here)
        if (amount > 0.0) amounts[rule] += amount;
}

std::vector<RuleShare> shares(const Amounts& amounts) {
    double all = 0.0;
    for (const auto& [rule, amount] : amounts)
        all += std::max(amount, 0.0);
    std::vector<RuleShare> list;
    for (const auto& [rule, amount] : amounts)
        if (amount > 0.0) list.push_back({rule, amount / all});
    std::ranges::stable_sort(list, std::greater(), &RuleShare::share);
    return list;
}

double againstItsWay(const FollowedStep& step, glm::dvec2 change) {
    return -glm::dot(change, wayOf(step));
}

double againstItsFacing(const FollowedStep& step, glm::dvec2 change) {
    return -glm::dot(change, glm::dvec2(step.facing_before));
}

/// Who turns away from where it moves walks backward, too.
void addTurning(Amounts& amounts, const FollowedStep& step) {
    const double turned =
        -glm::dot(glm::dvec2(step.velocity), glm::dvec2(step.facing) - glm::dvec2(step.facing_before));
    if (turned > 0.0) amounts["turning"] += turned;
}

/// Who wishes to go another way than it moves goes astray, too.
void addNewWish(Amounts& amounts, const FollowedStep& earlier, const FollowedStep& step) {
    const glm::dvec2 velocity = step.velocity_before;
    const double more =
        glm::length(beside(velocity, wayOf(step))) - glm::length(beside(velocity, wayOf(earlier)));
    if (more > 0.0) amounts["its own wish"] += more;
}

/// Runs of steps that are so, in the order in which they come.
struct Run {
    std::size_t first = 0, end = 0;
};

std::vector<Run> runsOf(std::span<const FollowedStep> steps, bool (*is_so)(const FollowedStep&)) {
    std::vector<Run> runs;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!is_so(steps[i])) continue;
        const bool goes_on =
            !runs.empty() && runs.back().end == i && i > 0 && steps[i].step == steps[i - 1].step + 1;
        if (!goes_on) runs.push_back({i, i});
        runs.back().end = i + 1;
    }
    return runs;
}

class Accountant {
  public:
    Accountant(std::span<const FollowedStep> steps, double step_seconds, glm::dvec2 origin)
        : steps_(steps), seconds_(step_seconds), origin_(origin) {}

    FollowAccount account() {
        result_.row = steps_.front().row;
        result_.steps = steps_.size();
        result_.from = steps_.front().time - seconds_;
        result_.to = steps_.back().time;
        addUp();
        addStandstills();
        addAstray();
        addBackward();
        return result_;
    }

  private:
    void addUp() {
        Amounts held;
        for (const FollowedStep& step : steps_) {
            result_.decisions += step.decides ? 1 : 0;
            result_.walked += glm::length(glm::dvec2(step.place) - glm::dvec2(step.place_before));
            if (!isUnderWay(step)) continue;
            result_.under_way += seconds_;
            result_.wished_speed += glm::length(glm::dvec2(step.wish));
            result_.had_speed += along(step);
            add(held, step, againstItsWay);
        }
        const double count = std::max(result_.under_way / seconds_, 1.0);
        result_.wished_speed /= count;
        result_.had_speed /= count;
        result_.held_back = shares(held);
    }

    Spell spellOf(const Run& run, const Amounts& amounts) const {
        const FollowedStep& first = steps_[run.first];
        return {first.time - seconds_, steps_[run.end - 1].time, origin_ + glm::dvec2(first.place_before),
                shares(amounts)};
    }

    static bool isLonger(const Spell& spell, const std::optional<Spell>& than) {
        return !than || spell.to - spell.from > than->to - than->from;
    }

    void addStandstills() {
        for (const Run& run : runsOf(steps_, stands)) {
            Amounts amounts;
            for (std::size_t i = run.first; i < run.end; ++i)
                add(amounts, steps_[i], againstItsWay);
            const Spell spell = spellOf(run, amounts);
            result_.standing += spell.to - spell.from;
            if (isLonger(spell, result_.longest_standstill)) result_.longest_standstill = spell;
        }
    }

    void addAstray() {
        Amounts amounts;
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            const FollowedStep& step = steps_[i];
            if (!isAstray(step)) continue;
            result_.astray += seconds_;
            const glm::dvec2 where = glm::normalize(beside(step.velocity, wayOf(step)));
            add(amounts, step,
                [&](const FollowedStep&, glm::dvec2 change) { return glm::dot(change, where); });
            if (i > 0 && steps_[i - 1].step + 1 == step.step) addNewWish(amounts, steps_[i - 1], step);
        }
        result_.astray_causes = shares(amounts);
    }

    /// From where it began to move back to where it was fastest.
    Run buildUpOf(const Run& run) const {
        const auto back = [&](std::size_t i) {
            return -glm::dot(glm::dvec2(steps_[i].velocity), glm::dvec2(steps_[i].facing));
        };
        Run built = {run.first, run.first + 1};
        for (std::size_t i = run.first; i < run.end; ++i)
            if (back(i) > back(built.end - 1)) built.end = i + 1;
        while (built.first > 0 && steps_[run.first].time - steps_[built.first].time < kBefore &&
               back(built.first) > 0.0)
            --built.first;
        return built;
    }

    void addBackward() {
        Amounts all;
        for (const FollowedStep& step : steps_)
            if (step.doing != Doing::arrived &&
                glm::length(glm::dvec2(step.velocity)) >= static_cast<double>(gpu::STANDING_SPEED))
                result_.moving += seconds_;
        for (const Run& run : runsOf(steps_, isBackward)) {
            Amounts amounts;
            const Run built = buildUpOf(run);
            for (std::size_t i = built.first; i < built.end; ++i) {
                add(amounts, steps_[i], againstItsFacing);
                addTurning(amounts, steps_[i]);
            }
            for (const auto& [rule, amount] : amounts)
                all[rule] += amount;
            const Spell spell = spellOf(run, amounts);
            result_.backward += spell.to - spell.from;
            ++result_.backward_spells;
            if (isLonger(spell, result_.longest_backward)) result_.longest_backward = spell;
            for (std::size_t i = run.first; i < run.end; ++i)
                if (glm::dot(steps_[i].wish, steps_[i].facing) < 0.0f) result_.backward_by_wish += seconds_;
        }
        result_.backward_causes = shares(all);
    }

    std::span<const FollowedStep> steps_;
    double seconds_;
    glm::dvec2 origin_;
    FollowAccount result_;
};

}  // namespace

bool isBackward(const FollowedStep& step) {
    const glm::dvec2 velocity = step.velocity;
    return step.doing != Doing::arrived &&
           glm::length(velocity) >= static_cast<double>(gpu::STANDING_SPEED) &&
           glm::dot(velocity, glm::dvec2(step.facing)) < -kBackward;
}

glm::dvec2 wayOf(const FollowedStep& step) {
    const glm::dvec2 wish = step.wish;
    const double speed = glm::length(wish);
    return speed > static_cast<double>(gpu::STANDING_SPEED) ? wish / speed : glm::dvec2(step.facing_before);
}

FollowAccount accountOf(std::span<const FollowedStep> steps, double step_seconds, glm::dvec2 origin) {
    return Accountant(steps, step_seconds, origin).account();
}

}  // namespace throng::analysis
