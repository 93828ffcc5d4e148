// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/schema.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace throng::authoring {
namespace {

constexpr std::string_view kDefinitions = "#/definitions/";

}  // namespace

const JsonNode& SchemaRule::followed(const JsonNode& node) const {
    const JsonNode* reference = node.find("$ref");
    if (!reference) return node;
    const std::string_view target = reference->text;
    const JsonNode* definitions = root_->find("definitions");
    const JsonNode* found = definitions && target.starts_with(kDefinitions)
                                ? definitions->find(target.substr(kDefinitions.size()))
                                : nullptr;
    if (!found) throw std::logic_error(fmt::format("the schema has nothing at {}", target));
    return *found;
}

template <class Find>
const JsonNode* SchemaRule::search(const JsonNode& node, Find find) const {
    const JsonNode& here = followed(node);
    if (const JsonNode* found = find(here)) return found;
    for (const char* several : {"oneOf", "allOf"})
        if (const JsonNode* rules = here.find(several))
            for (const JsonNode& each : rules->items)
                if (const JsonNode* found = search(each, find)) return found;
    return nullptr;
}

const JsonNode* SchemaRule::keyword(std::string_view name) const {
    return search(*node_, [&](const JsonNode& here) { return here.find(name); });
}

const JsonNode& SchemaRule::needed(std::string_view name) const {
    const JsonNode* found = keyword(name);
    if (!found)
        throw std::logic_error(fmt::format("the schema has no `{}` at {}", name, node_->where.pointer()));
    return *found;
}

SchemaRule SchemaRule::property(std::string_view key) const {
    const JsonNode* found = search(*node_, [&](const JsonNode& here) {
        const JsonNode* properties = here.find("properties");
        const JsonNode* property = properties ? properties->find(key) : nullptr;
        const JsonNode* others = here.find("additionalProperties");
        return property || !others || others->kind != JsonNode::Kind::object ? property : others;
    });
    if (!found)
        throw std::logic_error(fmt::format("the schema has no key `{}` at {}", key, node_->where.pointer()));
    return {*found, *root_};
}

std::vector<std::string> SchemaRule::keys() const {
    std::vector<std::string> result;
    for (const JsonNode::Member& member : needed("properties").members)
        result.push_back(member.key);
    return result;
}

SchemaRule SchemaRule::item(std::size_t index) const {
    const JsonNode& items = needed("items");
    if (items.kind != JsonNode::Kind::array) return {items, *root_};
    if (index >= items.items.size())
        throw std::logic_error(fmt::format("the schema has no item {} at {}", index, node_->where.pointer()));
    return {items.items[index], *root_};
}

std::size_t SchemaRule::leastItems() const {
    return static_cast<std::size_t>(needed("minItems").number);
}

std::size_t SchemaRule::mostItems() const {
    return static_cast<std::size_t>(needed("maxItems").number);
}

std::size_t SchemaRule::mostOf(std::string_view name) const {
    const JsonNode* found = keyword(name);
    return found ? static_cast<std::size_t>(found->number) : std::numeric_limits<std::size_t>::max();
}

Limits SchemaRule::limits() const {
    const JsonNode* above = keyword("exclusiveMinimum");
    return {above ? above->number : needed("minimum").number, needed("maximum").number, above != nullptr};
}

std::vector<std::string> SchemaRule::words() const {
    std::vector<std::string> result;
    for (const JsonNode& word : needed("enum").items)
        result.push_back(word.text);
    return result;
}

const JsonNode& SchemaRule::remark(std::string_view name) const {
    return needed(name);
}

bool SchemaRule::refersTo(std::string_view definition) const {
    const JsonNode* reference = node_->find("$ref");
    return reference && reference->text == std::string(kDefinitions) + std::string(definition);
}

Schema::Schema(std::string_view text) {
    Diagnostics diagnostics;
    root_ = parseJson(text, diagnostics);
    if (diagnostics.hasErrors())
        throw std::logic_error("the schema is no JSON: " + diagnostics.entries.front().message);
}

SchemaRule Schema::definition(std::string_view name) const {
    const JsonNode* definitions = root_.find("definitions");
    const JsonNode* found = definitions ? definitions->find(name) : nullptr;
    if (!found) throw std::logic_error(fmt::format("the schema defines no {}", name));
    return {*found, root_};
}

}  // namespace throng::authoring
