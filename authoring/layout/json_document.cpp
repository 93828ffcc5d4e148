// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/json_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/json_shape.h"

namespace throng::authoring {
namespace {

constexpr std::size_t kMostValues = 1'000'000;

/// Where the parser has read to: where a syntax error is.
struct Cursor {
    int line = 1;
    int column = 0;  // of the character read last
};

/// Feeds bytes to nlohmann's parser and moves the cursor along.
class TrackingIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    TrackingIterator(const char* at, Cursor* cursor) : at_(at), cursor_(cursor) {}
    reference operator*() const { return *at_; }
    TrackingIterator& operator++() {
        const char byte = *at_++;
        if (byte == '\n') {
            ++cursor_->line;
            cursor_->column = 0;
        } else if ((static_cast<unsigned char>(byte) & 0xc0u) != 0x80u) {
            ++cursor_->column;  // a character, not a byte: continuation bytes do not count
        }
        return *this;
    }
    TrackingIterator operator++(int) {
        TrackingIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const TrackingIterator& other) const { return at_ == other.at_; }
    bool operator!=(const TrackingIterator& other) const { return at_ != other.at_; }

  private:
    const char* at_;
    Cursor* cursor_;
};

/// Where every value and key begins, in the order in which the parser reports them. nlohmann's events come
/// after the token was read, so its beginning is found by a second, trivial scan over the text that only
/// knows tokens.
class TokenScanner {
  public:
    explicit TokenScanner(std::string_view text) : text_(text) {}

    /// The position of the next token that is a value, a key, or an opening bracket.
    SourcePosition next() {
        skipSeparators();
        SourcePosition where{line_, column_, {}};
        skipToken();
        return where;
    }
    /// Closing brackets are not reported, but have to be passed.
    void close() {
        skipSeparators();
        advance();
    }

  private:
    void advance() {
        if (at_ >= text_.size()) return;
        const char byte = text_[at_++];
        if (byte == '\n') {
            ++line_;
            column_ = 1;
        } else if ((static_cast<unsigned char>(byte) & 0xc0u) != 0x80u) {
            ++column_;
        }
    }
    void skipSeparators() {
        if (at_ == 0 && text_.starts_with("\xef\xbb\xbf")) at_ = 3;
        while (at_ < text_.size() && std::string_view(" \t\r\n,:").find(text_[at_]) != std::string_view::npos)
            advance();
    }
    void skipToken() {
        if (at_ >= text_.size()) return;
        const char first = text_[at_];
        if (first == '{' || first == '[') return advance();
        if (first != '"') {
            while (at_ < text_.size() &&
                   std::string_view(" \t\r\n,:]}").find(text_[at_]) == std::string_view::npos)
                advance();
            return;
        }
        advance();
        while (at_ < text_.size() && text_[at_] != '"') {
            if (text_[at_] == '\\') advance();
            advance();
        }
        advance();
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
    int column_ = 1;
};

class Handler : public nlohmann::json_sax<nlohmann::json> {
  public:
    Handler(std::string_view text, const Cursor& cursor, Diagnostics& diagnostics)
        : scanner_(text), cursor_(cursor), diagnostics_(diagnostics) {}

    JsonNode root;

    bool null() override { return value(JsonNode::Kind::null) && !isTooMuch(); }
    bool boolean(bool flag) override {
        value(JsonNode::Kind::boolean)->boolean = flag;
        return !isTooMuch();
    }
    bool number_integer(number_integer_t number) override {
        return numeric(static_cast<double>(number), true);
    }
    bool number_unsigned(number_unsigned_t number) override {
        // A double would round an integer just above 2^53 down to 2^53, which is within the limits of a seed.
        constexpr number_unsigned_t kExact = number_unsigned_t{1} << 53;
        const double rounded = static_cast<double>(number);
        const bool hidden = number > kExact && rounded <= static_cast<double>(kExact);
        return numeric(hidden ? std::nextafter(rounded, HUGE_VAL) : rounded, true);
    }
    bool number_float(number_float_t number, const string_t&) override { return numeric(number, false); }
    bool string(string_t& text) override {
        value(JsonNode::Kind::text)->text = text;
        return !isTooMuch();
    }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(JsonNode::Kind::object); }
    bool start_array(std::size_t) override { return open(JsonNode::Kind::array); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        SourcePosition where = scanner_.next();
        JsonNode& parent = *open_.back();
        where.path = parent.where.path.member(name);
        if (parent.members.size() >= kMostKeys) {
            diagnostics_.error(where, fmt::format("an object has more than {} keys", kMostKeys));
            return false;
        }
        if (parent.find(name))
            diagnostics_.error(where, fmt::format("the key `{}` is here for the second time", name),
                               "keep one of them");
        key_ = name;
        key_where_ = std::move(where);
        return true;
    }
    bool parse_error(std::size_t, const std::string& token,
                     const nlohmann::detail::exception& error) override {
        if (std::string_view(error.what()).find("out_of_range.406") != std::string_view::npos) {
            SourcePosition where = scanner_.next();
            diagnostics_.error(where, fmt::format("the number {} is too large to be finite", token),
                               "numbers are at most about 1.8e308");
            return false;
        }
        // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while ...": the end
        // is what helps.
        std::string what = error.what();
        if (const std::size_t at = what.find("syntax error"); at != std::string::npos) what = what.substr(at);
        diagnostics_.error({cursor_.line, std::max(1, cursor_.column), {}}, what,
                           "check the commas, quotes and brackets just before this place");
        return false;
    }

