// SPDX-License-Identifier: Apache-2.0
// A round of contact between bodies that are no discs, against the same in plain C++, which is told nothing
// by the shader: where two capsules are nearest to each other is found among the ends of their segments.
#include <array>
#include <glm/vec4.hpp>
#include <map>
#include <numbers>
#include <random>

#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

using Vector = glm::dvec2;

double cross(Vector a, Vector b) {
    return a.x * b.y - a.y * b.x;
}

/// Somebody in a round of contact.
struct Walking {
    Vector place, axis;  // of the body's segment: from its middle to an end
    double radius = 0.0;
    double thickness = 0.0;
    Vector axis_at_start{0.0};

    double inertia(double factor) const { return factor * (radius * radius + thickness * thickness) / 4.0; }
};

/// Where two segments are nearest to each other, each from its own middle.
struct Meeting {
    Vector on_a{0.0}, on_b{0.0};
    bool crossed = false;
};

Vector nearestTo(Vector point, Vector axis) {
    const double squared = glm::dot(axis, axis);
    return squared > 0.0 ? std::clamp(glm::dot(point, axis) / squared, -1.0, 1.0) * axis : Vector(0.0);
}

bool areParallel(Vector a, Vector b) {
    return glm::length(a) > 0.0 && glm::length(b) > 0.0 &&
           std::abs(cross(a, b)) < 1.0e-5 * glm::length(a) * glm::length(b);
}

bool segmentsCross(Vector offset, Vector a, Vector b) {
    const double turn = cross(a, b);
    if (areParallel(a, b) || turn == 0.0) return false;
    return std::abs(cross(-offset, b) / turn) <= 1.0 && std::abs(cross(-offset, a) / turn) <= 1.0;
}

/// Bodies abreast touch in the middle of the stretch along which they are.
Meeting meetingAbreast(Vector offset, Vector a, Vector b) {
    const double length = glm::length(a);
    const Vector along = a / length;
    const double middle = glm::dot(-offset, along), half = std::abs(glm::dot(b, along));
    const double low = std::max(-length, middle - half), high = std::min(length, middle + half);
    const double at = low <= high ? 0.5 * (low + high) : (middle > 0.0 ? length : -length);
    return {at * along, nearestTo(offset + at * along, b)};
}

/// @param offset from the middle of `b` to that of `a`
Meeting meetingOf(Vector offset, Vector a, Vector b) {
    if (segmentsCross(offset, a, b)) return {{}, {}, true};
    if (areParallel(a, b)) return meetingAbreast(offset, a, b);
    const std::array candidates = {
        Meeting{a, nearestTo(offset + a, b)}, Meeting{-a, nearestTo(offset - a, b)},
        Meeting{nearestTo(b - offset, a), b}, Meeting{nearestTo(-b - offset, a), -b}};
    const auto apart = [&](const Meeting& at) { return glm::length(offset + at.on_a - at.on_b); };
    return *std::min_element(
        candidates.begin(), candidates.end(),
        [&](const Meeting& one, const Meeting& other) { return apart(one) < apart(other); });
}

/// What the layout says of contact.
struct Rules {
    explicit Rules(const authoring::Scene& scene, double step_seconds)
        : skin(scene.settings.motion.number("contact", "skin")),
          most_push(scene.settings.motion.number("contact", "most_push")),
          relaxation(scene.settings.motion.number("contact", "relaxation")),
          inertia(scene.settings.motion.number("shoulders", "inertia")),
          most_turn(scene.settings.motion.number("shoulders", "fastest") * step_seconds) {}
    double skin, most_push, relaxation, inertia, most_turn;
};

struct Push {
    Vector way{0.0};
    double turn = 0.0;
    int count = 0;
};

void addPush(const Walking& self, const Walking& other, const Rules& rules, Push& push) {
    const Vector offset = self.place - other.place;
    const Meeting at = meetingOf(offset, self.axis, other.axis);
    const double reach = self.thickness + other.thickness + rules.skin;
    Vector gap = offset + at.on_a - at.on_b;
    double depth = reach - glm::length(gap);
    if (at.crossed) {
        gap = offset;
        const Vector way = glm::normalize(offset);
        depth = reach + std::abs(glm::dot(self.axis, way)) + std::abs(glm::dot(other.axis, way)) -
                glm::length(offset);
    }
    if (depth <= 0.0) return;
    const Vector apart = glm::normalize(gap);
    const double arm = cross(at.on_a, apart), its_arm = cross(at.on_b, apart);
    const double yields = 1.0 + arm * arm / self.inertia(rules.inertia);
    const double its_yields = 1.0 + its_arm * its_arm / other.inertia(rules.inertia);
    const double impulse = depth / (yields + its_yields);
    push.way += impulse * apart;
    push.turn += impulse * arm / self.inertia(rules.inertia);
    ++push.count;
}

