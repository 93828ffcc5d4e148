// SPDX-License-Identifier: Apache-2.0
#include "authoring/traffic.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

constexpr double kStep = 1.0 / 48.0;  // s, of a scene's settings

gpu::Vehicle carAt(float start) {
    const authoring::VehicleType& type = authoring::typeOf(authoring::VehicleKind::car);
    gpu::Vehicle car{};
    car.start = start;
    car.length = static_cast<float>(type.length);
    car.half_width = static_cast<float>(0.5 * type.width);
    car.wished_speed = static_cast<float>(type.speed);
    car.headway = static_cast<float>(type.headway);
    car.most_acceleration = static_cast<float>(type.acceleration);
    car.braking = static_cast<float>(type.braking);
    car.gap = static_cast<float>(type.gap);
    return car;
}

/// One straight lane along x, far from the one person that there is.
authoring::Scene straightLane(float length) {
    authoring::Scene scene = emptyScene({-20.0f, -60.0f}, {150.0f, 20.0f});
    addPerson(scene, {0.0f, -50.0f}, {1.0f, -50.0f});
    authoring::SceneTraffic& traffic = scene.traffic;
    traffic.lane_points = {{{0.0f, 0.0f}, 0.0f, 0}, {{length, 0.0f}, length, 0}};
    traffic.lanes = {{0, 2, 0, 0, length, 0}};
    return scene;
}

class TrafficTest : public GpuTest {
  protected:
    std::vector<gpu::Vehicle> after(authoring::Scene& scene, int steps) {
        sim::Simulation simulation(scene, library);
        for (int i = 0; i < steps; ++i)
            simulation.step();
        return simulation.parts().buffers.vehicles.download<gpu::Vehicle>(scene.traffic.vehicles.size());
    }
};

/// Treiber, Hennecke and Helbing 2000, equation 3, in double precision.
double modelAcceleration(const authoring::VehicleType& type, double speed, double gap, double closing) {
    const double wished =
        type.gap + std::max(0.0, speed * type.headway +
                                     speed * closing / (2.0 * std::sqrt(type.acceleration * type.braking)));
    return type.acceleration *
           (1.0 - std::pow(speed / type.speed, 4.0) - std::pow(wished / std::max(gap, 0.01), 2.0));
}

TEST_F(TrafficTest, SpeedsUpOnAnEmptyLaneAsTheModelDoes) {
    authoring::Scene scene = straightLane(4000.0f);
    scene.traffic.vehicles = {carAt(0.0f)};
    scene.traffic.vehicles[0].status = gpu::VEHICLE_DRIVES;
    const authoring::VehicleType& type = authoring::typeOf(authoring::VehicleKind::car);
    double speed = 0.0, along = 0.0;
    for (const int seconds : {2, 5, 10, 20}) {
        speed = along = 0.0;
        for (int i = 0; i < seconds * 48; ++i) {
            const double next = speed + modelAcceleration(type, speed, 1.0e9, 0.0) * kStep;
            along += 0.5 * (speed + next) * kStep;
            speed = next;
        }
        const gpu::Vehicle car = after(scene, seconds * 48)[0];
        EXPECT_NEAR(car.speed, speed, 1.0e-3) << seconds;
        EXPECT_NEAR(car.along, along, 1.0e-2) << seconds;
    }
    EXPECT_NEAR(speed, type.speed, 0.1);  // which it gets near
}

TEST_F(TrafficTest, KeepsTheModelsGapBehindASlowerOne) {
    authoring::Scene scene = straightLane(6000.0f);
    const authoring::VehicleType& type = authoring::typeOf(authoring::VehicleKind::car);
    scene.traffic.vehicles = {carAt(0.0f), carAt(0.0f)};
    for (gpu::Vehicle& car : scene.traffic.vehicles)
        car.status = gpu::VEHICLE_DRIVES;
    scene.traffic.vehicles[0].along = 60.0f;
    scene.traffic.vehicles[0].wished_speed = 8.0f;
    const std::vector<gpu::Vehicle> cars = after(scene, 120 * 48);
    EXPECT_NEAR(cars[1].speed, 8.0, 0.02);
    const double share = 8.0 / type.speed;
    const double equilibrium =
        (type.gap + 8.0 * type.headway) / std::sqrt(1.0 - share * share * share * share);
    EXPECT_NEAR(cars[0].along - cars[0].length - cars[1].along, equilibrium, 0.1);
}