  private:
    JsonNode* value(JsonNode::Kind kind) {
        SourcePosition where = scanner_.next();
        JsonNode* node = &root;
        if (!open_.empty()) {
            JsonNode& parent = *open_.back();
            if (parent.kind == JsonNode::Kind::object) {
                where.path = key_where_.path;
                parent.members.push_back({key_, key_where_, {}});
                node = &parent.members.back().value;
            } else {
                where.path = parent.where.path.item(parent.items.size());
                node = &parent.items.emplace_back();
            }
        }
        node->kind = kind;
        node->where = std::move(where);
        return node;
    }
    /// Every value takes a hundred times as much memory as it has letters.
    bool isTooMuch() {
        if (++values_ <= kMostValues) return false;
        diagnostics_.error(scanner_.next(), fmt::format("this file holds more than {} values", kMostValues));
        return true;
    }
    bool numeric(double number, bool integral) {
        JsonNode* node = value(JsonNode::Kind::number);
        node->number = number;
        node->integral = integral;
        if (!std::isfinite(number)) diagnostics_.error(node->where, "this number is not finite");
        return !isTooMuch();
    }
    bool open(JsonNode::Kind kind) {
        if (open_.size() >= kMostDepth) {
            diagnostics_.error(scanner_.next(),
                               fmt::format("values are nested more than {} deep", kMostDepth));
            return false;
        }
        open_.push_back(value(kind));
        open_.back()->where.path = open_.back()->where.path.opened();
        return !isTooMuch();
    }
    bool close() {
        scanner_.close();
        open_.pop_back();
        return true;
    }

    TokenScanner scanner_;
    const Cursor& cursor_;
    Diagnostics& diagnostics_;
    // Pointers into the tree stay good: only the innermost open container ever grows.
    std::vector<JsonNode*> open_;
    std::string key_;
    SourcePosition key_where_;
    std::size_t values_ = 0;
};

}  // namespace

const JsonNode* JsonNode::find(std::string_view key) const {
    for (const Member& member : members)
        if (member.key == key) return &member.value;
    return nullptr;
}

JsonNode* JsonNode::find(std::string_view key) {
    return const_cast<JsonNode*>(std::as_const(*this).find(key));
}

const char* JsonNode::kindName() const {
    switch (kind) {
        case Kind::null:
            return "null";
        case Kind::boolean:
            return "true or false";
        case Kind::number:
            return "a number";
        case Kind::text:
            return "a string";
        case Kind::array:
            return "an array";
        case Kind::object:
            return "an object";
    }
    return "a value";
}

nlohmann::ordered_json plainJson(const JsonNode& node) {
    constexpr double kExact = 0x1.0p53;
    switch (node.kind) {
        case JsonNode::Kind::null:
            return nullptr;
        case JsonNode::Kind::boolean:
            return node.boolean;
        case JsonNode::Kind::number:
            if (node.integral && std::abs(node.number) <= kExact)
                return static_cast<std::int64_t>(node.number);
            return node.number;
        case JsonNode::Kind::text:
            return node.text;
        case JsonNode::Kind::array: {
            auto list = nlohmann::ordered_json::array();
            for (const JsonNode& item : node.items)
                list.push_back(plainJson(item));
            return list;
        }
        case JsonNode::Kind::object: {
            auto object = nlohmann::ordered_json::object();
            for (const JsonNode::Member& member : node.members)
                object[member.key] = plainJson(member.value);
            return object;
        }
    }
    return nullptr;
}

std::string appendPointer(const std::string& pointer, std::string_view key) {
    std::string result = pointer + "/";
    for (const char letter : key) {
        if (letter == '~')
            result += "~0";
        else if (letter == '/')
            result += "~1";
        else
            result += letter;
    }
    return result;
}

JsonNode parseJson(std::string_view text, Diagnostics& diagnostics) {
    Cursor cursor;
    Handler handler(text, cursor, diagnostics);
    nlohmann::json::sax_parse(TrackingIterator(text.data(), &cursor),
                              TrackingIterator(text.data() + text.size(), &cursor), &handler);
    return std::move(handler.root);
}

