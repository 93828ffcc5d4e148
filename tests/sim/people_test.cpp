// SPDX-License-Identifier: Apache-2.0
// People with company, stops, lines, gates and changing plans: layouts with known outcomes.
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/scene_builder.h"
#include "sim/simulation.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/observe.h"

namespace throng::test {
namespace {

using States = std::vector<gpu::AgentState>;

class PeopleTest : public GpuTest {
  protected:
    authoring::Scene sceneOf(const std::string& text) {
        authoring::Diagnostics diagnostics;
        const auto layout = authoring::readLayout(text, {}, diagnostics);
        std::optional<authoring::Scene> scene;
        if (layout) scene = authoring::buildScene(*layout, diagnostics);
        for (const authoring::Diagnostic& entry : diagnostics.entries)
            ADD_FAILURE() << entry.message;
        return scene.value_or(authoring::Scene{});
    }

    /// Calls look(seconds, states) after every quarter of a second.
    void watch(const authoring::Scene& scene, float seconds,
               const std::function<void(float, const States&)>& look) {
        sim::Simulation simulation(scene, library);
        const float dt = simulation.parameters().step_seconds;
        const int stride = static_cast<int>(std::lround(0.25f / dt));
        for (int step = 1; static_cast<float>(step) * dt <= seconds; ++step) {
            simulation.step();
            if (step % stride == 0)
                look(static_cast<float>(step) * dt,
                     simulation.parts().buffers.states.download<gpu::AgentState>(scene.people.size()));
        }
    }

    static glm::dvec2 world(const authoring::Scene& scene, const gpu::AgentState& state) {
        return scene.origin + glm::dvec2(state.position);
    }
};

const std::string kStreet = R"({"throng": 1, "simulation": {"duration": 120},
 "areas": [{"id": "a", "polygon": [[0,-3],[4,-3],[4,3],[0,3]]},
           {"id": "shop", "polygon": [[18,-3],[24,-3],[24,3],[18,3]]},
           {"id": "b", "polygon": [[40,-3],[44,-3],[44,3],[40,3]]}],
)";

TEST_F(PeopleTest, StopForAsLongAsTheyAreToldAndLookWhereTheyAreTold) {
    const authoring::Scene scene =
        sceneOf(kStreet + R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 8, "end": 4,
 "via": [{"at": "shop", "wait": 6, "activity": "look", "facing": [21, 30]}]}]})");
    std::map<std::size_t, float> came, went;
    float worst_look = 0.0f;
    std::size_t gone = 0;
    watch(scene, 75.0f, [&](float now, const States& states) {
        gone = 0;
        for (std::size_t row = 0; row < states.size(); ++row) {
            const gpu::AgentState& state = states[row];
            gone += state.status == gpu::STATUS_GONE;
            if (state.leave_step == 0) {
                if (came.count(row) && !went.count(row)) went[row] = now;
                continue;
            }
            came.try_emplace(row, now);
            EXPECT_LT(glm::length(state.velocity), 0.15f) << "m/s: who stops has come to rest";
            const glm::dvec2 at = world(scene, state);
            EXPECT_GT(at.x, 17.5);
            EXPECT_LT(at.x, 24.5);
            if (now - came[row] < 3.0f) continue;
            const auto wanted = static_cast<float>(std::atan2(30.0 - at.y, 21.0 - at.x));
            worst_look = std::max(worst_look, std::abs(std::remainder(state.heading - wanted, 6.2831853f)));
        }
    });
    EXPECT_EQ(gone, 8u);
    ASSERT_EQ(went.size(), 8u);
    for (const auto& [row, time] : went)
        EXPECT_NEAR(time - came[row], 6.0f, 0.3f);
    EXPECT_LT(worst_look, 0.2f) << "rad";
}

