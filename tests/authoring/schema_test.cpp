// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/schema.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "authoring/family/family_reader.h"
#include "authoring/layout/layout_reader.h"
#include "authoring/overrides/overrides_reader.h"

namespace throng::authoring {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

/// A schema, documents that together have every kind of object and nothing wrong with them, and who reads
/// them.
struct Format {
    std::string name;
    std::string_view schema;
    std::vector<std::string> documents;
    void (*read)(const std::string& text, const Schema& schema, Diagnostics& diagnostics);
};

std::string layoutNamed(const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(THRONG_TEST_LAYOUTS "/" + name + ".json").rdbuf();
    return text.str();
}

std::vector<Format> formats() {
    return {
        {"Layouts",
         layoutSchema(),
         {layoutNamed("every_object"), layoutNamed("levels"), layoutNamed("seats")},
         [](const std::string& text, const Schema& schema, Diagnostics& diagnostics) {
             readLayout(text, {}, diagnostics, schema);
         }},
        {"Families",
         familySchema(),
         {R"({"throng_family": 1, "sampling": "random", "count": 5, "bake": {},
             "base": {"throng": 1, "formations": [
                 {"id": "c", "type": "circle", "centre": [0, 0], "radius": 5, "count": 6}]},
             "axes": [{"name": "seed", "set": "/simulation/seed", "values": [1, 2], "weights": [1, 2]},
                      {"set": "/simulation/fps", "uniform": [10, 20]},
                      {"set": "/simulation/duration", "normal": [10, 2], "min": 5, "max": 15},
                      {"set": "/simulation/smoothing", "log_normal": [-1, 0.1]}]})",
          R"({"throng_family": 1, "generate": {"kind": "crossing"},
             "axes": [{"parameter": "arms", "range": [3, 5]},
                      {"name": "seed", "parameter": "seed", "formula": "2 * arms", "whole": true}]})",
          R"({"throng_family": 1, "sampling": "random", "count": 5, "generate": {"kind": "crossing"},
             "axes": [{"name": "day", "cases": {"a": {"/simulation/seed": 2}, "b": {}}, "weights": [1, 2]}]})"},
         [](const std::string& text, const Schema& schema, Diagnostics& diagnostics) {
             readFamily(text, ".", diagnostics, schema);
         }},
        {"Overrides",
         overridesSchema(),
         {R"({"throng_overrides": 1, "overrides": [
             {"id": 1, "group": "f", "spawn": {"frame": 0, "position": [0, 0, 0]}, "hide": true,
              "tint": [0, 0, 0], "move": {"by": [1, 0, 0]}, "retime": {"offset": 1}}],
              "layers": [
                {"name": "a", "who": {"everybody": true, "group": "f", "profile": ["p", "q"], "look": "l",
                  "party": [2, 4], "with": {"rows": [0, 3]}, "changed": true,
                  "people": [{"id": 1, "group": "f", "spawn": {"frame": 0, "position": [0, 0, 0]}}],
                  "region": {"polygon": [[0, 0], [1, 0], [1, 1]], "frames": [1, 2]}, "share": {"of": 0.5},
                  "seen": {"views": [{"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "size": [1, 1],
                                      "shift": [0, 0]}]},
                  "near": {"point": [1, 2], "within": 1}},
                 "do": {"hide": {"frames": [0, 5]}, "move": {"by": [1, 0, 0]}, "clip": {"activity": "stands"},
                        "look_at": {"point": [0, 0, 1]}, "duplicate": {"by": [1, 0, 0]},
                        "bend": {"points": [{"frame": 3, "by": [1, 0]}]}, "retime": {"speed": 2}}},
                {"name": "b", "do": {"hide": true, "character": 1, "tint": "#000000", "scale": 1, "hero": "h",
                  "look_at": {"person": {"id": 1, "group": "f", "spawn": {"frame": 0, "position": [0, 0, 0]}}}},
                 "who": {"and": [{"near": {"wall": "w", "within": 1}}, {"near": {"who": {"copies": "a"}, "within": 1}}],
                  "or": [{"everybody": true}], "not": {"everybody": true}}}]})"},
         [](const std::string& text, const Schema& schema, Diagnostics& diagnostics) {
             readOverrides(text, diagnostics, schema);
         }},
    };
}

