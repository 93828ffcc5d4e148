// SPDX-License-Identifier: Apache-2.0
// What people do: conditions against plain C++, and what a state makes of those who are in it.
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

constexpr std::uint32_t kPurposeTime = 0xb1, kPurposeChance = 0xb5;  // shaders/behaviour/draws.glsl

std::uint32_t scrambled(std::uint32_t x) {
    x = x * 747796405u + 2891336453u;
    x = ((x >> ((x >> 28u) + 4u)) ^ x) * 277803737u;
    return (x >> 22u) ^ x;
}

float unitOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return static_cast<float>(scrambled(a ^ scrambled(b ^ scrambled(c))) >> 8) / 16777216.0f;
}

/// A crowd in which everybody has two stages, and states by turns.
struct Crowd {
    explicit Crowd(std::uint32_t count) : scene(uniformScene(count, 0.8f, 5)) {
        scene.stages.resize(2 * std::size_t{count}, scene.stages.front());
        for (std::uint32_t row = 0; row < count; ++row) {
            gpu::Person& person = scene.people[row];
            person.first_stage = 2 * row;
            person.stage_count = 2;
            gpu::Stage& stage = scene.stages[2 * std::size_t{row}];
            stage.point = person.spawn_position + glm::vec2(50.0f, 0.0f);
            scene.stages[2 * std::size_t{row} + 1] = stage;
            gpu::Mind mind{};
            mind.place = mind.followed = gpu::NO_INDEX;
            mind.first_stage = person.first_stage;
            mind.entered = 1;
            mind.since = 1u - 7 * row % 100;  // in the first step, so many steps ago
            scene.behaviours.minds.push_back(mind);
        }
        const float side = scene.maximum.x - 2.0f;
        for (const glm::vec2 corner :
             {glm::vec2(0, 0), {0.4f * side, 0}, {0.4f * side, side}, {0, 0.7f * side}})
            scene.behaviours.points.push_back(corner);
    }

    std::uint32_t rows() const { return static_cast<std::uint32_t>(scene.people.size()); }
    glm::vec2 place(std::uint32_t row) const { return scene.people[row].spawn_position; }

    /// A state that these conditions, all of them, end.
    void addState(const std::vector<gpu::BehaviourRule>& conditions) {
        gpu::BehaviourState state{};
        state.does = gpu::DOES_STAY;
        state.then = gpu::NO_INDEX;
        state.pace = 1.0f;
        state.activity = gpu::ACTIVITY_STAND;
        state.lasts.mean = gpu::DWELL_WHILE;
        state.first_rule = static_cast<std::uint32_t>(scene.behaviours.rules.size());
        state.rule_count = static_cast<std::uint32_t>(conditions.size());
        for (gpu::BehaviourRule rule : conditions) {
            rule.then = gpu::NO_INDEX;
            scene.behaviours.rules.push_back(rule);
        }
        scene.behaviours.states.push_back(state);
    }

    /// After all others: the state that all rules lead to.
    void close() {
        const auto last = static_cast<std::uint32_t>(scene.behaviours.states.size());
        for (const gpu::BehaviourState& state : scene.behaviours.states)
            scene.behaviours.rules[state.first_rule + state.rule_count - 1].then = last;
        addState({});
        for (std::uint32_t row = 0; row < rows(); ++row)
            scene.behaviours.minds[row].state = row % last;
    }

    authoring::Scene scene;
};

gpu::BehaviourRule rule(std::uint32_t condition, float number = 0.0f) {
    gpu::BehaviourRule result{};
    result.condition = condition;
    result.number = number;
    return result;
}

