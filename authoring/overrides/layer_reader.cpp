// SPDX-License-Identifier: Apache-2.0
#include "authoring/overrides/layer_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "authoring/layout/object_reader.h"
#include "authoring/overrides/selector_reader.h"
#include "authoring/overrides/value_readers.h"

namespace throng::authoring {
namespace {

class OperationsReader {
  public:
    OperationsReader(const JsonNode& node, SchemaRule rule, Diagnostics& diagnostics)
        : diagnostics_(diagnostics), reader_(node, rule, "`do`", diagnostics) {}

    Operations read() {
        if (!reader_.isObject()) return {};
        readHide();
        inner("move", [this](ObjectReader& move) {
            readMove(move, result_.change, diagnostics_);
            move.point("about", result_.about);
        });
        readChange(reader_, result_.change, diagnostics_);
        inner("clip", [this](ObjectReader& clip) { result_.clip = clipOf(clip); });
        inner("look_at", [this](ObjectReader& look) { result_.look_at = lookOf(look); });
        inner("duplicate", [this](ObjectReader& copies) { result_.duplicate = duplicateOf(copies); });
        inner("bend", [this](ObjectReader& bend) { result_.bend = bendOf(bend); });
        reader_.finish();
        return std::move(result_);
    }

  private:
    template <class Read>
    void inner(const char* key, Read&& read) {
        const JsonNode* node = reader_.get(key);
        const SchemaRule rule = reader_.rule(key);
        if (!node) return;
        ObjectReader reader(*node, rule, fmt::format("`{}`", key), diagnostics_);
        if (!reader.isObject()) return;
        read(reader);
        reader.finish();
    }

    /// true, or in some frames.
    void readHide() {
        const JsonNode* node = reader_.get("hide");
        if (!node || node->kind != JsonNode::Kind::object)
            return reader_.boolean("hide", result_.change.hide);
        inner("hide", [this](ObjectReader& hide) {
            result_.hidden.emplace();
            if (hide.require("frames", "[first, last]")) readFrames(hide, *result_.hidden, diagnostics_);
        });
    }

    Clip clipOf(ObjectReader& reader) {
        Clip clip;
        reader.require("activity", "walks, stands, looks or queues");
        reader.choice<ClipActivity>("activity",
                                    {{"walks", ClipActivity::walks},
                                     {"stands", ClipActivity::stands},
                                     {"looks", ClipActivity::looks},
                                     {"queues", ClipActivity::queues}},
                                    clip.activity);
        readFrames(reader, clip.frames, diagnostics_);
        return clip;
    }

    LookAt lookOf(ObjectReader& reader) {
        LookAt look;
        const JsonNode* point = reader.get("point");
        if (point)
            if (const auto place =
                    numbersOf(*point, reader.rule("point"), 3, "[x, y, z] in metres", diagnostics_))
                look.point = {(*place)[0], (*place)[1], (*place)[2]};
        const JsonNode* person = reader.get("person");
        if (person) look.person = personOf(*person, reader.rule("person"), diagnostics_);
        readFrames(reader, look.frames, diagnostics_);
        reader.number("ease", look.ease);
        if (!point == !person)
            diagnostics_.error(reader.where(), "`look_at` needs one thing to look at",
                               "one of: point, person");
        return look;
    }

    Duplicate duplicateOf(ObjectReader& reader) {
        Duplicate duplicate;
        reader.integer("copies", duplicate.copies);
        readMove(reader, duplicate.each, diagnostics_);
        reader.point("about", duplicate.about);
        reader.number("offset", duplicate.each.delay);
        reader.number("scatter", duplicate.scatter);
        reader.integer("seed", duplicate.seed);
        return duplicate;
    }

    Bend bendOf(ObjectReader& reader) {
        Bend bend;
        reader.number("falloff", bend.falloff);
        reader.number("most_acceleration", bend.most_acceleration);
        const JsonNode* points = reader.require("points", "where people are how far beside their way");
        if (!points) return bend;
        if (points->kind != JsonNode::Kind::array || points->items.empty() ||
            points->items.size() > reader.rule("points").mostItems()) {
            diagnostics_.error(points->where, fmt::format("expected an array of 1 to {} points",
                                                          reader.rule("points").mostItems()));
            return bend;
        }
        for (const JsonNode& node : points->items)
            readBendPoint(node, reader.rule("points").item(), bend);
        return bend;
    }

    void readBendPoint(const JsonNode& node, SchemaRule rule, Bend& bend) {
        ObjectReader reader(node, rule, "a point of a bend", diagnostics_);
        if (!reader.isObject()) return;
        BendPoint point;
        std::optional<double> frame, way;
        reader.number("frame", frame);
        reader.number("way", way);
        const bool by_way = reader.get("way");
        if (by_way == (reader.get("frame") != nullptr)) {
            diagnostics_.error(node.where, "a point of a bend is at a frame, or at so many metres of the way",
                               "one of: frame, way");
        } else if (!bend.points.empty() && by_way != bend.by_way) {
            diagnostics_.error(node.where,
                               "the points of a bend are all at frames, or all at metres of the way");
        }
        bend.by_way = by_way;
        point.at = by_way ? way.value_or(0.0) : frame.value_or(0.0);
        reader.point("by", "[dx, dy] in metres", point.by);
        reader.finish();
        if (!bend.points.empty() && point.at <= bend.points.back().at)
            diagnostics_.error(node.where,
                               fmt::format("{:.15g} comes after {:.15g}", point.at, bend.points.back().at),
                               "the points of a bend stand in order");
        bend.points.push_back(point);
    }

    Diagnostics& diagnostics_;
    ObjectReader reader_;
    Operations result_;
};

}  // namespace

std::vector<Layer> readLayers(const JsonNode& list, const Schema& schema, Diagnostics& diagnostics) {
    std::vector<Layer> layers;
    std::vector<std::string> names;
    std::map<std::string, int> lines;
    for (const JsonNode& node : list.items) {
        ObjectReader reader(node, schema.definition("layer"), "a layer", diagnostics);
        if (!reader.isObject()) continue;
        Layer layer;
        layer.where = node.where;
        reader.requiredText("name", "what it is called", layer.name);
        reader.boolean("enabled", layer.enabled);
        if (const JsonNode* who = reader.require("who", "whom it changes"))
            layer.who = readSelector(*who, reader.rule("who"), names, diagnostics);
        if (const JsonNode* operations = reader.require("do", "what it does to them"))
            layer.operations = OperationsReader(*operations, reader.rule("do"), diagnostics).read();
        std::string note;
        reader.text("note", note);
        reader.finish();
        if (const auto [first, is_new] = lines.emplace(layer.name, node.where.line); !is_new)
            diagnostics.error(
                node.find("name") ? node.find("name")->where : node.where,
                fmt::format("there is a layer `{}` in line {} already", layer.name, first->second),
                "give each another name");
        names.push_back(layer.name);
        layers.push_back(std::move(layer));
    }
    return layers;
}

std::vector<std::string> operationWords(const Operations& operations) {
    std::vector<std::string> words = changeWords(operations.change);
    if (operations.hidden) words.emplace_back("hide");
    if (operations.bend) words.emplace_back("bend");
    if (operations.clip) words.emplace_back("clip");
    if (operations.look_at) words.emplace_back("look_at");
    if (operations.duplicate) words.emplace_back("duplicate");
    return words;
}

}  // namespace throng::authoring
