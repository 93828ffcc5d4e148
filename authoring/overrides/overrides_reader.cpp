// SPDX-License-Identifier: Apache-2.0
#include "authoring/overrides/overrides_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <tuple>

#include "authoring/layout/json_document.h"
#include "authoring/layout/object_reader.h"

namespace throng::authoring {
namespace {

class Reader {
  public:
    Reader(Diagnostics& diagnostics, const Schema& schema) : diagnostics_(diagnostics), schema_(schema) {}

    std::vector<Override> read(const JsonNode& root) {
        ObjectReader reader(root, schema_.rule(), "the override file", diagnostics_);
        if (!reader.isObject()) return {};
        reader.get("$schema");
        const JsonNode* version = reader.require("throng_overrides", "the format's version, 1");
        if (version && (version->kind != JsonNode::Kind::number || version->number != 1.0))
            diagnostics_.error(version->where, "this program reads overrides of version 1",
                               "write \"throng_overrides\": 1");
        const JsonNode* list = reader.require("overrides", "the people who are changed");
        if (list && list->kind != JsonNode::Kind::array)
            diagnostics_.error(list->where,
                               fmt::format("expected an array of overrides, found {}", list->kindName()));
        else if (list)
            for (const JsonNode& item : list->items)
                readOverride(item);
        reader.finish();
        return std::move(overrides_);
    }

  private:
    void readOverride(const JsonNode& node) {
        ObjectReader reader(node, schema_.definition("override"), "an override", diagnostics_);
        if (!reader.isObject()) return;
        Override entry;
        entry.where = node.where;
        readPerson(reader, entry);
        PersonChange& change = entry.change;
        reader.boolean("hide", change.hide);
        if (const JsonNode* character = reader.get("character"))
            change.character = wholeOf(*character, reader.rule("character"));
        if (const JsonNode* tint = reader.get("tint")) change.tint = tintOf(*tint, reader.rule("tint"));
        reader.number("scale", change.scale);
        if (const JsonNode* move = reader.get("move")) readMove(*move, reader.rule("move"), change);
        if (const JsonNode* retime = reader.get("retime")) readRetime(*retime, reader.rule("retime"), change);
        if (const JsonNode* hero = reader.get("hero")) {
            reader.text("hero", change.hero);
            if (hero->kind == JsonNode::Kind::text && change.hero.empty())
                diagnostics_.error(hero->where, "the hero's name is empty");
        }
        std::string note;
        reader.text("note", note);
        reader.finish();
        overrides_.push_back(std::move(entry));
    }