Vector turned(Vector axis, double angle) {
    return axis * std::cos(angle) + Vector(-axis.y, axis.x) * std::sin(angle);
}

/// Everybody after a round.
std::vector<Walking> afterARound(const std::vector<Walking>& people, const Rules& rules) {
    std::vector<Walking> result = people;
    for (std::size_t i = 0; i < people.size(); ++i) {
        Push push;
        for (std::size_t j = 0; j < people.size(); ++j)
            if (j != i) addPush(people[i], people[j], rules, push);
        if (push.count == 0) continue;
        const double share = push.count > 1 ? rules.relaxation / push.count : 1.0;
        Vector way = push.way * share;
        const double most = rules.most_push * people[i].radius;
        if (glm::length(way) > most) way *= most / glm::length(way);
        result[i].place += way;
        const Vector start = people[i].axis_at_start;
        const Vector after = turned(people[i].axis, push.turn * share);
        const double angle = std::atan2(cross(start, after), glm::dot(start, after));
        result[i].axis = turned(start, std::clamp(angle, -rules.most_turn, rules.most_turn));
    }
    return result;
}

class BodyContactTest : public GpuTest {
  protected:
    /// Discs, people, and prams: chests in steps of 15 degrees, so that many are abreast.
    static authoring::Scene crowd(std::uint32_t count, float spacing = 0.42f) {
        authoring::Scene scene = uniformScene(count, spacing, count);
        std::mt19937 random(count);
        std::uniform_real_distribution<float> size(0.8f, 1.2f);
        for (gpu::Person& person : scene.people) {
            constexpr float kStep = std::numbers::pi_v<float> / 12.0f;
            const std::uint32_t kind = count == 1 ? 1 : random() % 8;
            person.radius = 0.24f * size(random);
            person.half_axis = kind == 0 ? 0.0f : 0.45f * person.radius;
            if (kind == 7) person.half_axis *= -1.0f;
            person.heading = kStep * static_cast<float>(random() % 24);
        }
        scene.largest_radius = 0.3f;
        setRule(scene, "standing_fast", "rounds", 0.0);  // all weigh alike
        return scene;
    }
    /// Everybody where the scene has it, by slots.
    static std::vector<Walking> peopleOf(sim::Simulation::Parts& parts, const authoring::Scene& scene) {
        std::vector<Walking> people;
        for (const gpu::Body& body : parts.buffers.bodies.download<gpu::Body>(scene.people.size())) {
            const gpu::Person& person = scene.people[body.row];
            const Vector facing(std::cos(double{person.heading}), std::sin(double{person.heading}));
            const double half = person.half_axis;
            const Vector axis = half >= 0.0 ? half * Vector(-facing.y, facing.x) : -half * facing;
            people.push_back({body.position, axis, person.radius, person.radius - std::abs(half), axis});
        }
        return people;
    }
    static std::vector<glm::vec4> targetsOf(const std::vector<Walking>& people) {
        std::vector<glm::vec4> targets;
        for (const Walking& each : people)
            targets.emplace_back(each.place.x, each.place.y, each.axis.x, each.axis.y);
        return targets;
    }
    /// Senses everybody where the scene has it.
    static void setOut(sim::Simulation& simulation, const authoring::Scene& scene) {
        sim::Simulation::Parts& parts = simulation.parts();
        simulation.step();  // what contact reads besides, such as wishes
        parts.buffers.states.upload(statesOf(scene));
        parts.buffers.chests.upload(chestsOf(scene));
        parts.cells.run();
        parts.lookRound();
    }
    /// How far apart some rounds end, the first of which notes who is near for the others, and as many first
    /// rounds, m. @param pushed receives how far they push anybody
    double apartAfterRounds(std::uint32_t count, float spacing, int rounds, double& pushed) {
        authoring::Scene scene = crowd(count, spacing);
        setRule(scene, "contact_momentum", "enabled", 0.0);  // no round knows of those before
        sim::Simulation simulation(scene, library);
        sim::Simulation::Parts& parts = simulation.parts();
        setOut(simulation, scene);
        std::vector<glm::vec4> start = targetsOf(peopleOf(parts, scene)), one_by_one = start;
        const auto after = [&](const std::vector<glm::vec4>& targets, int iterations) {
            parts.buffers.targets.upload(targets);
            parts.buffers.targets_after.upload(targets);
            sim::Contacts contacts(library, parts.buffers, iterations, parts.settings.motion);
            contacts.run();
            return contacts.result().download<glm::vec4>(targets.size());
        };
        for (int round = 0; round < rounds; ++round)
            one_by_one = after(one_by_one, 1);
        const std::vector<glm::vec4> at_once = after(start, rounds);
        double worst = 0.0;
        for (std::size_t i = 0; i < start.size(); ++i) {
            worst = std::max(worst, double{glm::distance(at_once[i], one_by_one[i])});
            pushed = std::max(pushed, double{glm::distance(at_once[i], start[i])});
        }
        return worst;
    }
    struct Outcome {
        std::size_t pushed = 0, turned = 0;
        double worst = 0.0;  // m, of places and of the ends of segments
    };
    /// After a round on the device, and one in C++. In a second one some would be nearly abreast, where the
    /// shader goes smoothly from one kind of contact to the other, which the reference knows nothing of.
    Outcome compare(std::uint32_t count) {
        const authoring::Scene scene = crowd(count);
        sim::Simulation simulation(scene, library);
        sim::Simulation::Parts& parts = simulation.parts();
        setOut(simulation, scene);
        std::vector<Walking> people = peopleOf(parts, scene);
        const std::vector<Walking> before = people;
        const std::vector<glm::vec4> targets = targetsOf(people);
        parts.buffers.targets.upload(targets);
        parts.buffers.targets_after.upload(targets);
        sim::Contacts contacts(library, parts.buffers, 1, parts.settings.motion);
        contacts.run();
        const Rules rules(scene, parts.parameters.step_seconds);
        people = afterARound(people, rules);
        Outcome outcome;
        const auto found = contacts.result().download<glm::vec4>(people.size());
        for (std::size_t i = 0; i < people.size(); ++i) {
            const Vector place(found[i].x, found[i].y), axis(found[i].z, found[i].w);
            outcome.worst = std::max(
                {outcome.worst, glm::distance(place, people[i].place), glm::distance(axis, people[i].axis)});
            outcome.pushed += glm::distance(people[i].place, before[i].place) > 1.0e-3;
            outcome.turned += glm::distance(people[i].axis, before[i].axis) > 1.0e-3;
        }
        return outcome;
    }

