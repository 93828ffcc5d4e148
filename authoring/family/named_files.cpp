// SPDX-License-Identifier: Apache-2.0
#include "authoring/family/named_files.h"

namespace throng::authoring {

using Json = nlohmann::ordered_json;

std::vector<Json::json_pointer> namedFiles(const Json& layout) {
    std::vector<Json::json_pointer> found;
    if (!layout.is_object()) return found;
    const auto add = [&](const Json::json_pointer& pointer) {
        if (layout.contains(pointer) && layout.at(pointer).is_string()) found.push_back(pointer);
    };
    add(Json::json_pointer("/terrain/file"));
    const auto given = layout.find("given");
    if (given != layout.end() && given->is_array())
        for (std::size_t i = 0; i < given->size(); ++i)
            add(Json::json_pointer("/given") / i / "file");
    return found;
}

bool mayNameFiles(const std::string& pointer) {
    return pointer.starts_with("/terrain") || pointer.starts_with("/given");
}

void placeFiles(Json& layout, const std::filesystem::path& folder) {
    for (const auto& pointer : namedFiles(layout)) {
        const std::filesystem::path file = folder / layout[pointer].get<std::string>();
        layout[pointer] = std::filesystem::absolute(file).lexically_normal().string();
    }
}

}  // namespace throng::authoring
