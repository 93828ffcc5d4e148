// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "authoring/layout/json_document.h"

namespace throng::authoring {

/// What a number has to lie within.
struct Limits {
    double least;
    double most;
    bool above_least = false;  ///< the least itself is not allowed
};

/// What a schema says about one value, and the way to what it says about the values inside. References are
/// followed; of a value that may be one of several things, whichever of them has what is asked for answers.
/// Lives as long as its schema. Whoever asks for what the schema does not say is mistaken in the code, not in
/// a layout: std::logic_error.
class SchemaRule {
  public:
    /// A key of an object.
    SchemaRule property(std::string_view key) const;
    std::vector<std::string> keys() const;
    /// An item of an array.
    SchemaRule item(std::size_t index = 0) const;
    std::size_t leastItems() const;
    std::size_t mostItems() const;
    /// Items of an array or letters of a text, as `maxItems` or `maxLength` say; as many as one likes
    /// without.
    std::size_t mostOf(std::string_view name) const;
    /// Of a number.
    Limits limits() const;
    /// The words that a string may be.
    std::vector<std::string> words() const;
    /// What holds where nothing is written; null where the schema does not say.
    const JsonNode* standard() const { return node_->find("default"); }
    /// A remark of ours: a keyword that begins with x- and that schemas know nothing about.
    const JsonNode& remark(std::string_view name) const;
    bool refersTo(std::string_view definition) const;

  private:
    friend class Schema;
    SchemaRule(const JsonNode& node, const JsonNode& root) : node_(&node), root_(&root) {}
    const JsonNode& followed(const JsonNode& node) const;
    template <class Find>
    const JsonNode* search(const JsonNode& node, Find find) const;
    const JsonNode* keyword(std::string_view name) const;
    const JsonNode& needed(std::string_view name) const;

    const JsonNode* node_;
    const JsonNode* root_;
};

/// A JSON Schema (draft-07) that readers take limits, words and counts from.
class Schema {
  public:
    /// @throws std::logic_error for what is no JSON
    explicit Schema(std::string_view text);
    SchemaRule rule() const { return {root_, root_}; }
    SchemaRule definition(std::string_view name) const;

  private:
    JsonNode root_;
};

}  // namespace throng::authoring
