// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "base/lift_track.h"
#include "io/bake_reader.h"
#include "recording/bake_description.h"

namespace throng::io {

inline constexpr const char* kLiftFile = "lifts.npy";

/// Writes where cabins are and how far their doors are open, frame by frame (docs/bake.md). Throws
/// OutputError.
void writeLifts(const std::filesystem::path& path, std::span<const float> track, std::uint32_t frames,
                std::size_t lifts);

std::vector<LiftIdentity> liftsOf(const recording::BakeDescription& description);

/// Reads that file. Throws InputError.
std::vector<float> readLifts(const Bake& bake);

nlohmann::ordered_json liftsToJson(const std::vector<LiftIdentity>& lifts);

}  // namespace throng::io
