// SPDX-License-Identifier: Apache-2.0
// Routes round jams: the relaxed distances against a plain solution of the same equation.
#include <algorithm>
#include <glm/common.hpp>

#include "sim/simulation.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

constexpr std::uint32_t kWidth = 37, kHeight = 23;
constexpr float kCell = 0.75f;

/// Walking distances where leaving cell i costs `cost[i]` metres a metre: swept until nothing changes.
std::vector<float> plainDistances(const std::vector<float>& cost, std::uint32_t target) {
    std::vector<float> distance(cost.size(), gpu::BLOCKED_COST);
    distance[target] = 0.0f;
    const auto at = [&](int x, int y) {
        return x < 0 || y < 0 || x >= int{kWidth} || y >= int{kHeight}
                   ? gpu::BLOCKED_COST
                   : distance[static_cast<std::uint32_t>(y) * kWidth + static_cast<std::uint32_t>(x)];
    };
    for (int sweep = 0; sweep < 500; ++sweep)
        for (std::uint32_t cell = 0; cell < cost.size(); ++cell) {
            if (cell == target || cost[cell] >= gpu::BLOCKED_COST) continue;
            const int x = static_cast<int>(cell % kWidth), y = static_cast<int>(cell / kWidth);
            const float across = std::min(at(x - 1, y), at(x + 1, y));
            const float along = std::min(at(x, y - 1), at(x, y + 1));
            const float step = cost[cell] * kCell;
            const float near = std::min(across, along), difference = std::max(across, along) - near;
            distance[cell] =
                difference >= step
                    ? near + step
                    : near + 0.5f * (difference + std::sqrt(2.0f * step * step - difference * difference));
        }
    return distance;
}

class CongestionTest : public GpuTest {
  protected:
    /// A hall with a wall across it that has a door at either end.
    CongestionTest()
        : scene_(emptyScene({0, 0}, {kWidth * kCell, kHeight * kCell})), cost_(kWidth * kHeight, 1.0f) {
        for (std::uint32_t y = 4; y < kHeight - 4; ++y)
            cost_[y * kWidth + 18] = gpu::BLOCKED_COST;
        target_ = 5 * kWidth + 34;
        scene_.detours.grid = {scene_.minimum, kCell, kWidth, kHeight};
        for (const float cost : cost_)
            scene_.detours.ground.push_back({cost, 0, gpu::OPEN_TO_X | gpu::OPEN_TO_Y, 1.0f});
        scene_.detours.ground_of_field = {0};
        scene_.detours.distances = plainDistances(cost_, target_);
    }

    /// How fast jams make the way longer, along x and y.
    std::vector<glm::vec2> slopesAfter(int steps) {
        sim::Simulation simulation(scene_, library);
        for (int step = 0; step < steps; ++step)
            simulation.step();
        return simulation.parts().buffers.detour_slopes.download<glm::vec2>(cost_.size());
    }

    authoring::Scene scene_;
    std::vector<float> cost_;
    std::uint32_t target_ = 0;
};

TEST_F(CongestionTest, AnEmptyHallHasNoDetours) {
    addPerson(scene_, scene_.minimum + 1.0f, scene_.minimum + 1.0f);
    for (const glm::vec2 slope : slopesAfter(200))
        ASSERT_LT(glm::length(slope), 1.0e-3f);
}

TEST_F(CongestionTest, VeryManyFieldsTakeTheirTurnsAndComeToTheSame) {
    for (int i = 0; i < 36; ++i) {
        const glm::vec2 place = scene_.minimum + glm::vec2(13.2f + 0.52f * static_cast<float>(i % 6),
                                                           0.3f + 0.52f * static_cast<float>(i / 6));
        addPerson(scene_, place, place);
    }
    const std::vector<glm::vec2> alone = slopesAfter(1000);
    constexpr std::size_t kFields = 501;
    const std::vector<float> one = scene_.detours.distances;
    scene_.detours.ground_of_field.assign(kFields, 0);
    for (std::size_t field = 1; field < kFields; ++field)
        scene_.detours.distances.insert(scene_.detours.distances.end(), one.begin(), one.end());
    sim::Simulation simulation(scene_, library);
    const std::uint32_t at_once = simulation.parts().congestion.fieldsAtOnce();
    const double in_a_second =
        static_cast<double>(at_once * cost_.size()) / double{simulation.parameters().decision_seconds};
    EXPECT_LE(in_a_second, 24.0 * 128 * 1024) << "what a step costs does not grow with the fields";
    EXPECT_GE(in_a_second, 24.0 * 100 * 1024);
    for (int step = 0; step < 2000; ++step)
        simulation.step();
    const auto slopes = simulation.parts().buffers.detour_slopes.download<glm::vec2>(kFields * cost_.size());
    float largest = 0.0f, size = 0.0f;
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        largest = std::max(largest, glm::length(slopes[i] - alone[i % cost_.size()]));
        size = std::max(size, glm::length(slopes[i]));
    }
    EXPECT_GT(size, 0.1f) << "there is a jam";
    EXPECT_LT(largest, 0.02f);
}

TEST_F(CongestionTest, DistancesThroughAStandingCrowdAreThoseOfThePlainSolution) {
    for (int i = 0; i < 36; ++i) {
        const glm::vec2 place = scene_.minimum + glm::vec2(13.2f + 0.52f * static_cast<float>(i % 6),
                                                           0.3f + 0.52f * static_cast<float>(i / 6));
        addPerson(scene_, place, place);
    }
    const std::vector<float> free = scene_.detours.distances;
    std::vector<float> jammed = cost_;
    for (std::uint32_t cell = 0; cell < jammed.size(); ++cell) {
        const glm::vec2 middle = scene_.minimum + (glm::vec2(cell % kWidth, cell / kWidth) + 0.5f) * kCell;
        float weight = 0.0f;
        for (const gpu::Person& person : scene_.people) {
            const glm::vec2 near = glm::max(1.0f - glm::abs(person.spawn_position - middle) / kCell, 0.0f);
            weight += near.x * near.y;
        }
        const float crowd = std::clamp((weight / (kCell * kCell) - 1.3f) / 1.7f, 0.0f, 1.0f);
        jammed[cell] /= glm::mix(1.0f, 0.2f, crowd * crowd * (3.0f - 2.0f * crowd));
    }
    const std::vector<float> expected = plainDistances(jammed, target_);
    const std::vector<glm::vec2> slopes = slopesAfter(1000);
    float largest = 0.0f;
    for (std::uint32_t y = 1; y + 1 < kHeight; ++y)
        for (std::uint32_t x = 1; x + 1 < kWidth; ++x) {
            const std::uint32_t cell = y * kWidth + x;
            if (std::abs(static_cast<int>(x) - 18) <= 1)
                continue;  // differences are one-sided beside the wall
            const auto delay = [&](std::uint32_t at) { return expected[at] - free[at]; };
            const glm::vec2 slope =
                glm::vec2(delay(cell + 1) - delay(cell - 1), delay(cell + kWidth) - delay(cell - kWidth)) /
                (2.0f * kCell);
            if (glm::length(slope) > 3.9f) continue;  // bounded there
            largest = std::max(largest, glm::length(slope));
            ASSERT_NEAR(slopes[cell].x, slope.x, 0.02f) << x << ", " << y;
            ASSERT_NEAR(slopes[cell].y, slope.y, 0.02f) << x << ", " << y;
        }
    EXPECT_GT(largest, 0.5f) << "the crowd stands in the nearer door";
}

}  // namespace
}  // namespace throng::test
