// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace throng::analysis {

/// A file of analysis/report/web, put into the binary by the build.
/// @throws std::logic_error for one that is not there
std::string_view webFile(std::string_view name);
/// Its SHA-256, in hexadecimal digits.
std::string_view webFileHash(std::string_view name);

/// An HTML page that needs no network: styles, scripts and data are inside.
/// @param kind "bake" or "batch": takes KIND.html, common.js and KIND.js; @param data what the scripts read
std::string makePage(std::string_view kind, const std::string& title, const nlohmann::ordered_json& data);

/// RFC 4648.
std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace throng::analysis