    void readPerson(ObjectReader& reader, Override& entry) {
        const JsonNode* id = reader.require("id", "the person's row in the bake");
        if (id) entry.id = wholeOf(*id, reader.rule("id")).value_or(0);
        reader.requiredText("group", "the id of its flow or formation", entry.group);
        const JsonNode* spawn = reader.require("spawn", "frame and position of its entry");
        if (!spawn) return;
        ObjectReader inner(*spawn, reader.rule("spawn"), "`spawn`", diagnostics_);
        if (!inner.isObject()) return;
        if (const JsonNode* frame = inner.require("frame", "the bake's frame, from 0"))
            entry.spawn_frame = wholeOf(*frame, inner.rule("frame")).value_or(0);
        if (const JsonNode* position = inner.require("position", "[x, y, z] in metres"))
            if (const auto place = threeOf(*position, inner.rule("position"), "[x, y, z] in metres"))
                entry.spawn_place = {(*place)[0], (*place)[1], (*place)[2]};
        inner.finish();
        if (id) refuseTwice(entry, *id);
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

    void readMove(const JsonNode& node, SchemaRule rule, PersonChange& change) {
        ObjectReader reader(node, rule, "`move`", diagnostics_);
        if (!reader.isObject()) return;
        if (const JsonNode* by = reader.get("by"))
            if (const auto offset = threeOf(*by, reader.rule("by"), "[dx, dy, dz] in metres"))
                change.move = {(*offset)[0], (*offset)[1], (*offset)[2]};
        reader.number("turn", change.turn);
        reader.finish();
    }

    void readRetime(const JsonNode& node, SchemaRule rule, PersonChange& change) {
        ObjectReader reader(node, rule, "`retime`", diagnostics_);
        if (!reader.isObject()) return;
        reader.number("offset", change.delay);
        reader.number("speed", change.speed);
        reader.finish();
    }

    std::optional<std::uint32_t> wholeOf(const JsonNode& node, SchemaRule rule) {
        const std::optional<double> number = numberOf(node, rule.limits(), diagnostics_);
        if (!number) return std::nullopt;
        if (*number != static_cast<double>(static_cast<std::uint32_t>(*number))) {
            diagnostics_.error(node.where, fmt::format("expected a whole number, found {:.15g}", *number));
            return std::nullopt;
        }
        return static_cast<std::uint32_t>(*number);
    }

    std::optional<std::array<double, 3>> threeOf(const JsonNode& node, SchemaRule rule, const char* meaning) {
        if (node.kind != JsonNode::Kind::array || node.items.size() != 3) {
            diagnostics_.error(node.where, fmt::format("expected {}, found {}", meaning,
                                                       node.kind == JsonNode::Kind::array
                                                           ? fmt::format("an array of {}", node.items.size())
                                                           : std::string(node.kindName())));
            return std::nullopt;
        }
        const Limits limits = rule.item().limits();
        std::array<double, 3> result{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::optional<double> number = numberOf(node.items[i], limits, diagnostics_);
            if (!number) return std::nullopt;
            result[i] = *number;
        }
        return result;
    }

    std::optional<Tint> tintOf(const JsonNode& node, SchemaRule rule) {
        if (node.kind != JsonNode::Kind::text) {
            const auto draws =
                threeOf(node, rule, R"(three numbers from 0 to 1 or a colour such as "#a01020")");
            if (!draws) return std::nullopt;
            return Tint{fmt::format("{} {} {}", (*draws)[0], (*draws)[1], (*draws)[2]), *draws, {}};
        }
        std::uint32_t colour = 0;
        const char* const end = node.text.data() + node.text.size();
        const auto [stop, error] =
            std::from_chars(node.text.data() + (node.text.empty() ? 0 : 1), end, colour, 16);
        if (node.text.size() != 7 || node.text.front() != '#' || error != std::errc() || stop != end) {
            diagnostics_.error(
                node.where, fmt::format("`{}` is not a colour", node.text),
                R"(six hexadecimal digits, for example "#a01020", or three numbers from 0 to 1)");
            return std::nullopt;
        }
        return Tint{fmt::format("#{:06x}", colour), {}, colour};
    }

    Diagnostics& diagnostics_;
    const Schema& schema_;
    std::vector<Override> overrides_;
    std::map<std::tuple<std::uint32_t, std::string, std::uint32_t>, int> lines_;  // by id, group and frame
};

}  // namespace

const Schema& overridesRules() {
    static const Schema schema(overridesSchema());
    return schema;
}

std::optional<std::vector<Override>> readOverrides(std::string_view text, Diagnostics& diagnostics,
                                                   const Schema& schema) {
    const JsonNode root = parseJson(text, diagnostics);
    if (diagnostics.hasErrors()) return std::nullopt;
    std::vector<Override> overrides = Reader(diagnostics, schema).read(root);
    if (diagnostics.hasErrors()) return std::nullopt;
    for (const Override& entry : overrides)
        if (entry.change.changesNothing())
            diagnostics.warning(entry.where,
                                fmt::format("the override of person {} changes nothing", entry.id),
                                "remove it, or add hide, character, tint, scale, move, retime or hero");
    return overrides;
}

}  // namespace throng::authoring
