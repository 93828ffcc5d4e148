// SPDX-License-Identifier: Apache-2.0
#include "base/text/printable.h"

#include <fmt/format.h>

#include <cstdint>

namespace throng {
namespace {

struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 0;  ///< 0: this is no UTF-8
};

/// The first one of a text that is not empty (RFC 3629: neither longer than needed nor a surrogate).
Character firstOf(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
    };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0xffu >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0u) != 0x80u) return {};
        code = code << 6 | (byte(i) & 0x3fu);
    }
    constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool sound = code >= kLeast[bytes] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
    return sound ? Character{code, bytes} : Character{};
}

bool isControl(std::uint32_t code) {
    const bool turns = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
    return code < 0x20 || (code >= 0x7f && code <= 0x9f) || turns || code == 0x2028 || code == 0x2029;
}

}  // namespace

std::string printable(std::string_view text, bool lines) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const Character first = firstOf(text);
        const std::size_t bytes = first.bytes ? first.bytes : 1;
        if (!first.bytes)
            result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
        else if (lines && (first.code == '\n' || first.code == '\t'))
            result += text[0];
        else if (isControl(first.code))
            result += first.code > 0xff ? fmt::format("\\u{:04x}", first.code)
                                        : fmt::format("\\x{:02x}", first.code);
        else
            result += text.substr(0, bytes);
        text.remove_prefix(bytes);
    }
    return result;
}

std::string shortened(std::string text) {
    constexpr std::size_t kLongest = 600;  // bytes
    if (text.size() <= kLongest) return text;
    std::size_t end = kLongest;
    while ((static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u)
        --end;  // no character is cut in two
    return text.substr(0, end) + "...";
}

bool isFileName(std::string_view name) {
    constexpr std::size_t kLongest = 200;  // bytes: the 255 of file systems, less what is put behind it
    return !name.empty() && name.size() <= kLongest && name != "." && name != ".." &&
           name.find('/') == std::string_view::npos && printable(name) == name;
}

}  // namespace throng
