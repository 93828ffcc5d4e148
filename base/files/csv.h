// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace throng {

/// In quotes, with the quotes in it doubled: as CSV and SQL want it.
inline std::string inQuotes(const std::string& text) {
    std::string result = "\"";
    for (const char letter : text) {
        if (letter == '"') result += '"';
        result += letter;
    }
    return result + '"';
}

/// Whether a spreadsheet would take the text, without the apostrophes before it, for a formula.
inline bool looksLikeFormula(const std::string& text) {
    const std::size_t first = text.find_first_not_of('\'');
    if (first == std::string::npos ||
        std::string_view("=+-@\t\r").find(text[first]) == std::string_view::npos)
        return false;
    double number = 0.0;  // numbers are only numbers
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error != std::errc() || stop != end;
}

/// A field of comma-separated text, in quotes where it needs them. What a spreadsheet would take for a
/// formula gets an apostrophe before it, as one types it there to mean text; CsvReader takes it away.
inline std::string csvField(const std::string& text) {
    const std::string plain = looksLikeFormula(text) ? "'" + text : text;
    return plain.find_first_of(",\"\r\n") == std::string::npos ? plain : inQuotes(plain);
}

/// Splits comma-separated text with quoted fields (RFC 4180) into records.
class CsvReader {
  public:
    explicit CsvReader(std::string text) : text_(std::move(text)) {}

    /// Takes the next record; false at the end of the text.
    bool next(std::vector<std::string>& fields) {
        fields.clear();
        if (at_ >= text_.size()) return false;
        while (true) {
            fields.push_back(field());
            const char end = at_ < text_.size() ? text_[at_++] : '\n';
            if (end == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
            if (end != ',') return true;
        }
    }

  private:
    std::string field() {
        std::string value;
        bool is_quoted = false;
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '"' && is_quoted && at_ + 1 < text_.size() && text_[at_ + 1] == '"')
                value += text_[++at_];
            else if (c == '"')
                is_quoted = !is_quoted;
            else if (!is_quoted && (c == ',' || c == '\n' || c == '\r'))
                break;
            else
                value += c;
        }
        if (value.starts_with('\'') && looksLikeFormula(value.substr(1))) value.erase(0, 1);
        return value;
    }

    std::string text_;
    std::size_t at_ = 0;
};

}  // namespace throng
