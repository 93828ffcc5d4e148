// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/object_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace throng::authoring {
namespace {

std::string rangeText(Limits limits) {
    if (limits.most >= 1.0e15)
        return fmt::format("{} {:.15g}", limits.above_least ? "more than" : "at least", limits.least);
    return fmt::format("{} {:.15g} and at most {:.15g}", limits.above_least ? "more than" : "at least",
                       limits.least, limits.most);
}

std::size_t lettersOf(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count_if(
        text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0u) != 0x80u; }));
}

bool within(double value, Limits limits) {
    return value <= limits.most && (limits.above_least ? value > limits.least : value >= limits.least);
}

}  // namespace

std::optional<double> numberOf(const JsonNode& node, Limits limits, Diagnostics& diagnostics) {
    if (node.kind != JsonNode::Kind::number) {
        diagnostics.error(node.where, fmt::format("expected a number, found {}", node.kindName()),
                          node.kind == JsonNode::Kind::text ? "numbers are written without quotes" : "");
        return std::nullopt;
    }
    if (!std::isfinite(node.number)) return std::nullopt;  // already told
    if (!within(node.number, limits)) {
        diagnostics.error(
            node.where, fmt::format("{:.15g} is out of range: expected {}", node.number, rangeText(limits)));
        return std::nullopt;
    }
    return node.number;
}

void claimId(const JsonNode& node, const std::string& id, Indices& ids, std::size_t index, const char* kind,
             Diagnostics& diagnostics) {
    if (id.empty()) return;
    const JsonNode* where = node.find("id");
    if (!ids.emplace(id, index).second && where)
        diagnostics.error(where->where, fmt::format("there already is {} `{}`", kind, id),
                          "ids have to differ");
}

std::vector<std::string> namesOf(const Indices& ids) {
    std::vector<std::string> names;
    names.reserve(ids.size());
    for (const auto& [id, index] : ids)
        names.push_back(id);
    return names;
}

ObjectReader::ObjectReader(const JsonNode& node, SchemaRule rule, std::string what, Diagnostics& diagnostics)
    : node_(node),
      rule_(rule),
      what_(std::move(what)),
      diagnostics_(diagnostics),
      is_object_(node.kind == JsonNode::Kind::object) {
    if (!is_object_)
        diagnostics_.error(node.where,
                           fmt::format("expected {} (an object), found {}", what_, node.kindName()));
}

const JsonNode* ObjectReader::get(const std::string& key) {
    static_cast<void>(rule(key));  // which there has to be
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
    return node_.find(key);
}

const JsonNode* ObjectReader::require(const std::string& key, const char* meaning) {
    const JsonNode* found = get(key);
    if (!found && is_object_ && !tellMisspelt(key))
        diagnostics_.error(node_.where, fmt::format("{} needs `{}` ({})", what_, key, meaning));
    return found;
}

/// A key that is there in other letters is one mistake, not one that is missing and one too many.
bool ObjectReader::tellMisspelt(const std::string& key) {
    const std::vector<std::string> keys = rule_.keys();
    for (const JsonNode::Member& member : node_.members) {
        if (std::ranges::find(keys, member.key) != keys.end()) continue;
        if (std::ranges::find(known_, member.key) != known_.end()) continue;
        if (nearestWord(member.key, keys) != key) continue;
        diagnostics_.error(member.key_where, fmt::format("{} has no key `{}`", what_, member.key),
                           fmt::format("did you mean `{}`?", key));
        known_.push_back(member.key);
        return true;
    }
    return false;
}

void ObjectReader::expectSame(const std::string& key, bool same) const {
    if (!same)
        throw std::logic_error(fmt::format("the default of `{}` of {} is not the schema's", key, what_));
}

void ObjectReader::expectWords(const std::string& key, const std::vector<std::string_view>& words) const {
    const std::vector<std::string> known = rule(key).words();
    if (!std::is_permutation(known.begin(), known.end(), words.begin(), words.end()))
        throw std::logic_error(fmt::format("the words of `{}` of {} are not the schema's", key, what_));
}

