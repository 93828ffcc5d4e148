// SPDX-License-Identifier: Apache-2.0
#include "analysis/live/moments.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "analysis/report/crowd_json.h"
#include "base/frame.h"
#include "base/vehicle_track.h"

namespace throng::analysis {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostSteps = 65535.0, kTurn = 65536.0;
constexpr std::size_t kNowhere = 255;
constexpr double kBesideLanes = 20.0;  // m: what is on a lane's end is longer than that to no side

double quantumOf(glm::dvec2 extent) {
    return std::max({extent.x, extent.y, 1.0}) / kMostSteps;
}

class Bytes {
  public:
    explicit Bytes(std::size_t room) { text_.reserve(room); }
    void put8(std::size_t value) { text_ += static_cast<char>(value & 255u); }
    void put16(std::uint32_t value) {
        put8(value);
        put8(value >> 8);
    }
    void put32(std::uint32_t value) {
        put16(value);
        put16(value >> 16);
    }
    /// m from a corner, in steps. Whoever is outside is at the edge.
    void putSteps(double metres, double quantum) {
        const double steps = std::isfinite(metres) ? std::round(metres / quantum) : 0.0;
        put16(static_cast<std::uint32_t>(std::clamp(steps, 0.0, kMostSteps)));
    }
    std::string take() { return std::move(text_); }

  private:
    std::string text_;
};

float valueOf(std::span<const float> vehicle, VehicleColumn column) {
    return vehicle[static_cast<std::size_t>(column)];
}

}  // namespace

MomentPacker::MomentPacker(const io::Bake& bake, double per_second)
    : bake_(bake),
      storeys_(bake),
      every_(static_cast<std::uint32_t>(std::max(1.0, std::round(bake.fps / per_second)))),
      quantum_(quantumOf(bake.maximum - bake.minimum)) {
    glm::dvec2 low = bake.minimum, high = bake.maximum;
    for (const authoring::Lane& lane : bake.traffic.lanes)
        for (const glm::dvec2 point : lane.points) {
            low = glm::min(low, point);
            high = glm::max(high, point);
        }
    vehicle_minimum_ = low - kBesideLanes;
    vehicle_quantum_ = quantumOf(high - low + 2.0 * kBesideLanes);
}

Json MomentPacker::about(const std::vector<io::AgentRow>& people, bool with_vehicles) const {
    const io::GroupTable groups = io::groupsOf(people);
    Json about = crowdJson(bake_, groups);
    about["seed"] = bake_.seed;
    about["origin"] = {bake_.origin.x, bake_.origin.y};  // m, in the world
    about["every"] = every_;
    about["quantum"] = quantum_;
    about["group"] = groups.group_of;
    Json radii = Json::array();
    for (const io::AgentRow& row : people)
        radii.push_back(std::round(static_cast<double>(row.radius) * 1000.0) / 1000.0);
    about["radii"] = std::move(radii);
    about["vehicles"] = Json::array();
    if (with_vehicles)
        for (const VehicleIdentity& vehicle : bake_.vehicles)
            about["vehicles"].push_back(
                {{"kind", vehicle.kind}, {"length", vehicle.length}, {"width", vehicle.width}});
    about["ground"] = {{"minimum", {vehicle_minimum_.x, vehicle_minimum_.y}}, {"quantum", vehicle_quantum_}};
    return about;
}

std::string MomentPacker::pack(std::uint32_t frame, std::span<const float> places,
                               std::span<const float> states, std::span<const float> vehicles) const {
    const std::size_t people = places.size() / kComponents;
    Bytes bytes(4 + 5 * people + vehicles.size());
    bytes.put32(frame);
    for (std::size_t row = 0; row < people; ++row) {
        const auto place = rowOf(places, row);
        bytes.putSteps(static_cast<double>(place[0]) - bake_.minimum.x, quantum_);
        bytes.putSteps(static_cast<double>(place[1]) - bake_.minimum.y, quantum_);
    }
    for (std::size_t row = 0; row < people; ++row) {
        const auto place = rowOf(places, row);
        if (!(rowOf(states, row)[0] > 0.5f))
            bytes.put8(0);
        else if (!bake_.hasStoreys())
            bytes.put8(1);
        else
            bytes.put8(
                std::min(1 + storeys_.storeyAt({place[0], place[1]}, place[2]).value_or(kNowhere), kNowhere));
    }
    for (std::size_t at = 0; at + kVehicleFloats <= vehicles.size(); at += kVehicleFloats) {
        const auto vehicle = vehicles.subspan(at, kVehicleFloats);
        const double turns = double{valueOf(vehicle, VehicleColumn::heading)} / (2.0 * std::numbers::pi);
        bytes.putSteps(double{valueOf(vehicle, VehicleColumn::x)} - vehicle_minimum_.x, vehicle_quantum_);
        bytes.putSteps(double{valueOf(vehicle, VehicleColumn::y)} - vehicle_minimum_.y, vehicle_quantum_);
        bytes.put16(static_cast<std::uint32_t>(std::lround((turns - std::floor(turns)) * kTurn)) & 0xffffu);
        bytes.put16(static_cast<std::uint32_t>(valueOf(vehicle, VehicleColumn::state)));
    }
    return bytes.take();
}

}  // namespace throng::analysis
