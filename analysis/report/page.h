// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace throng::analysis {

/// A file of analysis/report/web, put into the binary by the build.
struct WebFile {
    std::string_view name, text;
    std::string_view sha256;  ///< of the text, in hexadecimal digits
};
std::span<const WebFile> webFiles();

/// An HTML page that needs no network: styles, scripts and data are inside.
/// @param kind "bake", "batch" or "watch": takes KIND.html, and the files that it names as `@common.js@`
/// @param data what the scripts read
/// @param connections where its scripts may ask for more, as a Content Security Policy has it; empty: nowhere
std::string makePage(std::string_view kind, const std::string& title, const nlohmann::ordered_json& data,
                     std::string_view connections = {});

/// RFC 4648.
std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace throng::analysis