void ObjectReader::number(const std::string& key, double& value) {
    if (const JsonNode* standard = standardOf(key)) expectSame(key, standard->number == value);
    if (const JsonNode* node = get(key))
        value = numberOf(*node, rule(key).limits(), diagnostics_).value_or(value);
}

void ObjectReader::number(const std::string& key, std::optional<double>& value) {
    const Limits limits = rule(key).limits();
    if (const JsonNode* node = get(key)) value = numberOf(*node, limits, diagnostics_);
}

void ObjectReader::integer(const std::string& key, std::uint64_t& value) {
    if (const JsonNode* standard = standardOf(key))
        expectSame(key, standard->number == static_cast<double>(value));
    const JsonNode* node = get(key);
    if (!node) return;
    const std::optional<double> found = numberOf(*node, rule(key).limits(), diagnostics_);
    if (!found) return;
    if (*found != std::floor(*found)) {
        diagnostics_.error(node->where, fmt::format("expected a whole number, found {:.15g}", *found));
        return;
    }
    value = static_cast<std::uint64_t>(*found);
}

void ObjectReader::integer(const std::string& key, int& value) {
    auto wide = static_cast<std::uint64_t>(value);
    integer(key, wide);
    value = static_cast<int>(wide);
}

void ObjectReader::boolean(const std::string& key, bool& value) {
    if (const JsonNode* standard = standardOf(key)) expectSame(key, standard->boolean == value);
    const JsonNode* node = get(key);
    if (!node) return;
    if (node->kind != JsonNode::Kind::boolean)
        diagnostics_.error(node->where, fmt::format("expected true or false, found {}", node->kindName()));
    else
        value = node->boolean;
}

void ObjectReader::text(const std::string& key, std::string& value) {
    const JsonNode* node = get(key);
    if (!node) return;
    if (node->kind != JsonNode::Kind::text)
        diagnostics_.error(node->where, fmt::format("expected a string, found {}", node->kindName()));
    else if (const std::size_t most = rule(key).mostOf("maxLength"); lettersOf(node->text) > most)
        diagnostics_.error(node->where, fmt::format("`{}` is longer than {} letters", key, most));
    else
        value = node->text;
}

void ObjectReader::requiredText(const std::string& key, const char* meaning, std::string& value) {
    const JsonNode* node = require(key, meaning);
    text(key, value);
    if (node && node->kind == JsonNode::Kind::text && node->text.empty())
        diagnostics_.error(node->where, fmt::format("`{}` is empty", key));
}

std::optional<glm::dvec2> ObjectReader::pointOf(const JsonNode& node, SchemaRule rule) {
    if (node.kind != JsonNode::Kind::array || node.items.size() != 2) {
        diagnostics_.error(node.where, fmt::format("expected a point [x, y] in metres, found {}",
                                                   node.kind == JsonNode::Kind::array
                                                       ? fmt::format("an array of {}", node.items.size())
                                                       : std::string(node.kindName())));
        return std::nullopt;
    }
    const Limits limits = rule.item().limits();
    const std::optional<double> x = numberOf(node.items[0], limits, diagnostics_);
    const std::optional<double> y = numberOf(node.items[1], limits, diagnostics_);
    if (!x || !y) return std::nullopt;
    return glm::dvec2(*x, *y);
}

void ObjectReader::point(const std::string& key, const char* meaning, glm::dvec2& value) {
    const SchemaRule rule_of_key = rule(key);
    if (const JsonNode* node = require(key, meaning)) value = pointOf(*node, rule_of_key).value_or(value);
}

void ObjectReader::point(const std::string& key, std::optional<glm::dvec2>& value) {
    const SchemaRule rule_of_key = rule(key);
    if (const JsonNode* node = get(key)) value = pointOf(*node, rule_of_key);
}

