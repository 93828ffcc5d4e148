// SPDX-License-Identifier: Apache-2.0
#include "cli/terminal/failure.h"

#include <algorithm>
#include <string_view>

#include "cli/terminal/say.h"

namespace throng::cli {

using nlohmann::ordered_json;

ordered_json diagnosticsJson(const authoring::Diagnostics& diagnostics) {
    ordered_json list = ordered_json::array();
    for (const authoring::Diagnostic& entry : diagnostics.entries)
        list.push_back({{"severity", entry.severity == authoring::Severity::error ? "error" : "warning"},
                        {"file", diagnostics.file},
                        {"line", entry.where.line},
                        {"column", entry.where.column},
                        {"pointer", entry.where.pointer()},
                        {"message", entry.message},
                        {"hint", entry.hint}});
    return list;
}

bool asksForJson(int argc, const char* const* argv) {
    return std::any_of(argv, argv + argc,
                       [](const char* word) { return std::string_view(word) == "--json"; });
}

void sayFailureJson(int code, const std::string& message, const std::string& hint,
                    const ordered_json& diagnostics) {
    sayJson(
        {{"error", {{"code", code}, {"message", message}, {"hint", hint}, {"diagnostics", diagnostics}}}});
}

}  // namespace throng::cli