/// Whether the reader notices that this is not the schema that it was written for.
bool notices(const Format& format, const Json& schema) {
    const Schema changed(schema.dump());
    Diagnostics diagnostics;
    try {
        for (const std::string& document : format.documents) {
            format.read(document, changed, diagnostics);
            if (!diagnostics.entries.empty()) return true;
        }
    } catch (const std::logic_error&) {
        return true;
    }
    return false;
}

/// Calls `visit` with every object of a document and its place.
template <class Visit>
void eachObject(const Json& node, const Pointer& where, Visit visit) {
    if (node.is_object()) visit(node, where);
    if (node.is_structured())
        for (const auto& [key, child] : node.items())
            eachObject(child, node.is_object() ? where / key : where / std::stoul(key), visit);
}

/// Another value of the same kind; another word is taken from the rule.
Json other(const Json& value, const Json& rule) {
    if (value.is_number()) return value.get<double>() + 0.125;
    if (value.is_boolean()) return !value.get<bool>();
    if (value.is_structured()) {
        Json result = value;
        *result.begin() = other(*value.begin(), rule);
        return result;
    }
    for (const Json& word : rule.contains("enum") ? rule["enum"] : rule["oneOf"][0]["enum"])
        if (word != value) return word;
    return nullptr;
}

/// Takes a key out of an object's rule, and out of all that the object may be.
void removeKey(Json& rule, const std::string& key) {
    if (rule.contains("properties")) rule["properties"].erase(key);
    if (rule.contains("oneOf"))
        for (Json& each : rule["oneOf"])
            removeKey(each, key);
}

class SchemaAndReader : public testing::TestWithParam<Format> {
  protected:
    const Format& format = GetParam();
    const Json schema = Json::parse(format.schema);
    void SetUp() override { ASSERT_FALSE(notices(format, schema)); }
};

INSTANTIATE_TEST_SUITE_P(Of, SchemaAndReader, testing::ValuesIn(formats()),
                         [](const auto& test) { return test.param.name; });

TEST_P(SchemaAndReader, HaveTheSameDefaults) {
    int defaults = 0;
    eachObject(schema, Pointer(), [&](const Json& rule, const Pointer& where) {
        if (!rule.contains("default")) return;
        Json changed = schema;
        changed[where]["default"] = other(rule["default"], rule);
        EXPECT_TRUE(notices(format, changed)) << "nothing reads the default of " << where;
        ++defaults;
    });
    EXPECT_GT(defaults, 2);
}

TEST_P(SchemaAndReader, HaveTheSameKeys) {
    int keys = 0;
    eachObject(schema, Pointer(), [&](const Json& properties, const Pointer& where) {
        if (where.empty() || where.back() != "properties") return;
        const Pointer rule = where.parent_pointer();
        if (!rule.empty() && rule.back() == "if") return;  // a condition, no object
        const Pointer list = rule.empty() ? rule : rule.parent_pointer();
        const bool one_of_several = !list.empty() && list.back() == "oneOf";
        for (const auto& [key, entry] : properties.items()) {
            Json changed = schema;
            removeKey(changed[one_of_several ? list.parent_pointer() : rule], key);
            EXPECT_TRUE(notices(format, changed)) << "nothing reads the key " << where << "/" << key;
            ++keys;
        }
    });
    EXPECT_GT(keys, 15);
}

TEST_P(SchemaAndReader, HaveTheSameWords) {
    eachObject(schema, Pointer(), [&](const Json& rule, const Pointer& where) {
        if (!rule.contains("enum")) return;
        Json changed = schema;
        changed[where]["enum"].push_back("another");
        // Of profiles the reader knows no names: what they are stands in the schema, too.
        const bool is_profile = where.to_string().find("profile") != std::string::npos;
        EXPECT_TRUE(is_profile || notices(format, changed)) << "a word more is not noticed at " << where;
    });
}

}  // namespace
}  // namespace throng::authoring
