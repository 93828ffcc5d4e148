// SPDX-License-Identifier: Apache-2.0
#include "authoring/overrides/overrides_reader.h"

#include <fmt/format.h>

#include <map>
#include <tuple>

#include "authoring/layout/json_document.h"
#include "authoring/layout/object_reader.h"
#include "authoring/overrides/layer_reader.h"
#include "authoring/overrides/value_readers.h"

namespace throng::authoring {
namespace {

class OverridesReader {
  public:
    OverridesReader(Diagnostics& diagnostics, const Schema& schema)
        : diagnostics_(diagnostics), schema_(schema) {}

    OverrideFile read(const JsonNode& root) {
        ObjectReader reader(root, schema_.rule(), "the override file", diagnostics_);
        if (!reader.isObject()) return {};
        reader.get("$schema");
        const JsonNode* version = reader.require("throng_overrides", "the format's version, 1");
        if (version && (version->kind != JsonNode::Kind::number || version->number != 1.0))
            diagnostics_.error(version->where, "this program reads overrides of version 1",
                               "write \"throng_overrides\": 1");
        if (const JsonNode* list = reader.require("overrides", "the people who are changed"))
            if (isArray(*list, "overrides"))
                for (const JsonNode& item : list->items)
                    readOverride(item);
        if (const JsonNode* list = reader.get("layers"))
            if (isArray(*list, "layers")) file_.layers = readLayers(*list, schema_, diagnostics_);
        reader.finish();
        return std::move(file_);
    }

  private:
    bool isArray(const JsonNode& list, const char* what) {
        const bool is_array = list.kind == JsonNode::Kind::array;
        if (!is_array)
            diagnostics_.error(list.where,
                               fmt::format("expected an array of {}, found {}", what, list.kindName()));
        return is_array;
    }

    void readOverride(const JsonNode& node) {
        ObjectReader reader(node, schema_.definition("override"), "an override", diagnostics_);
        if (!reader.isObject()) return;
        Override entry;
        readPerson(reader, entry, diagnostics_);
        if (const JsonNode* id = node.find("id"); id && node.find("spawn")) refuseTwice(entry, *id);
        PersonChange& change = entry.change;
        reader.boolean("hide", change.hide);
        if (const JsonNode* move = reader.get("move")) {
            ObjectReader inner(*move, reader.rule("move"), "`move`", diagnostics_);
            if (inner.isObject()) {
                readMove(inner, change, diagnostics_);
                inner.finish();
            }
        }
        readChange(reader, change, diagnostics_);
        std::string note;
        reader.text("note", note);
        reader.finish();
        file_.people.push_back(std::move(entry));
    }

    /// Overrides of different takes may be of people with the same id.
    void refuseTwice(const Override& entry, const JsonNode& id) {
        const auto [first, is_new] =
            lines_.emplace(std::tuple(entry.id, entry.group, entry.spawn_frame), id.where.line);
        if (!is_new)
            diagnostics_.error(
                id.where,
                fmt::format("person {} has an override in line {} already", entry.id, first->second),
                "put both into one");
    }

    Diagnostics& diagnostics_;
    const Schema& schema_;
    OverrideFile file_;
    std::map<std::tuple<std::uint32_t, std::string, std::uint32_t>, int> lines_;  // by id, group and frame
};

}  // namespace

const Schema& overridesRules() {
    static const Schema schema(overridesSchema());
    return schema;
}

std::optional<OverrideFile> readOverrides(std::string_view text, Diagnostics& diagnostics,
                                          const Schema& schema) {
    const JsonNode root = parseJson(text, diagnostics);
    if (diagnostics.hasErrors()) return std::nullopt;
    OverrideFile file = OverridesReader(diagnostics, schema).read(root);
    if (diagnostics.hasErrors()) return std::nullopt;
    for (const Override& entry : file.people)
        if (entry.change.changesNothing())
            diagnostics.warning(entry.where,
                                fmt::format("the override of person {} changes nothing", entry.id),
                                "remove it, or add hide, character, tint, scale, move, retime or hero");
    for (const Layer& layer : file.layers)
        if (layer.operations.changesNothing())
            diagnostics.warning(layer.where, fmt::format("the layer `{}` changes nothing", layer.name),
                                "remove it, or set `enabled` to false");
    return file;
}

}  // namespace throng::authoring
