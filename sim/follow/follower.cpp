// SPDX-License-Identifier: Apache-2.0
#include "sim/follow/follower.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "sim/follow/ladders.h"
#include "sim/follow/senses.h"

namespace throng::sim {
namespace {

/// Places are in single precision, and a step is a fiftieth of a second: less than this is rounding. What is
/// left out goes to the next rule that does something.
constexpr float kNoise = 1.0e-3f;

bool isThere(const gpu::AgentState& state) {
    return state.status == gpu::STATUS_WALKING || state.status == gpu::STATUS_ARRIVED;
}

Doing doingOf(const gpu::AgentState& state) {
    if (state.status == gpu::STATUS_ARRIVED) return Doing::arrived;
    if (state.ticket != gpu::NO_INDEX) return Doing::queueing;
    return state.leave_step != 0 ? Doing::stopping : Doing::walking;
}

/// Puts influences one after the other, each from where the last one ended.
class Chain {
  public:
    Chain(FollowedStep& step, std::string_view pass, Changed changed, glm::vec2 from)
        : step_(step), pass_(pass), changed_(changed), at_(from) {}

    void to(const std::string& rule, glm::vec2 after) {
        if (glm::length(after - at_) < kNoise) return;
        step_.influences.push_back({pass_, rule, changed_, at_, after});
        at_ = after;
    }
    void by(const std::string& rule, glm::vec2 change) { to(rule, at_ + change); }
    glm::vec2 at() const { return at_; }

  private:
    FollowedStep& step_;
    std::string_view pass_;
    Changed changed_;
    glm::vec2 at_;
};

}  // namespace

class Follower::Eye {
  public:
    Eye(Simulation& simulation, const authoring::Scene& scene, std::vector<std::uint32_t> rows)
        : parts_(simulation.parts()), scene_(scene), rows_(std::move(rows)), ladders_(parts_, scene) {}

    std::vector<FollowedStep> step() {
        parts_.beginStep();
        begin();
        for (const Pass& pass : parts_.passes) {
            before(pass.name);
            pass.run();
            after(pass.name);
        }
        std::vector<FollowedStep> told;
        for (auto& [row, watched] : present_)
            told.push_back(watched->now);
        present_.clear();
        return told;
    }
    bool allHaveLeft() const { return left_ == rows_.size(); }

  private:
    /// Somebody, from one step to the next.
    struct Watched {
        FollowedStep now;
        std::optional<std::uint32_t> slot;                           // since the last decision
        glm::vec2 velocity{0.0f};                                    // m/s, as far as the step has come
        glm::vec2 chest{1.0f, 0.0f};                                 // likewise
        glm::vec2 ground{0.0f};                                      // m/s, to which velocities are relative
        std::vector<std::pair<std::string, glm::vec2>> each_step{};  // m/s: what it decided for each step
    };

    void begin() {
        slots_ = parts_.decides ? 0 : slots_;
        left_ = 0;
        for (const std::uint32_t row : rows_) {
            const gpu::AgentState state = stateOf(row);
            Watched& watched = watched_[row];
            left_ += state.status == gpu::STATUS_GONE ? 1 : 0;
            if (!isThere(state)) continue;
            lookAt(row, state);
            if (!parts_.decides && watched.slot) present_[row] = &watched;
        }
    }

    gpu::AgentState stateOf(std::uint32_t row) const {
        return parts_.buffers.states.download<gpu::AgentState>(1, row).front();
    }

    /// What somebody is as the step begins, or where it has come in by it.
    void lookAt(std::uint32_t row, const gpu::AgentState& state) {
        Watched& watched = watched_[row];
        FollowedStep& now = watched.now;
        const gpu::Person& person = scene_.people[row];
        now.row = row;
        now.step = parts_.steps_done;
        now.time = double{parts_.now()};
        now.decides = parts_.decides;
        now.doing = doingOf(state);
        now.stage = state.stage - firstStage(person, state);
        now.goal = scene_.stages[state.stage].point;
        now.radius = person.radius;
        now.preferred_speed = person.preferred_speed;
        now.place_before = now.place = state.position;
        now.facing_before = now.facing = {std::cos(state.heading), std::sin(state.heading)};
        now.velocity_before = now.velocity = state.velocity;
        lookAtChest(row, now);
        now.chest_before = now.chest;
        now.nervousness = state.nervousness;
        now.influences.clear();
        watched.velocity = state.velocity;
        watched.chest = now.chest;
    }

    void lookAtChest(std::uint32_t row, FollowedStep& now) const {
        now.chest = now.facing;
        if (!parts_.buffers.hasBodies()) return;
        const gpu::Chest chest = parts_.buffers.chests.download<gpu::Chest>(1, row).front();
        now.half_axis = chest.half_axis;
        if (now.half_axis != 0.0f) now.chest = {std::cos(chest.angle), std::sin(chest.angle)};
    }

