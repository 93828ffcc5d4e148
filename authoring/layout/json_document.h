// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "authoring/diagnostics.h"

namespace throng::authoring {

/// A JSON value that remembers where it stood.
struct JsonNode {
    enum class Kind { null, boolean, number, text, array, object };
    struct Member;

    Kind kind = Kind::null;
    bool boolean = false;
    double number = 0.0;
    bool integral = false;  ///< written without a point or an exponent
    std::string text;
    std::vector<JsonNode> items;
    std::vector<Member> members;  ///< in the order of the file
    SourcePosition where;

    const JsonNode* find(std::string_view key) const;
    JsonNode* find(std::string_view key);
    /// "a number", "an object", ...: for messages.
    const char* kindName() const;
};

struct JsonNode::Member {
    std::string key;
    SourcePosition key_where;
    JsonNode value;
};

/// Parses JSON. Syntax errors, keys that occur twice, numbers that are not finite and nesting deeper than 64
/// levels are errors. @returns nothing usable when there are errors
JsonNode parseJson(std::string_view text, Diagnostics& diagnostics);

/// The same without the places. Whole numbers stay whole as far as they are exact.
nlohmann::ordered_json plainJson(const JsonNode& node);

/// Puts `pointer/key` together, escaped as RFC 6901 has it.
std::string appendPointer(const std::string& pointer, std::string_view key);

/// In the path of a value, this word after that of a list and before an id means the item of that id:
/// "/flows/by-id/north/rate". A list has no item of this name, so no path means two things.
constexpr std::string_view kById = "by-id";

/// What is wrong where a list has no item of this id, with those that it has.
std::string noSuchId(std::string_view id, const std::vector<std::string>& known);

/// Changes one value: "simulation.seed=7", "/simulation/seed=7" or "flows.by-id.north.rate=2". Missing keys
/// are added; the reader will judge them.
void applyOverride(JsonNode& root, const std::string& text, Diagnostics& diagnostics);

}  // namespace throng::authoring
