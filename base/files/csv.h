// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
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

/// A field of comma-separated text, in quotes where it needs them.
inline std::string csvField(const std::string& text) {
    return text.find_first_of(",\"\r\n") == std::string::npos ? text : inQuotes(text);
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
        return value;
    }

    std::string text_;
    std::size_t at_ = 0;
};

}  // namespace throng
