// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "authoring/layout/json_document.h"
#include "authoring/layout/words.h"

namespace throng::authoring {

/// The limits of a number, as the schema has them.
struct Limits {
    double least;
    double most;
    bool above_least = false;  ///< the least itself is not allowed
};

/// Reads the members of one object, telling every mistake and going on.
/// Call the getters for all known keys, then finish(), which complains about the rest.
class ObjectReader {
  public:
    /// @param what "a road", for messages; a node that is no object is an error
    ObjectReader(const JsonNode& node, std::string what, Diagnostics& diagnostics);

    bool isObject() const { return is_object_; }
    const SourcePosition& where() const { return node_.where; }

    /// The member, marked as known; null when absent.
    const JsonNode* get(const std::string& key);
    /// The same; absence is an error.
    const JsonNode* require(const std::string& key, const char* meaning);

    void number(const std::string& key, Limits limits, double& value);
    void integer(const std::string& key, Limits limits, std::uint64_t& value);
    void integer(const std::string& key, Limits limits, int& value);
    void boolean(const std::string& key, bool& value);
    void text(const std::string& key, std::string& value);
    void requiredText(const std::string& key, const char* meaning, std::string& value);
    void point(const std::string& key, const char* meaning, glm::dvec2& value);
    std::optional<glm::dvec2> pointOf(const JsonNode& node);
    /// Points of a line or polygon; repeated neighbours are an error.
    std::vector<glm::dvec2> points(const std::string& key, std::size_t least);
    std::optional<double> numberOf(const JsonNode& node, Limits limits);
    /// @returns the index into `choices`
    std::optional<std::size_t> choice(const std::string& key, const std::vector<std::string>& choices);

    /// Unknown keys are errors, each with the key that was probably meant.
    void finish();

  private:
    const JsonNode& node_;
    std::string what_;
    Diagnostics& diagnostics_;
    bool is_object_;
    std::vector<std::string> known_;
};

}  // namespace throng::authoring
