// SPDX-License-Identifier: Apache-2.0
#include "analysis/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

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

/// What a browser may do with a page (Content Security Policy): run and show what is ours, by its hash, and
/// load nothing. Styles of single elements cannot load anything then.
std::string policyFor(std::string_view kind) {
    const auto hashes = [&](const char* ending) {
        return fmt::format("'sha256-{}' 'sha256-{}'",
                           base64(bytesOf(webFileHash(fmt::format("common.{}", ending)))),
                           base64(bytesOf(webFileHash(fmt::format("{}.{}", kind, ending)))));
    };
    return fmt::format(
        "default-src 'none'; script-src {}; style-src-elem {}; style-src-attr 'unsafe-inline'; base-uri "
        "'none'; "
        "form-action 'none'",
        hashes("js"), hashes("css"));
}

}  // namespace

std::string makePage(std::string_view kind, const std::string& title, const nlohmann::ordered_json& data) {
    std::string page(webFile(fmt::format("{}.html", kind)));
    put(page, "@POLICY@", policyFor(kind));
    put(page, "@STYLE@", webFile("common.css"));
    put(page, "@LOOK@", webFile(fmt::format("{}.css", kind)));
    put(page, "@COMMON@", webFile("common.js"));
    put(page, "@SCRIPT@", webFile(fmt::format("{}.js", kind)));
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