    void before(const std::string& pass) {
        if (pass == "avoidance") {
            findSlots();
            if (parts_.decides) ladders_.keepTouchWords();
        }
        if (pass == "contacts") ladders_.keepTargets();
        if (pass == "motion") ladders_.keepStates();
    }

    void after(const std::string& pass) {
        if (present_.empty()) return;
        if (pass == "avoidance" && parts_.decides) lookAtDecision();
        if (pass == "avoidance" && !parts_.decides) lookAtCarryingOn();
        if (pass == "contacts") lookAtContact();
        if (pass == "motion") lookAtMotion();
    }

    std::uint32_t firstStage(const gpu::Person& person, const gpu::AgentState& state) const {
        if (state.changes == 0) return person.first_stage;
        return scene_.plan_changes[person.first_change + state.changes - 1].first_stage;
    }

    /// Slots are made anew where people decide.
    void findSlots() {
        if (!parts_.decides) return;
        const std::uint32_t live = parts_.buffers.live_dispatch.download<std::uint32_t>(1, 3).front();
        bodies_ = parts_.buffers.bodies.download<gpu::Body>(live);
        for (auto& [row, watched] : watched_)
            watched.slot.reset();
        const auto walkers = parts_.buffers.walkers.downloadParts<gpu::Walker>(live);
        if (parts_.buffers.hasBodies())
            chests_ = parts_.buffers.chests.download<gpu::Chest>(scene_.people.size());
        for (std::uint32_t slot = 0; slot < live; ++slot) {
            const auto found = watched_.find(bodies_[slot].row);
            if (found == watched_.end() || (walkers[slot].flags & gpu::WALKER_IS_IMAGE) != 0) continue;
            if (found->second.now.step != parts_.steps_done)  // it has come in by this step
                lookAt(found->first, stateOf(found->first));
            found->second.slot = slot;
            slots_ = slot + 1;
            present_[found->first] = &found->second;
            found->second.now.place_before = bodies_[slot].position;  // beyond a seam, if it walked over one
            tellSenses(parts_, scene_, {bodies_, chests_}, slot, found->second.now);
        }
    }

    /// m/s: of the ground that carries somebody until the next decision (shaders/charts/belts.glsl). A step
    /// adds what that is in it, rounded as all that is added to places is among charts.
    glm::vec2 groundUnder(std::uint32_t slot) const {
        const std::vector<gpu::Belt>& belts = scene_.chart_map.belts;
        if (belts.empty()) return glm::vec2(0.0f);
        const std::uint32_t flags = parts_.buffers.walkers.downloadParts<gpu::Walker>(1, slot).front().flags;
        if ((flags & gpu::WALKER_IS_CARRIED) == 0) return glm::vec2(0.0f);
        const float seconds = parts_.parameters.step_seconds;
        const glm::vec2 way = belts[flags >> gpu::WALKER_CHART_AT & gpu::NO_CHART].velocity * seconds;
        return glm::round(way * gpu::PLACES_PER_METRE) / gpu::PLACES_PER_METRE / seconds;
    }

    glm::vec2 velocityTo(const Watched& watched, glm::vec2 target) const {
        return (target - watched.now.place_before) / parts_.parameters.step_seconds - watched.ground;
    }

    void lookAtDecision() {
        const std::vector<Climb> wishes = ladders_.wishes(slots_);
        const std::vector<ClimbToDecide> decided = ladders_.decided(slots_);
        for (auto& [row, watched] : present_) {
            watched->ground = groundUnder(*watched->slot);
            tellWish(*watched, wishes);
            FollowedStep& now = watched->now;
            now.free_ahead = freeAhead(now);
            now.pace = parts_.buffers.decisions.downloadParts<gpu::Decision>(1, *watched->slot).front().pace;
            watched->each_step.clear();
            Chain chain(now, "avoidance", Changed::velocity, watched->velocity);
            glm::vec2 change(0.0f);
            for (const ClimbToDecide& climb : decided) {
                chain.to(climb.target.rule, velocityTo(*watched, climb.target.values[*watched->slot]));
                const glm::vec2 with_it = climb.changes[*watched->slot];
                if (with_it != change) watched->each_step.emplace_back(climb.target.rule, with_it - change);
                change = with_it;
            }
            watched->velocity = chain.at();
            turnShoulders(*watched, decided.back().target);
        }
    }

    /// A chest turns to where it is wanted, whatever made that so: no rule of a decision does it.
    void turnShoulders(Watched& watched, const Climb& target) const {
        Chain chain(watched.now, "avoidance", Changed::chest, watched.chest);
        if (const auto chest = chestAt(watched, target)) chain.to("shoulders", *chest);
        watched.chest = chain.at();
    }

