// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/agent_rows.h"
#include "recording/bake_description.h"

namespace throng::io {

/// Beside the streams of a bake under way: what they are of, for those who look on while they grow. It goes
/// when the bake is completed.
inline constexpr const char* kUnderWayFile = "under-way.json";

/// A bake before it is one: all that its bake.json will say of the place and the time, with as many frames as
/// are expected, and of its people their groups and sizes.
struct ExpectedBake {
    Bake bake;
    std::vector<AgentRow> people;
};
ExpectedBake expectedBake(const recording::BakeDescription& description);

/// The file's content.
std::string underWayText(const recording::BakeDescription& description);
/// What it says, of the folder it lies in. Throws InputError.
ExpectedBake readUnderWay(const std::filesystem::path& folder);

}  // namespace throng::io
