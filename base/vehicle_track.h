// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// What a bake tells of vehicles: one row per vehicle and frame of vehicles.npy (docs/bake.md).
namespace throng {

inline constexpr std::array<std::string_view, 8> kVehicleColumns{"x",     "y",     "z",     "heading",
                                                                 "speed", "along", "state", "braking"};
inline constexpr std::size_t kVehicleFloats = kVehicleColumns.size();

/// Where each of them is in a row.
enum class VehicleColumn : std::size_t { x, y, z, heading, speed, along, state, braking };

/// Its state: not there, drives, stands at a stop of its own with its doors open.
inline constexpr float kVehicleAway = 0.0f, kVehicleDrives = 1.0f, kVehicleStands = 2.0f;

/// One vehicle.
struct VehicleIdentity {
    std::string flow;                          ///< id
    std::string kind;                          ///< "car", ...
    double length = 0, width = 0, height = 0;  ///< m
    double wheel = 0;                          ///< m, radius
};

}  // namespace throng