    /// Where the chest of a body that is no disc points.
    static std::optional<glm::vec2> chestAt(const Watched& watched, const Climb& target) {
        const float half_axis = watched.now.half_axis;
        if (target.axes.empty() || half_axis == 0.0f) return std::nullopt;
        const glm::vec2 along = target.axes[*watched.slot] / half_axis;
        return half_axis > 0.0f ? glm::vec2(along.y, -along.x) : -along;
    }

    void tellWish(Watched& watched, const std::vector<Climb>& wishes) {
        FollowedStep& now = watched.now;
        const std::uint32_t slot = *watched.slot;
        now.wish = parts_.buffers.preferred_velocities.download<glm::vec2>(1, slot).front();
        // Without any rule it walks at its own pace along its route, but for its place where it stops there.
        const glm::vec2 bare = wishes.front().values[slot];
        const float speed = glm::length(bare);
        Chain chain(now, "avoidance", Changed::wish, glm::vec2(0.0f));
        if (speed > 0.0f) chain.to("route", bare * (now.preferred_speed / speed));
        chain.to("coming_to_rest", bare);
        for (std::size_t rung = 1; rung < wishes.size(); ++rung)
            chain.to(wishes[rung].rule, wishes[rung].values[slot]);
        if (parts_.patches && !parts_.lifts && !parts_.boarding) chain.to("slow_ground", now.wish);
    }

    /// Legs go on as was decided, each rule with what it has done to that; what contact has done since comes
    /// on top.
    void lookAtCarryingOn() {
        const std::vector<Climb> carried = ladders_.carriedOn(slots_);
        for (auto& [row, watched] : present_) {
            Chain chain(watched->now, "avoidance", Changed::velocity, watched->velocity);
            for (const auto& [rule, change] : watched->each_step)
                chain.by(rule, change);
            for (const Climb& climb : carried)
                chain.to(climb.rule, velocityTo(*watched, climb.values[*watched->slot]));
            watched->velocity = chain.at();
            turnShoulders(*watched, carried.back());
        }
    }

    void lookAtContact() {
        std::vector<std::uint32_t> followed;
        for (const auto& [row, watched] : present_)
            followed.push_back(*watched->slot);
        const std::vector<Climb> pushed = ladders_.pushed(slots_, followed);
        for (auto& [row, watched] : present_) {
            Chain chain(watched->now, "contacts", Changed::velocity, watched->velocity);
            for (const Climb& climb : pushed)
                chain.to(climb.rule, velocityTo(*watched, climb.values[*watched->slot]));
            watched->velocity = chain.at();
            Chain chest(watched->now, "contacts", Changed::chest, watched->chest);
            for (const Climb& climb : pushed)
                if (const auto turned = chestAt(*watched, climb)) chest.to(climb.rule, *turned);
            watched->chest = chest.at();
        }
    }

    void lookAtMotion() {
        std::vector<std::uint32_t> rows;
        for (const auto& [row, watched] : present_)
            rows.push_back(row);
        const std::vector<Climb> turned = ladders_.turned(slots_, parts_.steps_done, rows);
        std::size_t nth = 0;
        for (auto& [row, watched] : present_) {
            const gpu::AgentState state = stateOf(row);
            FollowedStep& now = watched->now;
            now.place = state.position;
            now.velocity = state.velocity;
            now.nervousness = state.nervousness;
            now.facing = {std::cos(state.heading), std::sin(state.heading)};
            lookAtChest(row, now);
            Chain velocity(now, "motion", Changed::velocity, watched->velocity);
            const bool too_fast = glm::length(watched->velocity) > glm::length(now.velocity) + kNoise;
            velocity.to(too_fast ? "maximum_speed" : "rounding", now.velocity);
            Chain facing(now, "motion", Changed::heading, now.facing_before);
            for (const Climb& climb : turned)
                facing.to(climb.rule, climb.values[nth]);
            ++nth;
        }
    }

    Simulation::Parts& parts_;
    const authoring::Scene& scene_;
    std::vector<std::uint32_t> rows_;
    Ladders ladders_;
    std::vector<gpu::Body> bodies_;   // of all slots, as of the last decision
    std::vector<gpu::Chest> chests_;  // likewise, of all rows; none where all are discs
    std::uint32_t slots_ = 0;         // up to the last one that is followed
    std::size_t left_ = 0;            // people who are no more
    std::map<std::uint32_t, Watched> watched_;
    std::map<std::uint32_t, Watched*> present_;  // in this step
};

Follower::Follower(Simulation& simulation, const authoring::Scene& scene, std::vector<std::uint32_t> rows)
    : eye_(std::make_unique<Eye>(simulation, scene, std::move(rows))) {}
Follower::~Follower() = default;

std::vector<FollowedStep> Follower::step() {
    return eye_->step();
}

bool Follower::allHaveLeft() const {
    return eye_->allHaveLeft();
}

}  // namespace throng::sim
