// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "shaders/shared/boarding_types.h"
#include "shaders/shared/scene_types.h"
#include "shaders/shared/traffic_types.h"

namespace throng::authoring {

/// When one thing that a signal holds is green: round and round, from time 0 on.
struct LightPlan {
    double offset = 0.0;  ///< s
    double cycle = 1.0;   ///< s
    struct Span {
        double begin = 0.0, end = 0.0;  ///< s into the cycle
    };
    std::vector<Span> green;
    bool isGreen(double time) const;
};

/// Signals and vehicles as the device has them, in the scene frame.
struct SceneTraffic {
    std::vector<gpu::Vehicle> vehicles;
    std::vector<gpu::TrafficLane> lanes;
    std::vector<gpu::LanePoint> lane_points;
    std::vector<gpu::TrafficStop> stops;
    std::vector<gpu::TrafficCrossing> crossings;
    std::vector<glm::vec2> crossing_points;
    std::vector<LightPlan> lights;
    std::vector<std::string> flows;      ///< ids
    std::vector<std::uint32_t> flow_of;  ///< per vehicle, index into flows
    std::vector<gpu::Platform> platforms;
    std::vector<glm::vec2> platform_points;  ///< their outlines
    // Empty without platforms:
    std::vector<gpu::VehicleService> services;  ///< per vehicle
    std::vector<gpu::VehicleDoor> doors;
    std::vector<gpu::AlightingCall> calls;  ///< vehicle after vehicle
    bool hasDoors() const { return !services.empty(); }
    bool empty() const { return crossings.empty() && vehicles.empty(); }
};

}  // namespace throng::authoring
