// SPDX-License-Identifier: Apache-2.0
#include "analysis/measure/vehicle_watch.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/door_track.h"
#include "base/storeys.h"
#include "io/door_file.h"
#include "io/vehicle_file.h"

namespace throng::analysis {
namespace {

constexpr double kNear = 20.0;      // m: those further away are no matter
constexpr double kRunOver = -0.01;  // m
constexpr double kSteepest = 0.12;  // rise over run, of streets

/// m from the outline of a box round the origin, below 0 inside.
double distanceToBox(glm::dvec2 place, glm::dvec2 half) {
    const glm::dvec2 beyond = glm::abs(place) - half;
    return glm::length(glm::max(beyond, glm::dvec2(0.0))) + std::min(std::max(beyond.x, beyond.y), 0.0);
}

}  // namespace

VehicleWatch::VehicleWatch(const io::Bake& bake) : bake_(bake), run_over_(bake.agents, false) {
    if (!bake.vehicles.empty()) track_ = io::readVehicles(bake);
    if (!bake.doors.empty()) doors_ = io::readDoors(bake);
}

std::span<const float> VehicleWatch::placeOf(std::uint32_t frame, std::size_t vehicle) const {
    return std::span(track_).subspan((frame * bake_.vehicles.size() + vehicle) * kVehicleFloats,
                                     kVehicleFloats);
}

bool VehicleWatch::isInDoorway(std::uint32_t frame, std::size_t vehicle, glm::dvec2 place) const {
    if (doors_.empty()) return false;
    const std::size_t row = frame * bake_.vehicles.size() + vehicle;
    const auto side = place.y > 0.0 ? DoorColumn::left : DoorColumn::right;
    if (doorIn(doors_, row, side) <= 0.0f) return false;
    const DoorIdentity& doors = bake_.doors[vehicle];
    const double behind = 0.5 * bake_.vehicles[vehicle].length - place.x;
    return std::ranges::any_of(doors.at,
                               [&](double at) { return std::abs(behind - at) <= 0.5 * doors.width; });
}

void VehicleWatch::look(std::uint32_t frame, std::uint32_t row, const Capsule& body, double height) {
    for (std::size_t i = 0; i < bake_.vehicles.size(); ++i) {
        const std::span<const float> at = placeOf(frame, i);
        if (at[static_cast<std::size_t>(VehicleColumn::state)] == kVehicleAway) continue;
        const glm::dvec2 offset = body.middle - glm::dvec2(at[0], at[1]);
        const glm::dvec2 half(0.5 * bake_.vehicles[i].length, 0.5 * bake_.vehicles[i].width);
        if (glm::length(offset) > kNear + half.x) continue;
        // Its height is that of its middle: on a slope its ends are higher and lower.
        const double apart = std::abs(double{at[2]} - height) - kSteepest * glm::length(offset);
        if (bake_.hasStoreys() && !areOnOneGround(std::max(apart, 0.0), 0.0)) continue;
        const double heading = at[static_cast<std::size_t>(VehicleColumn::heading)];
        const glm::dvec2 along(std::cos(heading), std::sin(heading)), aside(-along.y, along.x);
        if (isInDoorway(frame, i, {glm::dot(offset, along), glm::dot(offset, aside)})) continue;
        const auto gapAt = [&](double share) {
            const glm::dvec2 place = offset + share * body.axis;
            return distanceToBox({glm::dot(place, along), glm::dot(place, aside)}, half) - body.thickness;
        };
        const double gap = std::min({gapAt(-1.0), gapAt(0.0), gapAt(1.0)});
        least_ = std::min(least_.value_or(gap), gap);
        if (gap < kRunOver) run_over_.at(row) = true;
    }
}

std::uint32_t VehicleWatch::runOver() const {
    return static_cast<std::uint32_t>(std::ranges::count(run_over_, true));
}

}  // namespace throng::analysis
