// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "base/vehicle_track.h"
#include "io/bake_reader.h"
#include "recording/bake_description.h"

namespace throng::io {

inline constexpr const char* kVehicleFile = "vehicles.npy";

/// Of so many frames, with places as the streams have them, on the ground.
/// @param track kVehicleFloats of each vehicle, frame by frame, places in the scene frame
std::vector<float> placedVehicles(const recording::BakeDescription& description, std::span<const float> track,
                                  std::uint32_t frames);

/// Writes where vehicles are, frame by frame (docs/bake.md). Throws OutputError.
void writeVehicles(const std::filesystem::path& path, std::span<const float> placed, std::uint32_t frames,
                   std::size_t vehicles);

/// What the file holds: kVehicleFloats of each vehicle, frame by frame. Throws InputError.
std::vector<float> readVehicles(const Bake& bake);

nlohmann::ordered_json vehiclesToJson(const std::vector<VehicleIdentity>& vehicles);
/// Lanes, crossings and signals.
nlohmann::ordered_json trafficToJson(const authoring::Traffic& traffic, glm::dvec2 origin);

}  // namespace throng::io
