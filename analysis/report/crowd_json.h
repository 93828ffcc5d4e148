// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "io/agent_rows.h"
#include "io/bake_reader.h"

namespace throng::analysis {

/// What a page's player has to know of a crowd before its ways: name, time, bounds, walls and all else that
/// stands there, groups and their colours.
nlohmann::ordered_json crowdJson(const io::Bake& bake, const io::GroupTable& groups);

}  // namespace throng::analysis