namespace {

/// A word of a JSON pointer as the key that it stands for.
std::string unescaped(const std::string& word) {
    std::string key;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const bool escape =
            word[i] == '~' && i + 1 < word.size() && (word[i + 1] == '0' || word[i + 1] == '1');
        key += !escape ? word[i] : word[++i] == '1' ? '/' : '~';
    }
    return key;
}

/// "simulation.seed" or "/simulation/seed", a key each.
std::vector<std::string> wordsOf(std::string path) {
    const char separator = path.front() == '/' ? '/' : '.';
    if (separator == '/') path.erase(0, 1);
    std::vector<std::string> words;
    for (std::size_t from = 0; from <= path.size();) {
        const std::size_t end = std::min(path.find(separator, from), path.size());
        const std::string word = path.substr(from, end - from);
        words.push_back(separator == '/' ? unescaped(word) : word);
        from = end + 1;
    }
    return words;
}

/// The item at an index.
/// @returns what is wrong, or nothing
std::string goToItem(JsonNode*& list, const std::string& word) {
    std::size_t index = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc() || stop != word.data() + word.size() || index >= list->items.size())
        return fmt::format("`{}` is not one of the {} items at {}", word, list->items.size(),
                           list->where.pointer());
    list = &list->items[index];
    return {};
}

/// The item of an id.
/// @returns what is wrong, or nothing
std::string goToId(JsonNode*& list, const std::string& id) {
    std::vector<std::string> known;
    for (JsonNode& item : list->items) {
        const JsonNode* const its = item.find("id");
        if (!its || its->kind != JsonNode::Kind::text) continue;
        if (its->text == id) {
            list = &item;
            return {};
        }
        known.push_back(its->text);
    }
    return fmt::format("{}: {}", list->where.pointer(), noSuchId(id, known));
}

void goToMember(JsonNode*& object, const std::string& key) {
    JsonNode* member = object->find(key);
    if (!member) {
        const SourcePosition where{0, 0, object->where.path.member(key)};
        object->members.push_back({key, where, {}});
        member = &object->members.back().value;
        member->kind = JsonNode::Kind::object;
        member->where = where;
    }
    object = member;
}

}  // namespace

std::string noSuchId(std::string_view id, const std::vector<std::string>& known) {
    constexpr std::size_t kMostTold = 8;
    std::string told;
    for (std::size_t i = 0; i < std::min(known.size(), kMostTold); ++i)
        told += (i ? ", `" : "`") + known[i] + "`";
    if (known.size() > kMostTold) told += ", ...";
    return fmt::format("nothing in this list has the id `{}`{}", id,
                       told.empty() ? "" : "; there are " + told);
}

void applyOverride(JsonNode& root, const std::string& text, Diagnostics& diagnostics) {
    const std::size_t equals = text.find('=');
    const SourcePosition where{0, 0, SourcePath(fmt::format("--set {}", text))};
    if (equals == std::string::npos || equals == 0) {
        diagnostics.error(where, "an override has the form path=value",
                          "for example --set simulation.seed=7");
        return;
    }
    JsonNode* node = &root;
    SourcePath pointer;
    const std::vector<std::string> words = wordsOf(text.substr(0, equals));
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::string wrong;
        pointer = pointer.member(words[i]);
        if (node->kind == JsonNode::Kind::object) {
            goToMember(node, words[i]);
        } else if (node->kind != JsonNode::Kind::array) {
            wrong =
                fmt::format("{} is {}: there is nothing inside it", node->where.pointer(), node->kindName());
        } else if (words[i] == kById && i + 1 < words.size()) {
            pointer = pointer.member(words[++i]);
            wrong = goToId(node, words[i]);
        } else {
            wrong = goToItem(node, words[i]);
        }
        if (wrong.empty()) continue;
        diagnostics.error(where, wrong);
        return;
    }
    Diagnostics ignored;
    const std::string value_text = text.substr(equals + 1);
    JsonNode value = parseJson(value_text, ignored);
    if (ignored.hasErrors() || value_text.empty()) {
        value = {};
        value.kind = JsonNode::Kind::text;
        value.text = value_text;
    }
    // Positions inside the value would be those of the command line: only the pointer tells.
    const auto relocate = [](auto&& self, JsonNode& at, const SourcePath& to) -> void {
        at.where = {0, 0, to};
        for (std::size_t i = 0; i < at.items.size(); ++i)
            self(self, at.items[i], to.item(i).opened());
        for (JsonNode::Member& member : at.members) {
            member.key_where = {0, 0, to.member(member.key)};
            self(self, member.value, member.key_where.path);
        }
    };
    relocate(relocate, value, pointer);
    *node = std::move(value);
}

}  // namespace throng::authoring
