// SPDX-License-Identifier: Apache-2.0
#include "analysis/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace throng::analysis {
namespace {

std::string escaped(std::string_view text) {
    std::string result;
    for (const char letter : text) {
        switch (letter) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += letter;
        }
    }
    return result;
}

/// JSON inside a script element must not end it.
std::string scriptSafe(const std::string& json) {
    std::string result;
    result.reserve(json.size());
    for (const char letter : json)
        result += letter == '<' ? std::string("\\u003c") : std::string(1, letter);
    return result;
}

void put(std::string& page, std::string_view word, std::string_view content) {
    const std::size_t at = page.find(word);
    if (at != std::string::npos) page.replace(at, word.size(), content);
}

std::vector<unsigned char> bytesOf(std::string_view hexadecimal) {
    std::vector<unsigned char> bytes;
    for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2) {
        unsigned char byte = 0;
        std::from_chars(hexadecimal.data() + i, hexadecimal.data() + i + 2, byte, 16);
        bytes.push_back(byte);
    }
    return bytes;
}

/// Puts the files that a page names into it. @returns those of that ending, as a Content Security Policy
/// names them
std::string putFiles(std::string& page, std::string_view ending) {
    std::string hashes;
    for (const WebFile& file : webFiles()) {
        const std::string word = fmt::format("@{}@", file.name);
        if (!file.name.ends_with(ending) || page.find(word) == std::string::npos) continue;
        put(page, word, file.text);
        hashes += fmt::format(" 'sha256-{}'", base64(bytesOf(file.sha256)));
    }
    return hashes;
}

}  // namespace

/// What a browser may do with a page (Content Security Policy): run and show what is ours, by its hash, and
/// load nothing. Styles of single elements cannot load anything then.
std::string makePage(std::string_view kind, const std::string& title, const nlohmann::ordered_json& data,
                     std::string_view connections) {
    const auto own = std::ranges::find(webFiles(), fmt::format("{}.html", kind), &WebFile::name);
    if (own == webFiles().end()) throw std::logic_error("there is no such page");
    std::string page(own->text);
    putFiles(page, ".html");
    const std::string scripts = putFiles(page, ".js"), styles = putFiles(page, ".css");
    put(page, "@POLICY@",
        fmt::format("default-src 'none'; script-src{}; style-src-elem{}; style-src-attr 'unsafe-inline'; {}"
                    "base-uri 'none'; form-action 'none'",
                    scripts, styles,
                    connections.empty() ? "" : fmt::format("connect-src {}; ", connections)));
    put(page, "@DATA@", scriptSafe(data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)));
    put(page, "@TITLE@", escaped(title));  // last: whatever it is, nothing is put into it
    return page;
}

std::string base64(const std::vector<unsigned char>& bytes) {
    constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
        const unsigned word = static_cast<unsigned>(bytes[i] << 16) |
                              (left > 1 ? static_cast<unsigned>(bytes[i + 1] << 8) : 0u) |
                              (left > 2 ? bytes[i + 2] : 0u);
        text += kLetters[word >> 18];
        text += kLetters[(word >> 12) & 63u];
        text += left > 1 ? kLetters[(word >> 6) & 63u] : '=';
        text += left > 2 ? kLetters[word & 63u] : '=';
    }
    return text;
}

}  // namespace throng::analysis
