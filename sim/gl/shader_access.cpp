// SPDX-License-Identifier: Apache-2.0
#include "sim/gl/shader_access.h"

#include <algorithm>
#include <cctype>

namespace throng::gl {
namespace {

using Tokens = std::vector<std::string_view>;

/// Words and single signs; comments and lines for the preprocessor are passed over.
class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {}

    /// Empty at the end.
    std::string_view next() {
        while (skipped()) {
        }
        const std::size_t first = at_;
        while (at_ < text_.size() && isOfWord(text_[at_]))
            ++at_;
        if (at_ == first && at_ < text_.size()) ++at_;
        return text_.substr(first, at_ - first);
    }

  private:
    static bool isOfWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

    bool skipped() {
        const std::string_view rest = text_.substr(at_);
        if (rest.starts_with("//")) return skipTo("\n");
        if (rest.starts_with("#")) return skipDirective();
        if (rest.starts_with("/*")) return skipTo("*/");
        if (rest.empty() || !std::isspace(static_cast<unsigned char>(rest.front()))) return false;
        ++at_;
        return true;
    }

    /// It goes on where a line ends in a backslash.
    bool skipDirective() {
        do {
            skipTo("\n");
        } while (at_ >= 2 && text_[at_ - 2] == '\\' && at_ < text_.size());
        return true;
    }

    bool skipTo(std::string_view end) {
        const std::size_t found = text_.find(end, at_);
        at_ = found == std::string_view::npos ? text_.size() : found + end.size();
        return true;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

bool has(const Tokens& tokens, std::string_view word) {
    return std::find(tokens.begin(), tokens.end(), word) != tokens.end();
}

Access qualified(std::string_view name, const Tokens& tokens, bool writable) {
    return {std::string(name), !has(tokens, "writeonly"), writable && !has(tokens, "readonly")};
}

/// `layout(...) readonly buffer Name` or `uniform Name`, as it stands before a brace.
void addBlock(const Tokens& tokens, std::vector<Access>& found) {
    if (tokens.size() < 2 || (!has(tokens, "buffer") && !has(tokens, "uniform"))) return;
    addAccess(found, qualified(tokens.back(), tokens, has(tokens, "buffer")));
}

/// `uniform usamplerBuffer name, other[2]`: whatever follows the type and is neither a sign nor a number.
void addSamplers(const Tokens& tokens, std::vector<Access>& found) {
    const auto isType = [](std::string_view word) {
        return word.find("sampler") != std::string_view::npos || word.find("image") != std::string_view::npos;
    };
    const auto type = std::find_if(tokens.begin(), tokens.end(), isType);
    if (!has(tokens, "uniform") || type == tokens.end()) return;
    const bool writable = type->find("image") != std::string_view::npos;
    for (auto word = std::next(type); word != tokens.end(); ++word)
        if (std::isalpha(static_cast<unsigned char>(word->front())))
            addAccess(found, qualified(*word, tokens, writable));
}

}  // namespace

void addAccess(std::vector<Access>& known, const Access& more) {
    const auto same = std::find_if(known.begin(), known.end(),
                                   [&](const Access& access) { return access.name == more.name; });
    if (same == known.end()) {
        known.push_back(more);
        return;
    }
    same->reads |= more.reads;
    same->writes |= more.writes;
}

std::vector<Access> accessIn(std::string_view source) {
    std::vector<Access> found;
    Scanner scanner(source);
    Tokens declaration;  // what stands outside braces, parentheses and brackets, since the last one ended
    int braces = 0, inner = 0;
    for (std::string_view token = scanner.next(); !token.empty(); token = scanner.next()) {
        if (token == "{" && braces++ == 0) addBlock(declaration, found);
        if (token == ";" && braces == 0) addSamplers(declaration, found);
        if (token == "}") --braces;
        if (token == "(" || token == "[") ++inner;
        if (token == ")" || token == "]") --inner;
        if (token == ";" || token == "{" || token == "}")
            declaration.clear();
        else if (braces == 0 && inner == 0 && token != ")" && token != "]")
            declaration.push_back(token);
    }
    return found;
}

}  // namespace throng::gl