TEST_F(PeopleTest, StandApartAtAStopTheyShare) {
    const authoring::Scene scene = sceneOf(
        kStreet +
        R"("flows": [{"id": "f", "from": "a", "to": "shop", "arrival": "stay", "count": 16, "end": 8}]})");
    States last;
    watch(scene, 50.0f, [&](float, const States& states) { last = states; });
    std::size_t close = 0;
    for (std::size_t i = 0; i < last.size(); ++i) {
        EXPECT_EQ(last[i].status, gpu::STATUS_ARRIVED);
        EXPECT_LT(glm::length(last[i].velocity), 0.1f);
        for (std::size_t j = 0; j < i; ++j) {
            const float apart = glm::distance(last[i].position, last[j].position);
            EXPECT_GT(apart, scene.people[i].radius + scene.people[j].radius);
            close += apart < 0.7f;
        }
    }
    EXPECT_LE(close, 2u) << "pairs: whoever has given up on its own place stands where it is";
}

TEST_F(PeopleTest, QueueInTheOrderTheyComeAndAreServedOneAfterTheOther) {
    const authoring::Scene scene =
        sceneOf(kStreet + R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 9, "end": 6,
 "via": [{"at": "shop", "wait": 4, "activity": "queue", "line": [[23, 2], [19, 2], [19, -2.5]], "spacing": 0.9}]}]})");
    std::map<std::uint32_t, float> joined, served;  // when, by ticket
    std::size_t longest = 0, gone = 0;
    double worst_place = 0.0;
    watch(scene, 100.0f, [&](float now, const States& states) {
        std::map<std::uint32_t, gpu::AgentState> line;
        gone = 0;
        for (const gpu::AgentState& state : states) {
            gone += state.status == gpu::STATUS_GONE;
            if (state.ticket != gpu::NO_INDEX) line[state.ticket] = state;
        }
        longest = std::max(longest, line.size());
        std::size_t place = 0;
        for (const auto& [ticket, state] : line) {
            joined.try_emplace(ticket, now);
            if (state.leave_step != 0) {
                EXPECT_EQ(place, 0u) << "somebody jumped the queue";
                served.try_emplace(ticket, now);
            }
            const double along = 0.9 * static_cast<double>(place++);
            const glm::dvec2 wanted =
                along <= 4.0 ? glm::dvec2(23.0 - along, 2.0) : glm::dvec2(19.0, 6.0 - along);
            // Once everybody has had time to move up.
            const auto& first = *line.begin();
            const bool settled = first.second.leave_step != 0 && now - served[first.first] > 2.5f;
            if (settled && now - joined[ticket] > 4.0f)
                worst_place = std::max(worst_place, glm::distance(world(scene, state), wanted));
        }
    });
    EXPECT_EQ(gone, 9u);
    EXPECT_GE(longest, 5u);
    EXPECT_LT(worst_place, 0.35) << "m";
    ASSERT_EQ(served.size(), 9u);
    for (std::uint32_t ticket = 1; ticket < 9; ++ticket)
        EXPECT_GT(served[ticket] - served[ticket - 1], 3.9f);
}

/// Where in a line somebody is to stand, worked out plainly, and how far round that will do.
std::pair<glm::dvec2, double> placeByHand(std::vector<glm::dvec2> line, double spacing, std::uint32_t nth) {
    double left = nth * spacing;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const double piece = glm::distance(line[i], line[i + 1]);
        if (left <= piece) return {line[i] + (line[i + 1] - line[i]) * (left / piece), 0.0};
        left -= piece;
    }
    return {line.back(), spacing * std::sqrt(left / spacing)};
}

