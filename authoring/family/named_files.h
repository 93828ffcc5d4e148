// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace throng::authoring {

/// Where a layout names files that belong to it: its terrain's, and those of given people.
std::vector<nlohmann::ordered_json::json_pointer> namedFiles(const nlohmann::ordered_json& layout);

/// Whether what an axis sets at a pointer may name such files.
bool mayNameFiles(const std::string& pointer);

/// Makes the paths of those files absolute. @param folder that they start from
void placeFiles(nlohmann::ordered_json& layout, const std::filesystem::path& folder);

}  // namespace throng::authoring