void ObjectReader::offset(const std::string& key, glm::dvec3& value) {
    if (const JsonNode* standard = standardOf(key))
        for (int i = 0; i < 3; ++i)
            expectSame(key, standard->items.at(static_cast<std::size_t>(i)).number == value[i]);
    const JsonNode* node = get(key);
    if (!node) return;
    if (node->kind != JsonNode::Kind::array || node->items.size() != 3) {
        diagnostics_.error(node->where, fmt::format("expected an offset [x, y, z] in metres, found {}",
                                                    node->kind == JsonNode::Kind::array
                                                        ? fmt::format("an array of {}", node->items.size())
                                                        : std::string(node->kindName())));
        return;
    }
    const Limits limits = rule(key).item().limits();
    for (int i = 0; i < 3; ++i)
        value[i] = numberOf(node->items[static_cast<std::size_t>(i)], limits, diagnostics_).value_or(0.0);
}

std::vector<glm::dvec2> ObjectReader::points(const std::string& key, std::size_t least, Repeated repeated) {
    const SchemaRule rule_of_key = rule(key);
    const SchemaRule rule_of_item = rule_of_key.item();
    least = std::max(least, rule_of_key.leastItems());
    std::vector<glm::dvec2> result;
    const JsonNode* node = require(key, "points [x, y] in metres");
    if (!node) return result;
    if (node->kind != JsonNode::Kind::array) {
        diagnostics_.error(node->where,
                           fmt::format("expected an array of points, found {}", node->kindName()));
        return result;
    }
    // Of lines of two points and the like, the readers say in their own words what they are.
    if (const std::size_t most = rule_of_key.mostOf("maxItems"); most > 4 && node->items.size() > most) {
        diagnostics_.error(node->where,
                           fmt::format("expected at most {} points, found {}", most, node->items.size()),
                           "leave out points that nobody sees, or cut it into several");
        return result;
    }
    if (node->items.size() < least)
        diagnostics_.error(node->where,
                           fmt::format("expected at least {} points, found {}", least, node->items.size()));
    for (const JsonNode& item : node->items) {
        const std::optional<glm::dvec2> point = pointOf(item, rule_of_item);
        if (!point) continue;
        if (repeated == Repeated::refused && !result.empty() && result.back() == *point)
            diagnostics_.error(item.where,
                               fmt::format("the point [{:.15g}, {:.15g}] is repeated", point->x, point->y),
                               "remove one of them");
        result.push_back(*point);
    }
    return result;
}

std::optional<std::string> ObjectReader::word(const std::string& key) {
    const std::vector<std::string> words = rule(key).words();
    const JsonNode* node = get(key);
    if (!node) return std::nullopt;
    const bool is_text = node->kind == JsonNode::Kind::text;
    if (is_text && std::find(words.begin(), words.end(), node->text) != words.end()) return node->text;
    diagnostics_.error(node->where,
                       fmt::format("expected one of {}, found {}", fmt::join(words, ", "),
                                   is_text ? "`" + node->text + "`" : node->kindName()),
                       is_text ? hintFor(node->text, words) : "");
    return std::nullopt;
}

const std::vector<JsonNode>* ObjectReader::items(const std::string& key) {
    const JsonNode* list = get(key);
    if (!list) return nullptr;
    if (list->kind != JsonNode::Kind::array) {
        diagnostics_.error(list->where,
                           fmt::format("expected an array of {}, found {}", key, list->kindName()));
        return nullptr;
    }
    if (const std::size_t most = rule(key).mostOf("maxItems"); list->items.size() > most) {
        diagnostics_.error(list->where, fmt::format("there are {} {}, more than the {} that can be",
                                                    list->items.size(), key, most));
        return nullptr;
    }
    return &list->items;
}

void refuseKeys(const JsonNode& owner, const std::vector<std::string>& keys, std::string_view why,
                std::string_view hint, Diagnostics& diagnostics) {
    for (const std::string& key : keys)
        if (const JsonNode* found = owner.find(key))
            diagnostics.error(found->where, fmt::format(fmt::runtime(why), key),
                              fmt::format(fmt::runtime(hint), key));
}

void ObjectReader::finish() {
    for (const JsonNode::Member& member : node_.members)
        if (std::find(known_.begin(), known_.end(), member.key) == known_.end())
            diagnostics_.error(member.key_where, fmt::format("{} has no key `{}`", what_, member.key),
                               hintFor(member.key, known_));
}

}  // namespace throng::authoring
