// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/object_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace throng::authoring {
namespace {

std::string rangeText(Limits limits) {
    if (limits.most >= 1.0e15)
        return fmt::format("{} {:.15g}", limits.above_least ? "more than" : "at least", limits.least);
    return fmt::format("{} {:.15g} and at most {:.15g}", limits.above_least ? "more than" : "at least",
                       limits.least, limits.most);
}

bool within(double value, Limits limits) {
    return value <= limits.most && (limits.above_least ? value > limits.least : value >= limits.least);
}

}  // namespace

ObjectReader::ObjectReader(const JsonNode& node, std::string what, Diagnostics& diagnostics)
    : node_(node),
      what_(std::move(what)),
      diagnostics_(diagnostics),
      is_object_(node.kind == JsonNode::Kind::object) {
    if (!is_object_)
        diagnostics_.error(node.where,
                           fmt::format("expected {} (an object), found {}", what_, node.kindName()));
}

const JsonNode* ObjectReader::get(const std::string& key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
    return node_.find(key);
}

const JsonNode* ObjectReader::require(const std::string& key, const char* meaning) {
    const JsonNode* found = get(key);
    if (!found && is_object_)
        diagnostics_.error(node_.where, fmt::format("{} needs `{}` ({})", what_, key, meaning));
    return found;
}

std::optional<double> ObjectReader::numberOf(const JsonNode& node, Limits limits) {
    if (node.kind != JsonNode::Kind::number) {
        diagnostics_.error(node.where, fmt::format("expected a number, found {}", node.kindName()),
                           node.kind == JsonNode::Kind::text ? "numbers are written without quotes" : "");
        return std::nullopt;
    }
    if (!std::isfinite(node.number)) return std::nullopt;  // already told
    if (!within(node.number, limits)) {
        diagnostics_.error(
            node.where, fmt::format("{:.15g} is out of range: expected {}", node.number, rangeText(limits)));
        return std::nullopt;
    }
    return node.number;
}

void ObjectReader::number(const std::string& key, Limits limits, double& value) {
    if (const JsonNode* node = get(key)) value = numberOf(*node, limits).value_or(value);
}

void ObjectReader::integer(const std::string& key, Limits limits, std::uint64_t& value) {
    const JsonNode* node = get(key);
    if (!node) return;
    const std::optional<double> found = numberOf(*node, limits);
    if (!found) return;
    if (*found != std::floor(*found)) {
        diagnostics_.error(node->where, fmt::format("expected a whole number, found {:.15g}", *found));
        return;
    }
    value = static_cast<std::uint64_t>(*found);
}

void ObjectReader::integer(const std::string& key, Limits limits, int& value) {
    auto wide = static_cast<std::uint64_t>(value);
    integer(key, limits, wide);
    value = static_cast<int>(wide);
}

void ObjectReader::boolean(const std::string& key, bool& value) {
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
    else
        value = node->text;
}

void ObjectReader::requiredText(const std::string& key, const char* meaning, std::string& value) {
    const JsonNode* node = require(key, meaning);
    text(key, value);
    if (node && node->kind == JsonNode::Kind::text && value.empty())
        diagnostics_.error(node->where, fmt::format("`{}` is empty", key));
}

std::optional<glm::dvec2> ObjectReader::pointOf(const JsonNode& node) {
    if (node.kind != JsonNode::Kind::array || node.items.size() != 2) {
        diagnostics_.error(node.where, fmt::format("expected a point [x, y] in metres, found {}",
                                                   node.kind == JsonNode::Kind::array
                                                       ? fmt::format("an array of {}", node.items.size())
                                                       : std::string(node.kindName())));
        return std::nullopt;
    }
    const std::optional<double> x = numberOf(node.items[0], {-1.0e8, 1.0e8});
    const std::optional<double> y = numberOf(node.items[1], {-1.0e8, 1.0e8});
    if (!x || !y) return std::nullopt;
    return glm::dvec2(*x, *y);
}

void ObjectReader::point(const std::string& key, const char* meaning, glm::dvec2& value) {
    if (const JsonNode* node = require(key, meaning)) value = pointOf(*node).value_or(value);
}

std::vector<glm::dvec2> ObjectReader::points(const std::string& key, std::size_t least) {
    std::vector<glm::dvec2> result;
    const JsonNode* node = require(key, "points [x, y] in metres");
    if (!node) return result;
    if (node->kind != JsonNode::Kind::array) {
        diagnostics_.error(node->where,
                           fmt::format("expected an array of points, found {}", node->kindName()));
        return result;
    }
    if (node->items.size() < least)
        diagnostics_.error(node->where,
                           fmt::format("expected at least {} points, found {}", least, node->items.size()));
    for (const JsonNode& item : node->items) {
        const std::optional<glm::dvec2> point = pointOf(item);
        if (!point) continue;
        if (!result.empty() && result.back() == *point)
            diagnostics_.error(item.where,
                               fmt::format("the point [{:.15g}, {:.15g}] is repeated", point->x, point->y),
                               "remove one of them");
        result.push_back(*point);
    }
    return result;
}

std::optional<std::size_t> ObjectReader::choice(const std::string& key,
                                                const std::vector<std::string>& choices) {
    const JsonNode* node = get(key);
    if (!node) return std::nullopt;
    if (node->kind == JsonNode::Kind::text)
        for (std::size_t i = 0; i < choices.size(); ++i)
            if (choices[i] == node->text) return i;
    diagnostics_.error(
        node->where,
        fmt::format("expected one of {}, found {}", fmt::join(choices, ", "),
                    node->kind == JsonNode::Kind::text ? "`" + node->text + "`" : node->kindName()),
        node->kind == JsonNode::Kind::text ? hintFor(node->text, choices) : "");
    return std::nullopt;
}

void ObjectReader::finish() {
    for (const JsonNode::Member& member : node_.members)
        if (std::find(known_.begin(), known_.end(), member.key) == known_.end())
            diagnostics_.error(member.key_where, fmt::format("{} has no key `{}`", what_, member.key),
                               hintFor(member.key, known_));
}

}  // namespace throng::authoring