  private:
    static std::vector<gpu::AgentState> statesOf(const authoring::Scene& scene) {
        std::vector<gpu::AgentState> states;
        for (const gpu::Person& person : scene.people) {
            gpu::AgentState state{};
            state.position = person.spawn_position;
            state.heading = person.heading;
            state.status = gpu::STATUS_WALKING;
            states.push_back(state);
        }
        return states;
    }
    static std::vector<gpu::Chest> chestsOf(const authoring::Scene& scene) {
        std::vector<gpu::Chest> chests;
        for (const gpu::Person& person : scene.people)
            chests.push_back({person.heading, 0.0f, person.half_axis, 0});
        return chests;
    }
};

constexpr double kRounding = 2.0e-6;  // m, of what is some metres away

TEST_F(BodyContactTest, WhoIsAloneStaysWhereItIs) {
    const Outcome outcome = compare(1);
    EXPECT_LT(outcome.worst, kRounding);
    EXPECT_EQ(outcome.pushed + outcome.turned, 0u);
}

TEST_F(BodyContactTest, PushesAndTurnsAsTheReferenceDoes) {
    for (const std::uint32_t count : {63u, 1234u}) {
        const Outcome outcome = compare(count);
        EXPECT_LT(outcome.worst, kRounding) << count << " people";
        EXPECT_GT(outcome.pushed, count / 2) << "or nothing was seen";
        EXPECT_GT(outcome.turned, count / 4) << "or nothing was seen";
    }
}

TEST_F(BodyContactTest, RoundsOfThoseNearAreRoundsOfAll) {
    constexpr double kSeveralRoundings = 2.0e-4;  // m: two programs of the same text round differently
    for (const std::uint32_t count : {1u, 63u, 1234u}) {
        double pushed = 0.0;
        EXPECT_LT(apartAfterRounds(count, 0.42f, 4, pushed), kSeveralRoundings) << count << " people";
        EXPECT_TRUE(count == 1 || pushed > 0.02) << "or nothing was seen";
    }
}

TEST_F(BodyContactTest, RoundsInACrushBeyondTheListsAreRoundsOfAll) {
    double pushed = 0.0;
    EXPECT_LT(apartAfterRounds(200, 0.12f, 2, pushed), 2.0e-4);
    EXPECT_GT(pushed, 0.05) << "or nothing was seen";
}

}  // namespace
}  // namespace throng::test