/// @param first of the four corners
bool inside(const std::vector<glm::vec2>& polygon, glm::vec2 point, std::size_t first = 0) {
    bool odd = false;
    for (std::size_t i = 0, j = 3; i < 4; j = i++) {
        const glm::vec2 a = polygon[first + i], b = polygon[first + j];
        if ((a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x)
            odd = !odd;
    }
    return odd;
}

float outside(const std::vector<glm::vec2>& polygon, glm::vec2 point) {
    if (inside(polygon, point)) return 0.0f;
    float least = 1e9f;
    for (std::size_t i = 0, j = 3; i < 4; j = i++) {
        const glm::vec2 axis = polygon[i] - polygon[j];
        const float along = std::clamp(glm::dot(point - polygon[j], axis) / glm::dot(axis, axis), 0.0f, 1.0f);
        least = std::min(least, glm::distance(point, polygon[j] + along * axis));
    }
    return least;
}

std::uint32_t near(const Crowd& crowd, std::uint32_t self, float reach, std::uint32_t first,
                   std::uint32_t count) {
    std::uint32_t found = 0;
    for (std::uint32_t row = first; row < first + count; ++row)
        found += row != self && glm::distance(crowd.place(row), crowd.place(self)) <= reach;
    return found;
}

/// The rule in plain C++. @param number of the rule; @param now s; @param step in s
bool holds(const Crowd& crowd, std::uint32_t number, std::uint32_t row, const gpu::Parameters& parameters) {
    const gpu::BehaviourRule& rule = crowd.scene.behaviours.rules[number];
    const gpu::Mind& mind = crowd.scene.behaviours.minds[row];
    const auto& points = crowd.scene.behaviours.points;
    const auto counted = [&](bool only_inside, std::uint32_t self) {
        const gpu::Census& census = crowd.scene.behaviours.censuses[rule.subject];
        std::uint32_t count = 0;
        for (std::uint32_t each = census.first_row; each < census.first_row + census.row_count; ++each)
            count += each != self && (!only_inside || inside(points, crowd.place(each), census.first_corner));
        return count;
    };
    switch (rule.condition) {
        case gpu::IF_AFTER: {
            const float drawn =
                unitOf(parameters.seed ^ (kPurposeTime + number * 256), row, 2 * mind.entered);
            const float time =
                rule.time.kind == 0 ? rule.time.mean : glm::mix(rule.time.minimum, rule.time.maximum, drawn);
            return static_cast<float>(1u - mind.since) * parameters.step_seconds >= time;
        }
        case gpu::IF_AT:
            return 0.0f >= rule.time.mean;
        case gpu::IF_NEAR_PLACE:
            return outside(points, crowd.place(row)) <= rule.number;
        case gpu::IF_NEAR_PEOPLE:
            return near(crowd, row, rule.number, rule.first, rule.count) > 0;
        case gpu::IF_CROWDED:
            return static_cast<double>(near(crowd, row, 2.0f, 0, crowd.rows()) + 1) >
                   static_cast<double>(rule.number) * std::numbers::pi * 4.0;
        case gpu::IF_CHANCE:
            return unitOf(parameters.seed ^ (kPurposeChance + number * 256), row, 1) <
                   1.0f - std::pow(1.0f - rule.number, parameters.decision_seconds);
        case gpu::IF_EMPTY:
            return counted(true, row) == 0;
        case gpu::IF_ALL_HERE:
            return counted(true, gpu::NO_INDEX) == counted(false, gpu::NO_INDEX);
        case gpu::IF_OPEN:
            return rule.subject == 0;  // it has moved once by now
        case gpu::IF_CLOSED:
            return rule.subject != 0;
        case gpu::IF_GREEN:
        case gpu::IF_RED: {  // at time 0
            const glm::vec2 green = points[rule.first];
            const bool is_green = rule.time.mean >= green.x && rule.time.mean < green.y;
            return is_green == (rule.condition == gpu::IF_GREEN);
        }
        default:
            return false;
    }
}

class BehaviourTest : public GpuTest, public ::testing::WithParamInterface<std::uint32_t> {};

/// A row whose state ends when nobody else of a census is inside: it alone is counted there.
constexpr std::uint32_t kAlone = 18;

/// Every condition, true for some and false for others.
Crowd crowdOfAllConditions(std::uint32_t count) {
    Crowd crowd(count);
    gpu::BehaviourRule after = rule(gpu::IF_AFTER), drawn = after, at = rule(gpu::IF_AT), later = at;
    after.time.mean = 1.0f;
    drawn.time = {1, 0.0f, 0.0f, 0.0f, 2.0f};
    later.time.mean = 5.0f;
    gpu::BehaviourRule place = rule(gpu::IF_NEAR_PLACE, 1.5f);
    place.count = 4;
    gpu::BehaviourRule people = rule(gpu::IF_NEAR_PEOPLE, 1.7f);
    people.count = (count + 7) / 8;
    crowd.scene.behaviours.censuses = {
        {0, 4, 0, count}, {0, 4, 0, 1}, {0, 4, count / 2, 1}, {0, 4, count, 0}, {5, 4, kAlone, 1}};
    std::vector<gpu::BehaviourRule> counts;
    for (std::uint32_t census = 0; census < 5; ++census)
        for (const std::uint32_t condition : {gpu::IF_EMPTY, gpu::IF_ALL_HERE}) {
            counts.push_back(rule(condition));
            counts.back().subject = census;
        }
    gpu::BehaviourRule open = rule(gpu::IF_OPEN), closed = rule(gpu::IF_CLOSED);
    open.first = closed.first = 4;
    open.count = closed.count = 1;
    crowd.scene.behaviours.points.emplace_back(-1.0f, 0.0f);
    for (const glm::vec2 corner : {glm::vec2(-99, -99), {999, -99}, {999, 999}, {-99, 999}})
        crowd.scene.behaviours.points.push_back(corner);
    gpu::BehaviourRule green = rule(gpu::IF_GREEN, 10.0f);  // s of the cycle
    green.first = 9;
    green.count = 1;
    green.time.mean = 4.0f;
    gpu::BehaviourRule not_yet = green, red = green;
    not_yet.time.mean = 2.9f;
    red.condition = gpu::IF_RED;
    crowd.scene.behaviours.points.emplace_back(3.0f, 5.0f);
    for (const gpu::BehaviourRule& each : {green, not_yet, red})
        crowd.addState({each});
    for (const gpu::BehaviourRule& each :
         {after, drawn, at, later, place, people, rule(gpu::IF_CROWDED, 1.2f),
          rule(gpu::IF_CHANCE, 0.999999f), open, closed})
        crowd.addState({each});
    for (const gpu::BehaviourRule& each : counts)
        crowd.addState({each});
    crowd.addState({drawn, place});
    crowd.close();
    return crowd;
}

TEST_P(BehaviourTest, ConditionsAreThoseOfPlainCpp) {
    const Crowd crowd = crowdOfAllConditions(GetParam());
    const authoring::Behaviours& tables = crowd.scene.behaviours;
    sim::Simulation simulation(crowd.scene, library);
    simulation.step();
    const auto minds = simulation.parts().buffers.minds.download<gpu::Mind>(crowd.rows());
    const auto last = static_cast<std::uint32_t>(tables.states.size()) - 1;
    std::uint32_t changed = 0;
    for (std::uint32_t row = 0; row < crowd.rows(); ++row) {
        const std::uint32_t before = tables.minds[row].state;
        const gpu::BehaviourState& state = tables.states[before];
        bool ends = true;
        for (std::uint32_t i = 0; i < state.rule_count; ++i)
            ends = ends && holds(crowd, state.first_rule + i, row, simulation.parameters());
        ASSERT_EQ(minds[row].state, ends ? last : before) << "row " << row << ", state " << before;
        ASSERT_EQ(minds[row].entered, ends ? 2u : 1u);
        changed += ends;
    }
    if (GetParam() > 1) {
        EXPECT_GT(changed, crowd.rows() / 5);
        EXPECT_LT(changed, 4 * crowd.rows() / 5);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, BehaviourTest, ::testing::Values(1u, 63u, 1'234u));

TEST_P(BehaviourTest, GoesOnFromASavedState) {
    const Crowd crowd = crowdOfAllConditions(GetParam());
    sim::Simulation whole(crowd.scene, library), second(crowd.scene, library);
    const auto run = [](sim::Simulation& simulation, int steps) {
        for (int step = 0; step < steps; ++step)
            simulation.step();
    };
    run(whole, 24);
    const sim::Simulation::State saved = whole.save();
    run(whole, 24);
    second.restore(saved);
    run(second, 24);
    const auto parts = whole.save().parts, again = second.save().parts;
    ASSERT_EQ(parts.size(), again.size());
    for (std::size_t i = 0; i < parts.size(); ++i)
        EXPECT_TRUE(parts[i].second == again[i].second) << parts[i].first;
}

class BehaviourOfOne : public GpuTest {
  protected:
    /// One person at the origin, whose first state does this.
    static authoring::Scene one(std::uint32_t does) {
        authoring::Scene scene = emptyScene({-30, -30}, {30, 30});
        addPerson(scene, {0, 0}, {1, 0});
        scene.stages.push_back(scene.stages.front());
        scene.people[0].stage_count = 2;
        gpu::BehaviourState state{};
        state.does = does;
        state.pace = 1.0f;
        state.then = gpu::NO_INDEX;
        state.activity = gpu::ACTIVITY_STAND;
        state.lasts.mean = gpu::DWELL_WHILE;
        state.most = state.least = 1;
        scene.behaviours.states = {state};
        gpu::Mind mind{};
        mind.place = mind.followed = gpu::NO_INDEX;
        scene.behaviours.minds = {mind};
        return scene;
    }
    static gpu::AgentState after(sim::Simulation& simulation, float seconds, std::size_t row = 0) {
        const auto steps = static_cast<int>(seconds / simulation.parameters().step_seconds);
        for (int step = 0; step < steps; ++step)
            simulation.step();
        return simulation.parts().buffers.states.download<gpu::AgentState>(row + 1).back();
    }
};

TEST_F(BehaviourOfOne, WhoStaysStands) {
    sim::Simulation simulation(one(gpu::DOES_STAY), library);
    const gpu::AgentState state = after(simulation, 3.0f);
    EXPECT_LT(glm::length(state.position), 0.05f);
    EXPECT_NE(state.leave_step, 0u);
    EXPECT_EQ(state.status, gpu::STATUS_WALKING) << "it may still be told to go on";
}

TEST_F(BehaviourOfOne, WhoStaysForGoodHasArrived) {
    authoring::Scene scene = one(gpu::DOES_STAY);
    scene.behaviours.states[0].lasts.mean = gpu::DWELL_FOR_GOOD;
    sim::Simulation simulation(scene, library);
    EXPECT_EQ(after(simulation, 3.0f).status, gpu::STATUS_ARRIVED);
}

TEST_F(BehaviourOfOne, WhoFleesGoesRoundAWallUntilItIsSafe) {
    authoring::Scene scene = one(gpu::DOES_FLEE);
    scene.behaviours.states[0].from = {-1, 0};
    scene.behaviours.states[0].distance = 9.0f;
    addWall(scene, {2, -1.5f}, {2, 1.5f}, 0.1f);
    sim::Simulation simulation(scene, library);
    const gpu::AgentState fled = after(simulation, 15.0f);
    EXPECT_GE(glm::distance(fled.position, {-1, 0}), 8.6f);
    const gpu::AgentState later = after(simulation, 3.0f);
    EXPECT_LT(glm::distance(later.position, fled.position), 0.3f) << "who is safe stands";
}

TEST_F(BehaviourOfOne, WhoFollowsStaysBehind) {
    authoring::Scene scene = one(gpu::DOES_FOLLOW);
    addPerson(scene, {4, 0}, {20, 8}, 1.0f);
    gpu::BehaviourState& state = scene.behaviours.states[0];
    state.first_row = 1;
    state.row_count = 1;
    state.distance = 2.0f;
    sim::Simulation simulation(scene, library);
    after(simulation, 8.0f);
    const auto both = simulation.parts().buffers.states.download<gpu::AgentState>(2);
    const float apart = glm::distance(both[0].position, both[1].position);
    EXPECT_GT(glm::length(both[0].position), 3.0f);
    EXPECT_GT(apart, 1.2f);
    EXPECT_LT(apart, 3.6f);
    after(simulation, 25.0f);
    const auto in_the_end = simulation.parts().buffers.states.download<gpu::AgentState>(2);
    EXPECT_NEAR(glm::distance(in_the_end[0].position, in_the_end[1].position), 2.0f, 0.7f);
}

TEST_F(BehaviourOfOne, WandersOnlyWhereTheWayIsClear) {
    authoring::Scene scene = one(gpu::DOES_WANDER);
    addWall(scene, {-8, 2}, {8, 2}, 0.1f);
    gpu::BehaviourPlace place{};
    place.field = 0;
    place.corner_count = 4;
    place.first_point = 4;
    scene.behaviours.points = {{-10, -5}, {10, -5}, {10, 8}, {-10, 8}};
    for (int i = 0; i < 64; ++i)
        scene.behaviours.points.emplace_back(-9.0f + 18.0f * static_cast<float>(i % 8) / 7.0f,
                                             -4.0f + 11.0f * static_cast<float>(i / 8) / 7.0f);
    place.point_count = 64;
    scene.behaviours.places = {place};
    scene.behaviours.states[0].place_count = 1;
    scene.behaviours.states[0].lasts.mean = 0.0f;
    // A field without any way: all of it is where it leads.
    scene.grid = {{-30, -30}, 10.0f, 6, 6};
    scene.fields.fields = {std::make_shared<const std::vector<gpu::FieldCell>>(36, gpu::FieldCell{-0.0f, 0})};
    scene.fields.cells_per_field = 36;
    scene.field_count = 1;
    sim::Simulation simulation(scene, library);
    const auto& stages = simulation.parts().buffers.stages;
    int goals = 0;
    glm::vec2 before(1e9f);
    for (int step = 0; step < 48 * 60; ++step) {
        simulation.step();
        const glm::vec2 goal = stages.download<gpu::Stage>(1).front().point;
        const glm::vec2 place_now =
            simulation.parts().buffers.states.download<gpu::AgentState>(1)[0].position;
        if (goal != before) {
            ++goals;
            const bool across = (goal.y > 2.0f) != (place_now.y > 2.0f);
            const bool past_the_end = std::abs(goal.x) > 8.0f || std::abs(place_now.x) > 8.0f;
            ASSERT_TRUE(!across || past_the_end) << goal.x << ", " << goal.y;
        }
        before = goal;
    }
    EXPECT_GT(goals, 5);
}

}  // namespace
}  // namespace throng::test
