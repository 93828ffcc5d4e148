// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/cabin.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "authoring/storeys/chart.h"
#include "shaders/shared/lift_types.h"

namespace throng::authoring {
namespace {

constexpr double kBetween = 0.02;  // m: left between two who stand in a cabin

/// m: from side to side and from chest to back, of the largest.
glm::dvec2 largestBody(const Layout& layout) {
    glm::dvec2 largest(0.0);
    const auto look = [&](const People& people) {
        for (const PeopleShare& share : people.kinds) {
            const PersonSettings& each = share.settings;
            const glm::dvec2 size = each.body
                                        ? glm::dvec2(each.body->breadth.maximum, each.body->depth.maximum)
                                        : glm::dvec2(2.0 * each.radius.maximum);
            largest = glm::max(largest, size);
        }
    };
    for (const Flow& flow : layout.flows)
        look(flow.people);
    for (const Formation& formation : layout.formations)
        look(formation.people);
    return largest == glm::dvec2(0.0) ? glm::dvec2(0.5) : largest;
}

}  // namespace

CabinSpots spotsIn(const Layout& layout, const Lift& lift) {
    const glm::dvec2 room = lift.size - kRailing, needed = largestBody(layout) + kBetween;
    const glm::dvec2 fit = glm::floor(room / needed + 1.0e-6);
    CabinSpots spots;
    spots.columns = static_cast<std::uint32_t>(fit.x);
    spots.rows = static_cast<std::uint32_t>(fit.y);
    spots.apart = room / glm::max(fit, glm::dvec2(1.0));
    return spots;
}

std::uint32_t capacityOf(const Layout& layout, const Lift& lift) {
    return lift.capacity.value_or(std::min(spotsIn(layout, lift).count(), gpu::MOST_SPOTS));
}

glm::dvec2 outOfCabin(const Lift& lift, std::size_t stop) {
    const double angle = glm::radians(lift.doors + (lift.opposite[stop] ? 180.0 : 0.0));
    const glm::dvec2 exact(std::cos(angle), std::sin(angle));
    return glm::round(exact * 1.0e12) / 1.0e12;  // right angles are exact
}

double heightOfStop(const Layout& layout, const Lift& lift, std::size_t stop) {
    return lift.heights.empty() ? layout.levels[lift.levels[stop]].height : lift.heights[stop];
}

double travelTime(const Lift& lift, double rise) {
    const double way = std::abs(rise), acceleration = gpu::LIFT_ACCELERATION;
    const double needed = lift.speed * lift.speed / acceleration;
    return way < needed ? 2.0 * std::sqrt(way / acceleration) : way / lift.speed + lift.speed / acceleration;
}

namespace {

double timeAtStop(const Lift& lift) {
    return 2.0 * lift.door_time + lift.dwell;
}

}  // namespace

double roundOfLift(const Lift& lift, double whole) {
    return 2.0 * (travelTime(lift, whole) + timeAtStop(lift));
}

double timeByLift(const Lift& lift, double whole, double rise) {
    const double wait = 0.25 * roundOfLift(lift, whole);
    return wait + timeAtStop(lift) + travelTime(lift, rise) + lift.door_time;
}

}  // namespace throng::authoring