TEST_F(PeopleTest, WhoFindsNoPlaceInALineStandsRoundItsEndWithFeetStill) {
    for (const std::string seed : {"1", "7", "20"}) {
        std::string text = kStreet;
        text.replace(text.find("120"), 3, "120, \"seed\": " + seed);
        const authoring::Scene scene =
            sceneOf(text + R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 16, "end": 12,
 "via": [{"at": "shop", "wait": 500, "activity": "queue", "line": [[23, 2], [21, 2], [21, 0.2]], "spacing": 0.7}]}]})");
        const glm::dvec2 end(21.0, 0.2);
        std::size_t waiting = 0, round_the_end = 0, kept_off = 0;
        watch(scene, 60.0f, [&](float now, const States& states) {
            if (now < 50.0f) return;
            waiting = round_the_end = kept_off = 0;
            for (const gpu::AgentState& state : states) {
                if (state.ticket == gpu::NO_INDEX) continue;
                ++waiting;
                const auto [place, reach] = placeByHand({{23, 2}, {21, 2}, end}, 0.7, state.ticket);
                const glm::dvec2 at = world(scene, state);
                kept_off += glm::distance(at, place) >= reach + 0.35;
                EXPECT_LT(glm::distance(at, place), reach + 0.6) << state.ticket;
                EXPECT_LT(glm::length(state.velocity), 0.05f) << state.ticket;
                if (reach == 0.0) continue;
                ++round_the_end;
                const glm::dvec2 facing(std::cos(state.heading), std::sin(state.heading));
                const glm::dvec2 before = placeByHand({{23, 2}, {21, 2}, end}, 0.7, state.ticket - 1).first;
                const double looks = glm::dot(facing, glm::normalize(before - at));
                EXPECT_TRUE(looks > 0.9 || glm::distance(at, before) < 0.3) << state.ticket << ": " << looks;
            }
        });
        EXPECT_EQ(waiting, 16u);
        EXPECT_EQ(round_the_end, 10u);
        EXPECT_LE(kept_off, 1u) << "by others who stand there";
    }
}

/// Somebody who stops in the shop, and perhaps somebody else.
class AtRestTest : public PeopleTest {
  protected:
    struct Other {
        float nervousness = 0.0f;
        float goes_to = 1.0f;  // 1: through the one who stands, -1: away
    };
    /// m/s: of who stands, a step after a push gave it a velocity towards the east.
    float velocityAfter(float push, std::optional<Other> other) {
        authoring::Scene scene =
            sceneOf(kStreet + R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 2, "end": 0.01,
 "people": {"radius": 0.25}, "via": [{"at": "shop", "wait": 60, "facing": [21, 9]}]}]})");
        scene.settings.decision_interval = 0.0;
        sim::Simulation simulation(scene, library);
        for (int step = 0; step < 48; ++step)
            simulation.step();
        sim::Buffers& buffers = simulation.parts().buffers;
        States states = buffers.states.download<gpu::AgentState>(2);
        const auto local = [&](double x, double y) { return glm::vec2(glm::dvec2(x, y) - scene.origin); };
        states[0].position = local(21, 0);
        states[0].velocity = {push, 0.0f};
        states[0].leave_step = 1'000'000;
        states[1].position = other ? local(20.45, 0) : local(2, 0);
        states[1].velocity = {0.0f, 0.0f};
        states[1].nervousness = other ? other->nervousness : 0.0f;
        if (other) states[1].stage = states[1].stage_end - 1;  // walks on to b
        if (other && other->goes_to < 0.0f) states[1].position = local(21.55, 0);
        buffers.states.upload(states);
        simulation.step();
        return buffers.states.download<gpu::AgentState>(2)[0].velocity.x;
    }
};

TEST_F(AtRestTest, FeetHoldAgainstASmallPushAndGoAlongWithAHardOne) {
    EXPECT_NEAR(velocityAfter(0.2f, {}), 0.0f, 0.001f);
    EXPECT_GT(velocityAfter(0.8f, {}), 0.7f);
}

TEST_F(AtRestTest, FeetMoveForWhoIsHeldUpAndWantsPast) {
    EXPECT_NEAR(velocityAfter(0.2f, Other{0.1f, 1.0f}), 0.0f, 0.01f) << "not held up";
    EXPECT_GT(velocityAfter(0.2f, Other{0.9f, 1.0f}), 0.15f);
    EXPECT_NEAR(velocityAfter(0.2f, Other{0.9f, -1.0f}), 0.0f, 0.01f) << "is past already";
}