/// All of a stream that brakes before a light and goes on, as a plain reference computes it.
TEST_F(TrafficTest, AStreamBeforeALightIsWhatAPlainReferenceMakesOfIt) {
    authoring::Scene scene = straightLane(3000.0f);
    const authoring::VehicleType& type = authoring::typeOf(authoring::VehicleKind::car);
    constexpr int kCars = 6;
    constexpr float kLine = 200.0f;
    constexpr double kGreen = 40.0;
    for (int i = 0; i < kCars; ++i) {
        scene.traffic.vehicles.push_back(carAt(0.0f));
        scene.traffic.vehicles.back().status = gpu::VEHICLE_DRIVES;
        scene.traffic.vehicles.back().along = 100.0f - 20.0f * static_cast<float>(i);
        scene.traffic.vehicles.back().speed = 10.0f;
    }
    scene.traffic.stops = {{kLine, 0.0f, gpu::STOP_AT_RED, 0, gpu::NO_INDEX}};
    scene.traffic.lanes[0].stop_count = 1;
    scene.traffic.lights = {{0.0, 1000.0, {{kGreen, 1000.0}}}};
    std::vector<double> along, speed(kCars, 10.0);
    for (const gpu::Vehicle& car : scene.traffic.vehicles)
        along.push_back(car.along);
    for (int step = 0; step < 60 * 48; ++step) {
        const std::vector<double> was = along, had = speed;
        const bool red = step * kStep < kGreen;
        for (int i = 0; i < kCars; ++i) {
            const double free = modelAcceleration(type, had[i], 1.0e9, 0.0);
            double acceleration = free;
            if (i > 0)
                acceleration = std::min(
                    acceleration,
                    modelAcceleration(type, had[i], was[i - 1] - type.length - was[i], had[i] - had[i - 1]));
            if (red && was[i] <= kLine + 0.3 && kLine - was[i] <= 60.0)
                acceleration = std::min(acceleration,
                                        modelAcceleration(type, had[i], kLine - was[i] + type.gap, had[i]));
            acceleration = std::max(acceleration, -8.0);
            const double next = had[i] + acceleration * kStep;
            along[i] += next < 0.0 ? had[i] * had[i] / (-2.0 * acceleration)
                                   : 0.5 * (had[i] + std::max(next, 0.0)) * kStep;
            speed[i] = std::max(next, 0.0);
        }
    }
    const std::vector<gpu::Vehicle> cars = after(scene, 60 * 48);
    for (int i = 0; i < kCars; ++i) {
        EXPECT_NEAR(cars[i].along, along[i], 0.25) << i;
        EXPECT_NEAR(cars[i].speed, speed[i], 0.05) << i;
    }
    EXPECT_GT(cars[kCars - 1].along, kLine);  // green let all of them go
    const std::vector<gpu::Vehicle> waiting = after(scene, 35 * 48);
    EXPECT_LE(waiting[0].along, kLine + 0.3f);
    EXPECT_NEAR(waiting[0].along, kLine, 1.0);
    for (int i = 0; i < kCars; ++i)
        EXPECT_LT(waiting[i].speed, 0.1f);
}

TEST_F(TrafficTest, StandsAtItsStopForItsTime) {
    authoring::Scene scene = straightLane(2000.0f);
    scene.traffic.vehicles = {carAt(0.0f)};
    scene.traffic.stops = {{100.0f, 12.0f, gpu::STOP_FOR_TIME, gpu::NO_LIGHT, gpu::NO_INDEX}};
    scene.traffic.lanes[0].stop_count = 1;
    sim::Simulation simulation(scene, library);
    int standing = 0;
    for (int i = 0; i < 60 * 48; ++i) {
        simulation.step();
        const gpu::Vehicle car = simulation.parts().buffers.vehicles.download<gpu::Vehicle>(1)[0];
        if (car.status != gpu::VEHICLE_STANDS) continue;
        ++standing;
        EXPECT_NEAR(car.along, 100.0, 0.85);
        EXPECT_EQ(car.speed, 0.0f);
    }
    EXPECT_NEAR(standing * kStep, 12.0, 0.05);
    EXPECT_EQ(simulation.parts().buffers.vehicles.download<gpu::Vehicle>(1)[0].status, gpu::VEHICLE_DRIVES);
}

/// m from a disc to a box, by hand.
float apart(glm::vec2 place, const gpu::VehicleBox& box) {
    const glm::vec2 axis = glm::normalize(box.front - box.rear),
                    offset = place - 0.5f * (box.rear + box.front);
    const glm::vec2 beyond(std::abs(glm::dot(offset, axis)) - 0.5f * glm::distance(box.front, box.rear),
                           std::abs(axis.x * offset.y - axis.y * offset.x) - box.half_width);
    return glm::length(glm::max(beyond, glm::vec2(0.0f))) + std::min(std::max(beyond.x, beyond.y), 0.0f);
}

TEST_F(TrafficTest, StopsForWhoeverStandsInItsWay) {
    authoring::Scene scene = straightLane(300.0f);
    addPerson(scene, {120.0f, 0.3f}, {120.0f, 0.3f});
    scene.traffic.vehicles = {carAt(0.0f)};
    sim::Simulation simulation(scene, library);
    float least = 1.0e9f;
    for (int i = 0; i < 40 * 48; ++i) {
        simulation.step();
        const auto states = simulation.parts().buffers.states.download<gpu::AgentState>(2);
        const auto box = simulation.parts().buffers.vehicle_boxes.download<gpu::VehicleBox>(1)[0];
        if (box.half_width > 0.0f)
            least = std::min(least, apart(states[1].position, box) - scene.people[1].radius);
    }
    EXPECT_GT(least, 0.1f);
}

TEST(LightPlan, IsGreenInItsSpansRoundAndRound) {
    const authoring::LightPlan plan{2.0, 10.0, {{0.0, 3.0}, {7.0, 8.0}}};
    for (const double cycle : {-20.0, 0.0, 30.0}) {
        EXPECT_TRUE(plan.isGreen(cycle));         // 2 s into it
        EXPECT_FALSE(plan.isGreen(cycle + 1.0));  // 3
        EXPECT_TRUE(plan.isGreen(cycle + 5.5));   // 7.5
        EXPECT_FALSE(plan.isGreen(cycle + 6.0));  // 8
        EXPECT_TRUE(plan.isGreen(cycle + 8.0));   // 10
    }
}

}  // namespace
}  // namespace throng::test
