// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace throng::authoring {

/// Where a layout names files that belong to it: its terrain's, and those of given people.
std::vector<nlohmann::ordered_json::json_pointer> namedFiles(const nlohmann::ordered_json& layout);

}  // namespace throng::authoring
