// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "base/door_track.h"
#include "io/bake_reader.h"
#include "recording/bake_description.h"

namespace throng::io {

inline constexpr const char* kDoorFile = "doors.npy";

/// Writes how far doors of vehicles are open and how many people these hold, frame by frame (docs/bake.md).
/// Throws OutputError.
void writeDoors(const std::filesystem::path& path, std::span<const float> track, std::uint32_t frames,
                std::size_t vehicles);

/// What the file holds: kDoorFloats of each vehicle, frame by frame. Throws InputError.
std::vector<float> readDoors(const Bake& bake);

nlohmann::ordered_json doorsToJson(const std::vector<DoorIdentity>& doors);

}  // namespace throng::io
