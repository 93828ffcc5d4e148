// SPDX-License-Identifier: Apache-2.0
#include "authoring/overrides/value_readers.h"

#include <fmt/format.h>

#include <charconv>

namespace throng::authoring {
namespace {

std::string kindOf(const JsonNode& node) {
    return node.kind == JsonNode::Kind::array ? fmt::format("an array of {}", node.items.size())
                                              : std::string(node.kindName());
}

std::optional<Tint> tintOf(const JsonNode& node, SchemaRule rule, Diagnostics& diagnostics) {
    if (node.kind != JsonNode::Kind::text) {
        const auto draws = numbersOf(
            node, rule, 3, R"(three numbers from 0 to 1 or a colour such as "#a01020")", diagnostics);
        if (!draws) return std::nullopt;
        const std::array<double, 3> three{(*draws)[0], (*draws)[1], (*draws)[2]};
        return Tint{fmt::format("{} {} {}", three[0], three[1], three[2]), three, {}};
    }
    std::uint32_t colour = 0;
    const char* const end = node.text.data() + node.text.size();
    const auto [stop, error] =
        std::from_chars(node.text.data() + (node.text.empty() ? 0 : 1), end, colour, 16);
    if (node.text.size() != 7 || node.text.front() != '#' || error != std::errc() || stop != end) {
        diagnostics.error(node.where, fmt::format("`{}` is not a colour", node.text),
                          R"(six hexadecimal digits, for example "#a01020", or three numbers from 0 to 1)");
        return std::nullopt;
    }
    return Tint{fmt::format("#{:06x}", colour), {}, colour};
}

void readRetime(const JsonNode& node, SchemaRule rule, PersonChange& change, Diagnostics& diagnostics) {
    ObjectReader reader(node, rule, "`retime`", diagnostics);
    if (!reader.isObject()) return;
    reader.number("offset", change.delay);
    reader.number("speed", change.speed);
    reader.finish();
}

}  // namespace

std::optional<std::uint32_t> wholeOf(const JsonNode& node, SchemaRule rule, Diagnostics& diagnostics) {
    const std::optional<double> number = numberOf(node, rule.limits(), diagnostics);
    if (!number) return std::nullopt;
    if (*number != static_cast<double>(static_cast<std::uint32_t>(*number))) {
        diagnostics.error(node.where, fmt::format("expected a whole number, found {:.15g}", *number));
        return std::nullopt;
    }
    return static_cast<std::uint32_t>(*number);
}

std::optional<std::vector<double>> numbersOf(const JsonNode& node, SchemaRule rule, std::size_t count,
                                             const char* meaning, Diagnostics& diagnostics) {
    if (node.kind != JsonNode::Kind::array || node.items.size() != count) {
        diagnostics.error(node.where, fmt::format("expected {}, found {}", meaning, kindOf(node)));
        return std::nullopt;
    }
    const Limits limits = rule.item().limits();
    std::vector<double> result;
    for (const JsonNode& item : node.items) {
        const std::optional<double> number = numberOf(item, limits, diagnostics);
        if (!number) return std::nullopt;
        result.push_back(*number);
    }
    return result;
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> rangeOf(const JsonNode& node, SchemaRule rule,
                                                               const char* meaning,
                                                               Diagnostics& diagnostics) {
    if (node.kind != JsonNode::Kind::array || node.items.size() != 2) {
        diagnostics.error(node.where, fmt::format("expected {}, found {}", meaning, kindOf(node)));
        return std::nullopt;
    }
    const std::optional<std::uint32_t> first = wholeOf(node.items[0], rule.item(), diagnostics);
    const std::optional<std::uint32_t> last = wholeOf(node.items[1], rule.item(), diagnostics);
    if (!first || !last) return std::nullopt;
    if (*last < *first) {
        diagnostics.error(node.where, fmt::format("{} comes after {}", *first, *last),
                          fmt::format("write [{}, {}]", *last, *first));
        return std::nullopt;
    }
    return std::pair(*first, *last);
}

void readFrames(ObjectReader& reader, FrameRange& frames, Diagnostics& diagnostics) {
    if (const JsonNode* node = reader.get("frames"))
        if (const auto range =
                rangeOf(*node, reader.rule("frames"), "[first, last], two frames", diagnostics))
            frames = {range->first, range->second};
}

void readMove(ObjectReader& reader, PersonChange& change, Diagnostics& diagnostics) {
    if (const JsonNode* by = reader.get("by"))
        if (const auto offset = numbersOf(*by, reader.rule("by"), 3, "[dx, dy, dz] in metres", diagnostics))
            change.move = {(*offset)[0], (*offset)[1], (*offset)[2]};
    reader.number("turn", change.turn);
}

void readPerson(ObjectReader& reader, Override& person, Diagnostics& diagnostics) {
    person.where = reader.where();
    if (const JsonNode* id = reader.require("id", "the person's row in the bake"))
        person.id = wholeOf(*id, reader.rule("id"), diagnostics).value_or(0);
    reader.requiredText("group", "the id of its flow or formation", person.group);
    const JsonNode* spawn = reader.require("spawn", "frame and position of its entry");
    if (!spawn) return;
    ObjectReader inner(*spawn, reader.rule("spawn"), "`spawn`", diagnostics);
    if (!inner.isObject()) return;
    if (const JsonNode* frame = inner.require("frame", "the bake's frame, from 0"))
        person.spawn_frame = wholeOf(*frame, inner.rule("frame"), diagnostics).value_or(0);
    if (const JsonNode* position = inner.require("position", "[x, y, z] in metres"))
        if (const auto place =
                numbersOf(*position, inner.rule("position"), 3, "[x, y, z] in metres", diagnostics))
            person.spawn_place = {(*place)[0], (*place)[1], (*place)[2]};
    inner.finish();
}

std::optional<Override> personOf(const JsonNode& node, SchemaRule rule, Diagnostics& diagnostics) {
    ObjectReader reader(node, rule, "a person", diagnostics);
    if (!reader.isObject()) return std::nullopt;
    Override person;
    readPerson(reader, person, diagnostics);
    reader.finish();
    return person;
}

void readChange(ObjectReader& reader, PersonChange& change, Diagnostics& diagnostics) {
    if (const JsonNode* character = reader.get("character"))
        change.character = wholeOf(*character, reader.rule("character"), diagnostics);
    if (const JsonNode* tint = reader.get("tint"))
        change.tint = tintOf(*tint, reader.rule("tint"), diagnostics);
    reader.number("scale", change.scale);
    if (const JsonNode* retime = reader.get("retime"))
        readRetime(*retime, reader.rule("retime"), change, diagnostics);
    const JsonNode* hero = reader.get("hero");
    if (!hero) return;
    reader.text("hero", change.hero);
    if (hero->kind == JsonNode::Kind::text && change.hero.empty())
        diagnostics.error(hero->where, "the hero's name is empty");
}

}  // namespace throng::authoring
