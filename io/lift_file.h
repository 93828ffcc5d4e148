// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "base/lift_track.h"
#include "recording/bake_description.h"

namespace throng::io {

inline constexpr const char* kLiftFile = "lifts.npy";

/// Writes where cabins are and how far their doors are open, frame by frame (docs/bake.md). Throws
/// OutputError.
void writeLifts(const std::filesystem::path& path, std::span<const float> track, std::uint32_t frames,
                std::size_t lifts);

nlohmann::ordered_json liftsToJson(const recording::BakeDescription& description);

}  // namespace throng::io
