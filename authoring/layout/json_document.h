// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
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

/// Puts `pointer/key` together, escaped as RFC 6901 has it.
std::string appendPointer(const std::string& pointer, std::string_view key);

/// Changes one value: "simulation.seed=7" or "/simulation/seed=7". Missing keys are added; the reader will
/// judge them.
void applyOverride(JsonNode& root, const std::string& text, Diagnostics& diagnostics);

}  // namespace throng::authoring