TEST_F(PeopleTest, WhoGivesUpBeforeAFullAreaTriesTheLongerTheFurtherAwayItIs) {
    const auto stops = [&](double x, float nervousness) {
        authoring::Scene scene = sceneOf(
            kStreet + R"("flows": [{"id": "f", "from": "a", "to": "shop", "arrival": "stay", "count": 1}]})");
        scene.stages.front().point = glm::vec2(glm::dvec2(18.3, 0.0) - scene.origin);
        sim::Simulation simulation(scene, library);
        for (int step = 0; step < 600; ++step)
            simulation.step();
        States states = simulation.parts().buffers.states.download<gpu::AgentState>(1);
        states[0].status = gpu::STATUS_WALKING;
        states[0].position = glm::vec2(glm::dvec2(x, 0.0) - scene.origin);
        states[0].velocity = {0.0f, 0.0f};
        states[0].nervousness = nervousness;
        simulation.parts().buffers.states.upload(states);
        simulation.step();
        return simulation.parts().buffers.states.download<gpu::AgentState>(1)[0].status ==
               gpu::STATUS_ARRIVED;
    };
    EXPECT_FALSE(stops(15.3, 0.75f)) << "3 m before its place";
    EXPECT_TRUE(stops(15.3, 0.9f));
    EXPECT_TRUE(stops(17.6, 0.75f)) << "right before it";
    EXPECT_FALSE(stops(17.6, 0.5f));
}

/// With a wall across it, and a gate in the wall.
const std::string kGatedStreet =
    kStreet +
    R"("walls": [{"points": [[30,-20],[30,-1]]}, {"id": "gate", "points": [[30,-1],[30,1]]},
 {"points": [[30,1],[30,20]]}],
)";

TEST_F(PeopleTest, WaitBeforeAClosedGateAndGoThroughOnceItOpens) {
    const authoring::Scene scene =
        sceneOf(kGatedStreet + R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 12, "end": 5}],
 "events": [{"at": 40, "open": "gate"}]})");
    std::size_t gone = 0;
    watch(scene, 75.0f, [&](float now, const States& states) {
        gone = 0;
        for (const gpu::AgentState& state : states) {
            gone += state.status == gpu::STATUS_GONE;
            if (now <= 40.0f && isPresent(state)) {
                EXPECT_LT(world(scene, state).x, 30.0);
            }
        }
    });
    EXPECT_EQ(gone, 12u);
}

TEST_F(PeopleTest, DoNotPassAGateThatHasClosed) {
    const authoring::Scene scene =
        sceneOf(kGatedStreet + R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 30, "end": 30}],
 "events": [{"at": 33, "close": "gate"}]})");
    std::vector<double> before;
    std::size_t passed = 0, kept_back = 0;
    watch(scene, 70.0f, [&](float now, const States& states) {
        passed = kept_back = 0;
        for (std::size_t row = 0; row < states.size(); ++row) {
            const double x = world(scene, states[row]).x;
            const bool beyond = states[row].status == gpu::STATUS_GONE || x > 30.0;
            (beyond ? passed : kept_back)++;
            if (now > 33.3f && before.size() > row && before[row] < 30.0) {
                EXPECT_FALSE(beyond);
            }
            if (before.size() <= row) before.resize(row + 1);
            before[row] = beyond ? 100.0 : x;
        }
    });
    EXPECT_GT(passed, 3u);
    EXPECT_GT(kept_back, 3u);
}

