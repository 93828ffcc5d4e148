// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace throng {

/// What a frame says of the doors of a vehicle, and in doors.npy the last axis: how far they are open on its
/// left and on its right, who is in it, and who has got on and off where it stands or has stood last.
enum class DoorColumn { left, right, aboard, boarded, alighted };
inline constexpr std::array<const char*, 5> kDoorColumns = {"left", "right", "aboard", "boarded", "alighted"};
inline constexpr std::size_t kDoorFloats = kDoorColumns.size();

/// @param row of a track of doors: frame * vehicles + vehicle
inline float doorIn(std::span<const float> track, std::size_t row, DoorColumn column) {
    return track[row * kDoorFloats + static_cast<std::size_t>(column)];
}

/// The doors of one vehicle.
struct DoorIdentity {
    std::vector<double> at;  ///< m behind its front: their middles; empty: it has none
    double width = 0.0;      ///< m
    bool left = false, right = false;
    std::uint32_t capacity = 0;  ///< people in the vehicle
};

}  // namespace throng
