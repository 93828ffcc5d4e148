// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "authoring/layout/json_document.h"
#include "authoring/layout/schema.h"
#include "authoring/layout/words.h"

namespace throng::authoring {

/// The schema's words, and what each stands for.
template <class Value>
using Meanings = std::vector<std::pair<std::string_view, Value>>;

/// A number within its limits; anything else is an error.
std::optional<double> numberOf(const JsonNode& node, Limits limits, Diagnostics& diagnostics);

/// By id, which of its kind an object is.
using Indices = std::map<std::string, std::size_t>;

/// Keeps under which index an object is found by its id; tells of one that is taken already.
/// @param kind "a road", for messages
void claimId(const JsonNode& node, const std::string& id, Indices& ids, std::size_t index, const char* kind,
             Diagnostics& diagnostics);

/// The ids of such objects, to tell which one was probably meant.
std::vector<std::string> namesOf(const Indices& ids);

/// Reads the members of one object, telling every mistake and going on. What a member has to be like is what
/// the schema says of its key. A value that is handed in to be read is what holds where nothing is written:
/// the schema has to say the same. Keys, words and defaults on which the two differ are mistakes in the code:
/// std::logic_error.
/// Call the getters for all known keys, then finish(), which complains about the rest.
class ObjectReader {
  public:
    /// @param what "a road", for messages; a node that is no object is an error
    ObjectReader(const JsonNode& node, SchemaRule rule, std::string what, Diagnostics& diagnostics);

    bool isObject() const { return is_object_; }
    const SourcePosition& where() const { return node_.where; }
    SchemaRule rule(const std::string& key) const { return rule_.property(key); }

    /// The member, marked as known; null when absent.
    const JsonNode* get(const std::string& key);
    /// The same; absence is an error.
    const JsonNode* require(const std::string& key, const char* meaning);

    void number(const std::string& key, double& value);
    /// A number that need not be there.
    void number(const std::string& key, std::optional<double>& value);
    void integer(const std::string& key, std::uint64_t& value);
    void integer(const std::string& key, int& value);
    void boolean(const std::string& key, bool& value);
    void text(const std::string& key, std::string& value);
    void requiredText(const std::string& key, const char* meaning, std::string& value);
    void point(const std::string& key, const char* meaning, glm::dvec2& value);
    /// A point that need not be there.
    void point(const std::string& key, std::optional<glm::dvec2>& value);
    void offset(const std::string& key, glm::dvec3& value);
    enum class Repeated { refused, kept };
    /// Points of a line or polygon.
    /// @param least how many where these are more than the schema asks for
    /// @param repeated what becomes of neighbours at the same place
    std::vector<glm::dvec2> points(const std::string& key, std::size_t least = 0,
                                   Repeated repeated = Repeated::refused);
    /// What is in a list, at most as much as the schema allows; null when absent, or an error.
    const std::vector<JsonNode>* items(const std::string& key);
    /// One of the schema's words.
    std::optional<std::string> word(const std::string& key);
    template <class Value>
    void choice(const std::string& key, const Meanings<Value>& meanings, Value& value);

    /// Unknown keys are errors, each with the key that was probably meant.
    void finish();

    /// For readers of what is none of the above: `same` as the schema's default, or a mistake in the code.
    void expectSame(const std::string& key, bool same) const;

  private:
    bool tellMisspelt(const std::string& key);
    std::optional<glm::dvec2> pointOf(const JsonNode& node, SchemaRule rule);
    /// What stands at the key where nothing is written; null where the schema does not say.
    const JsonNode* standardOf(const std::string& key) const { return rule(key).standard(); }
    void expectWords(const std::string& key, const std::vector<std::string_view>& words) const;

    const JsonNode& node_;
    SchemaRule rule_;
    std::string what_;
    Diagnostics& diagnostics_;
    bool is_object_;
    std::vector<std::string> known_;
};

/// Calls read(node) for all that is in a list, if it is there.
template <class Read>
void eachOf(ObjectReader& reader, const std::string& key, Read read) {
    if (const std::vector<JsonNode>* items = reader.items(key))
        for (const JsonNode& item : *items)
            read(item);
}

/// Errors for those of some keys that an object has, and that say nothing beside its others.
/// @param why, hint with {} where the key is named
void refuseKeys(const JsonNode& owner, const std::vector<std::string>& keys, std::string_view why,
                std::string_view hint, Diagnostics& diagnostics);

template <class Value>
void ObjectReader::choice(const std::string& key, const Meanings<Value>& meanings, Value& value) {
    std::vector<std::string_view> words;
    for (const auto& [word, meaning] : meanings)
        words.push_back(word);
    expectWords(key, words);
    const auto meaningOf = [&](std::string_view found) -> Value {
        for (const auto& [word, meaning] : meanings)
            if (word == found) return meaning;
        return value;
    };
    if (const JsonNode* standard = standardOf(key)) expectSame(key, meaningOf(standard->text) == value);
    if (const auto found = word(key)) value = meaningOf(*found);
}

}  // namespace throng::authoring