TEST_F(PeopleTest, LeaveWhateverTheyDoWhenAnEventSendsThemAway) {
    const authoring::Scene scene = sceneOf(kStreet + R"("flows": [
 {"id": "sitters", "from": "a", "to": "shop", "arrival": "stay", "count": 8, "end": 4,
  "people": {"reaction": {"uniform": [1, 3]}}},
 {"id": "others", "from": "a", "to": "b", "rate": 0.2, "end": 90}],
 "events": [{"at": 35, "go_to": "a", "who": ["sitters"]}]})");
    std::size_t arrived_before = 0, gone = 0;
    float first_move = 1000.0f, last_move = 0.0f;
    std::vector<bool> moved(8, false);
    watch(scene, 70.0f, [&](float now, const States& states) {
        if (now < 34.9f) arrived_before = 0;
        gone = 0;
        for (std::size_t row = 0; row < 8; ++row) {
            if (now < 34.9f) arrived_before += states[row].status == gpu::STATUS_ARRIVED;
            gone += states[row].status == gpu::STATUS_GONE;
            if (now < 35.0f || moved[row] || states[row].status != gpu::STATUS_WALKING) continue;
            moved[row] = true;
            first_move = std::min(first_move, now);
            last_move = std::max(last_move, now);
        }
    });
    EXPECT_EQ(arrived_before, 8u);
    EXPECT_EQ(gone, 8u);
    EXPECT_GE(first_move, 36.0f);
    EXPECT_LE(last_move, 38.5f);
    EXPECT_GT(last_move, first_move + 0.4f) << "everybody reacts at the same moment";
}

TEST_F(PeopleTest, TakeTheNearerExitAndTheOtherOneWhenItJams) {
    const std::string room = R"({"throng": 1, "simulation": {"duration": 120, "avoid_congestion": AVOID},
 "areas": [{"id": "near", "polygon": [[-13,-1],[-11,-1],[-11,1],[-13,1]]},
  {"id": "far", "polygon": [[31,-1],[33,-1],[33,1],[31,1]]}],
 "walls": [{"points": [[-10,-0.6],[-10,-8],[30,-8],[30,-0.6]]}, {"points": [[-10,0.6],[-10,8],[30,8],[30,0.6]]}],
 "formations": [{"id": "crowd", "type": "grid", "origin": [-8, -6], "rows": 20, "columns": 22, "spacing": 0.65,
   "goal": {"nearest": ["near", "far"]}, "arrival": "leave", "people": {"speed": 1.3}}]})";
    const auto share = [&](const std::string& avoid, float seconds) {
        std::string text = room;
        text.replace(text.find("AVOID"), 5, avoid);
        const authoring::Scene scene = sceneOf(text);
        std::size_t far = 0, gone = 0;
        watch(scene, seconds, [&](float, const States& states) {
            far = gone = 0;
            for (const gpu::AgentState& state : states) {
                gone += state.status == gpu::STATUS_GONE;
                far += state.status == gpu::STATUS_GONE && world(scene, state).x > 20.0;
            }
        });
        EXPECT_GT(gone, 50u);
        return far;
    };
    EXPECT_EQ(share("false", 60.0f), 0u);
    const std::size_t far = share("true", 110.0f);
    std::printf("%zu of 440 took the further exit\n", far);
    EXPECT_GT(far, 40u);
}

TEST_F(PeopleTest, WalkAbreastInTwosAndInAVInThrees) {
    for (const std::size_t size : {std::size_t{2}, std::size_t{3}}) {
        const std::string groups = size == 2 ? "[0, 1]" : "[0, 0, 1]";
        const authoring::Scene scene = sceneOf(R"({"throng": 1, "simulation": {"duration": 60},
 "areas": [{"id": "a", "polygon": [[0,-20],[4,-20],[4,20],[0,20]]},
  {"id": "b", "polygon": [[70,-20],[74,-20],[74,20],[70,20]]}],
 "flows": [{"id": "f", "from": "a", "to": "b", "count": 24, "end": 20, "people": {"groups": )" +
                                               groups + "}}]}");
        double ahead = 0.0, beside = 0.0, lag = 0.0, furthest = 0.0;
        std::size_t looks = 0;
        watch(scene, 55.0f, [&](float, const States& states) {
            for (std::size_t first = 0; first < states.size(); first += size) {
                bool all = true;
                for (std::size_t i = first; i < first + size; ++i)
                    all = all && states[i].status == gpu::STATUS_WALKING && world(scene, states[i]).x > 20.0;
                if (!all) continue;
                std::vector<glm::dvec2> places;
                for (std::size_t i = first; i < first + size; ++i)
                    places.push_back(world(scene, states[i]));
                std::sort(places.begin(), places.end(), [](glm::dvec2 a, glm::dvec2 b) { return a.y < b.y; });
                ahead += std::abs(places.front().x - places.back().x);
                beside += (places.back().y - places.front().y) / static_cast<double>(size - 1);
                if (size == 3) lag += 0.5 * (places[0].x + places[2].x) - places[1].x;
                furthest = std::max(furthest, glm::distance(places.front(), places.back()));
                ++looks;
            }
        });
        ASSERT_GT(looks, 200u);
        ahead /= static_cast<double>(looks);
        beside /= static_cast<double>(looks);
        lag /= static_cast<double>(looks);
        std::printf("parties of %zu: %.2f m ahead, %.2f m beside, middle %.2f m behind, furthest %.2f m\n",
                    size, ahead, beside, lag, furthest);
        EXPECT_LT(ahead, 0.4);
        EXPECT_GT(beside, 0.5);
        EXPECT_LT(beside, 1.2);
        EXPECT_LT(furthest, size == 2 ? 3.0 : 4.0);
        if (size == 3) {
            EXPECT_GT(lag, 0.02) << "no V";
        }
    }
}

TEST_F(PeopleTest, DoNotLoseTheirCompanyInACounterflow) {
    const authoring::Scene scene = sceneOf(R"({"throng": 1, "simulation": {"duration": 120},
 "areas": [{"id": "a", "polygon": [[0,-4],[6,-4],[6,4],[0,4]]},
  {"id": "b", "polygon": [[54,-4],[60,-4],[60,4],[54,4]]}],
 "walls": [{"points": [[0,-5],[60,-5]]}, {"points": [[0,5],[60,5]]},
  {"closed": true, "points": [[28,-1],[32,-1],[32,1],[28,1]]}],
 "flows": [{"id": "east", "from": "a", "to": "b", "count": 60, "end": 40, "people": {"groups": [0, 1, 1, 1]}},
           {"id": "west", "from": "b", "to": "a", "count": 60, "end": 40, "people": {"groups": [1]}}]})");
    double gap_sum = 0.0, worst_at_end = 0.0;
    std::size_t gaps = 0, gone = 0;
    watch(scene, 115.0f, [&](float, const States& states) {
        gone = 0;
        for (std::size_t row = 0; row < states.size(); ++row) {
            gone += states[row].status == gpu::STATUS_GONE;
            const std::size_t first = scene.people[row].party_first;
            if (first == row || states[row].status != gpu::STATUS_WALKING ||
                states[first].status != gpu::STATUS_WALKING)
                continue;
            const double gap = glm::distance(states[row].position, states[first].position);
            gap_sum += gap;
            ++gaps;
            if (world(scene, states[row]).x > 45.0) worst_at_end = std::max(worst_at_end, gap);
        }
    });
    std::printf("mean gap to the first of a party %.2f m, widest near the end %.2f m\n",
                gap_sum / static_cast<double>(gaps), worst_at_end);
    EXPECT_EQ(gone, 120u);
    EXPECT_LT(gap_sum / static_cast<double>(gaps), 2.0);
    EXPECT_LT(worst_at_end, 6.0);
}

TEST_F(PeopleTest, APartyBetweenTwoExitsTakesOneOfThem) {
    const authoring::Scene scene = sceneOf(R"({"throng": 1, "simulation": {"duration": 60},
 "areas": [{"id": "south", "polygon": [[-1,-16],[1,-16],[1,-14],[-1,-14]]},
  {"id": "north", "polygon": [[-1,14],[1,14],[1,16],[-1,16]]}],
 "formations": [{"id": "pair", "type": "grid", "origin": [0, -0.4], "rows": 2, "columns": 1, "spacing": 0.8,
  "goal": {"nearest": ["south", "north"]}, "arrival": "leave", "people": {"groups": [0, 1], "speed": 1.3}}]})");
    ASSERT_EQ(scene.people[1].party_first, 0u);
    std::vector<double> ends(2);
    std::size_t gone = 0;
    watch(scene, 25.0f, [&](float, const States& states) {
        gone = 0;
        for (std::size_t row = 0; row < 2; ++row) {
            gone += states[row].status == gpu::STATUS_GONE;
            ends[row] = world(scene, states[row]).y;
        }
    });
    EXPECT_EQ(gone, 2u);
    EXPECT_GT(ends[0] * ends[1], 0.0) << "they parted";
}

TEST_F(PeopleTest, PartiesReachTheirPlacesHoweverFarApartTheseAre) {
    for (const std::string shape : {R"("type": "circle", "centre": [0, 0], "radius": 12, "count": 32)",
                                    R"("type": "grid", "origin": [-12, -5], "rows": 5, "columns": 6,
 "goal": {"anywhere": [[0, -12], [15, 12]]})"}) {
        const authoring::Scene scene = sceneOf(
            R"({"throng": 1, "simulation": {"duration": 60}, "formations": [{"id": "c",
 "people": {"groups": "leisure"}, )" +
            shape + "}]}");
        std::size_t arrived = 0;
        watch(scene, 50.0f, [&](float, const States& states) {
            arrived = 0;
            for (const gpu::AgentState& state : states)
                arrived += state.status == gpu::STATUS_ARRIVED;
        });
        EXPECT_EQ(arrived, scene.people.size()) << shape;
    }
}

TEST_F(PeopleTest, WhoFindsItsPlaceFullStopsNearBy) {
    const authoring::Scene scene = sceneOf(R"({"throng": 1, "simulation": {"duration": 60},
 "areas": [{"id": "a", "polygon": [[0,-3],[4,-3],[4,3],[0,3]]},
  {"id": "stall", "polygon": [[20,-0.4],[20.8,-0.4],[20.8,0.4],[20,0.4]]}],
 "flows": [{"id": "f", "from": "a", "to": "stall", "arrival": "stay", "count": 24, "end": 10}]})");
    std::size_t arrived = 0;
    double furthest = 0.0;
    watch(scene, 55.0f, [&](float, const States& states) {
        arrived = 0;
        furthest = 0.0;
        for (const gpu::AgentState& state : states) {
            arrived += state.status == gpu::STATUS_ARRIVED;
            furthest = std::max(furthest, glm::distance(world(scene, state), glm::dvec2(20.4, 0.0)));
        }
    });
    EXPECT_EQ(arrived, 24u);
    EXPECT_LT(furthest, 5.0);
}

TEST_F(PeopleTest, WhoStandsIsWalkedAround) {
    const authoring::Scene scene = sceneOf(R"({"throng": 1, "simulation": {"duration": 60},
 "areas": [{"id": "a", "polygon": [[0,-2],[4,-2],[4,2],[0,2]]},
  {"id": "b", "polygon": [[36,-2],[40,-2],[40,2],[36,2]]}],
 "formations": [{"id": "statues", "type": "grid", "origin": [18, -2], "rows": 3, "columns": 2, "spacing": 2,
  "goal": {"offset": [0, 0]}, "people": {"body": "disc"}}],
 "flows": [{"id": "f", "from": "a", "to": "b", "count": 40, "end": 20, "people": {"body": "disc"}}]})");
    const std::size_t statues = 6, first = scene.people.size() - statues;
    std::vector<glm::vec2> home;
    for (std::size_t row = first; row < scene.people.size(); ++row)
        home.push_back(scene.people[row].spawn_position);
    std::size_t gone = 0;
    float furthest = 0.0f, deepest = 0.0f;
    watch(scene, 60.0f, [&](float, const States& states) {
        gone = 0;
        for (std::size_t row = 0; row < first; ++row)
            gone += states[row].status == gpu::STATUS_GONE;
        for (std::size_t i = 0; i < statues; ++i)
            furthest = std::max(furthest, glm::distance(states[first + i].position, home[i]));
        deepest = std::max(deepest, overlapsOf(states, scene.people).deepest_percent);
    });
    EXPECT_EQ(gone, 40u);
    EXPECT_LT(furthest, 0.5f) << "m";  // they make a little room
    EXPECT_LT(deepest, 1.0f) << "%";
}

// What a frame hands to the next is all in Simulation::State: groups, gates, lines, routes round jams,
// entries.
TEST_F(PeopleTest, GoOnFromASavedStateToTheVerySameBytes) {
    const authoring::Scene scene = sceneOf(kStreet + R"("walls": [{"id": "gate", "points": [[30,-4],[30,4]]}],
 "flows": [{"id": "f", "from": "a", "to": "b", "rate": 3, "people": {"groups": "leisure"},
 "via": [{"at": "shop", "wait": 2, "activity": "queue", "line": [[19, 2], [23, 2]]}]}],
 "events": [{"at": 6, "open": "gate"}, {"at": 9, "close": "gate"}]})");
    constexpr int kSteps = 48 * 12;
    sim::Simulation whole(scene, library);
    for (int step = 0; step < kSteps; ++step)
        whole.step();
    const sim::Simulation::State end = whole.save();
    for (const int stop : {2, 48 * 5 + 3, 48 * 7, 48 * 10 + 1}) {
        sim::Simulation first(scene, library);
        for (int step = 0; step < stop; ++step)
            first.step();
        sim::Simulation second(scene, library);
        for (int step = 0; step < 18; ++step)
            second.step();  // whatever it did before is forgotten
        second.restore(first.save());
        for (int step = stop; step < kSteps; ++step)
            second.step();
        const sim::Simulation::State reached = second.save();
        EXPECT_EQ(reached.steps_done, end.steps_done);
        for (std::size_t part = 0; part < end.parts.size(); ++part)
            EXPECT_EQ(reached.parts[part], end.parts[part]) << end.parts[part].first << " after " << stop;
    }
}

TEST_F(PeopleTest, TheStateOfAnotherSceneIsRefused) {
    const authoring::Scene one =
        sceneOf(kStreet + R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 3}]})");
    const authoring::Scene other =
        sceneOf(kStreet + R"("flows": [{"id": "f", "from": "a", "to": "b", "count": 4}]})");
    sim::Simulation simulation(other, library);
    EXPECT_THROW(simulation.restore(sim::Simulation(one, library).save()), std::runtime_error);
}

TEST_F(PeopleTest, ProgramsThatAreKeptGiveTheSameBytes) {
    const authoring::Scene scene =
        sceneOf(kStreet + R"("flows": [{"id": "f", "from": "a", "to": "b", "rate": 4}]})");
    gl::ShaderLibrary kept = library;
    kept.keepPrograms();
    std::vector<sim::Simulation::State> ends;
    for (const gl::ShaderLibrary* each : {&library, &kept, &kept, &kept}) {
        sim::Simulation simulation(scene, *each);
        for (int step = 0; step < 200; ++step)
            simulation.step();
        ends.push_back(simulation.save());
    }
    for (std::size_t i = 1; i < ends.size(); ++i)
        EXPECT_EQ(ends[i].parts, ends[0].parts) << i;
}

}  // namespace
}  // namespace throng::test
