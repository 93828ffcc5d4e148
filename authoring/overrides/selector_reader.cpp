// SPDX-License-Identifier: Apache-2.0
#include "authoring/overrides/selector_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "authoring/layout/object_reader.h"
#include "authoring/overrides/value_readers.h"

namespace throng::authoring {
namespace {

/// Reads one selector: each of its keys is a condition of its own.
class SelectorReader {
  public:
    SelectorReader(const JsonNode& node, SchemaRule rule, const std::vector<std::string>& layers,
                   Diagnostics& diagnostics)
        : layers_(layers), diagnostics_(diagnostics), reader_(node, rule, "a selector", diagnostics) {}

    Selector read() {
        if (!reader_.isObject()) return {reader_.where(), Everybody{}};
        readTrue("everybody", Everybody{});
        readTrue("changed", Changed{});
        readNames("group", Named::Of::group);
        readNames("profile", Named::Of::profile);
        readNames("look", Named::Of::look);
        readNames("copies", Named::Of::copies);
        readPairs();
        readPeople();
        readObject("region", [this](ObjectReader& inner) { return region(inner); });
        readObject("share", [](ObjectReader& inner) { return share(inner); });
        readObject("seen", [this](ObjectReader& inner) { return seen(inner); });
        readObject("near", [this](ObjectReader& inner) { return near(inner); });
        readCombined("and", Combined::By::all);
        readCombined("or", Combined::By::any);
        readCombined("not", Combined::By::none);
        readCombined("with", Combined::By::company);
        const std::size_t before = diagnostics_.entries.size();
        reader_.finish();
        if (!found_any_ && diagnostics_.entries.size() == before)
            diagnostics_.error(reader_.where(), "a selector without keys means nobody in particular",
                               R"(for all people, write {"everybody": true})");
        if (parts_.size() == 1) return std::move(parts_.front());
        return {reader_.where(), Combined{Combined::By::all, std::move(parts_)}};
    }

  private:
    const JsonNode* get(const char* key) {
        const JsonNode* node = reader_.get(key);
        found_any_ = found_any_ || node;
        return node;
    }

    template <class What>
    void add(const JsonNode& node, What what) {
        parts_.push_back({node.where, std::move(what)});
    }

    template <class What>
    void readTrue(const char* key, What what) {
        const JsonNode* node = get(key);
        if (!node) return;
        if (node->kind != JsonNode::Kind::boolean || !node->boolean)
            diagnostics_.error(node->where, fmt::format("`{}` can only be true", key),
                               R"(of others, write {"not": {...}})");
        add(*node, what);
    }

    void readNames(const char* key, Named::Of of) {
        const JsonNode* node = get(key);
        if (!node) return;
        Named named{of, {}};
        const bool is_list = node->kind == JsonNode::Kind::array && !node->items.empty();
        for (const JsonNode& each : is_list ? std::span(node->items) : std::span(node, 1)) {
            if (each.kind != JsonNode::Kind::text || each.text.empty())
                diagnostics_.error(each.where, "expected a name, or an array of names",
                                   fmt::format(R"("{}": ["a", "b"] means either)", key));
            else if (of == Named::Of::copies && std::ranges::find(layers_, each.text) == layers_.end())
                diagnostics_.error(each.where,
                                   fmt::format("there is no layer `{}` before this one", each.text),
                                   layers_.empty() ? "" : hintFor(each.text, layers_));
            named.names.push_back(each.text);
        }
        add(*node, std::move(named));
    }

    void readPairs() {
        if (const JsonNode* node = get("party"))
            if (const auto range =
                    rangeOf(*node, reader_.rule("party"), "[least, most], numbers of people", diagnostics_))
                add(*node, PartySize{range->first, range->second});
        if (const JsonNode* node = get("rows"))
            if (const auto range =
                    rangeOf(*node, reader_.rule("rows"), "[first, last], two rows", diagnostics_))
                add(*node, Rows{range->first, range->second});
    }

    bool isList(const JsonNode& node, const char* what) {
        const bool is_list = node.kind == JsonNode::Kind::array && !node.items.empty();
        if (!is_list)
            diagnostics_.error(node.where, fmt::format("expected an array of {}, found {}", what,
                                                       node.kind == JsonNode::Kind::array ? "an empty one"
                                                                                          : node.kindName()));
        return is_list;
    }

    void readPeople() {
        const JsonNode* node = get("people");
        if (!node || !isList(*node, "people")) return;
        ListedPeople people;
        for (const JsonNode& each : node->items)
            if (auto person = personOf(each, reader_.rule("people").item(), diagnostics_))
                people.people.push_back(std::move(*person));
        add(*node, std::move(people));
    }

    template <class Read>
    void readObject(const char* key, Read&& read) {
        const JsonNode* node = get(key);
        if (!node) return;
        ObjectReader inner(*node, reader_.rule(key), fmt::format("`{}`", key), diagnostics_);
        if (!inner.isObject()) return;
        add(*node, read(inner));
        inner.finish();
    }

    Region region(ObjectReader& inner) {
        Region region;
        region.polygon = inner.points("polygon");
        readFrames(inner, region.frames, diagnostics_);
        return region;
    }

    static Share share(ObjectReader& inner) {
        Share share;
        if (inner.require("of", "a number from 0 to 1")) inner.number("of", share.of);
        inner.integer("seed", share.seed);
        return share;
    }

    Seen seen(ObjectReader& inner) {
        Seen seen;
        readFrames(inner, seen.frames, diagnostics_);
        inner.number("margin", seen.margin);
        inner.number("range", seen.range);
        const JsonNode* views = inner.require("views", "where the camera is");
        if (!views || !isList(*views, "views")) return seen;
        if (const std::size_t most = inner.rule("views").mostItems(); views->items.size() > most) {
            diagnostics_.error(views->where,
                               fmt::format("expected at most {} views, found {}", most, views->items.size()));
            return seen;
        }
        for (const JsonNode& node : views->items) {
            const View view = viewOf(node, inner.rule("views").item());
            if (!seen.views.empty() && view.frame <= seen.views.back().frame)
                diagnostics_.error(node.where,
                                   fmt::format("the view of frame {} comes after that of frame {}",
                                               view.frame, seen.views.back().frame),
                                   "views stand in the order of their frames, each with another one");
            seen.views.push_back(view);
        }
        return seen;
    }

    View viewOf(const JsonNode& node, SchemaRule rule) {
        View view;
        ObjectReader inner(node, rule, "a view", diagnostics_);
        if (!inner.isObject()) return view;
        inner.integer("frame", view.frame);
        inner.boolean("parallel", view.parallel);
        if (const JsonNode* matrix = inner.require("matrix", "from the camera to the world"))
            if (const auto numbers =
                    numbersOf(*matrix, inner.rule("matrix"), 16, "16 numbers, row by row", diagnostics_)) {
                std::ranges::copy(*numbers, view.matrix.begin());
                refuseFlat(view, *matrix);
            }
        if (const JsonNode* size = inner.require("size", "width and height 1 m away"))
            if (const auto numbers =
                    numbersOf(*size, inner.rule("size"), 2, "[width, height] in metres", diagnostics_))
                view.size = {(*numbers)[0], (*numbers)[1]};
        if (const JsonNode* shift = inner.get("shift"))
            if (const auto numbers =
                    numbersOf(*shift, inner.rule("shift"), 2, "[right, up] in metres", diagnostics_))
                view.shift = {(*numbers)[0], (*numbers)[1]};
        const std::vector<JsonNode>& none = inner.rule("shift").standard()->items;
        inner.expectSame("shift", none.at(0).number == View().shift.x && none.at(1).number == View().shift.y);
        inner.finish();
        return view;
    }

    void refuseFlat(const View& view, const JsonNode& node) {
        const std::array<double, 16>& m = view.matrix;
        const double determinant =
            glm::determinant(glm::dmat3(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]));
        if (!(std::abs(determinant) > 1.0e-12))
            diagnostics_.error(
                node.where, "the matrix has no inverse",
                "row by row: the last number of each of the first three rows is the camera's place");
    }

    Near near(ObjectReader& inner) {
        Near near;
        inner.point("point", near.point);
        inner.text("wall", near.wall);
        if (const JsonNode* who = inner.get("who"))
            near.who.push_back(readSelector(*who, inner.rule("who"), layers_, diagnostics_));
        if (inner.require("within", "m")) inner.number("within", near.within);
        readFrames(inner, near.frames, diagnostics_);
        const int things =
            (inner.get("point") ? 1 : 0) + (inner.get("wall") ? 1 : 0) + (inner.get("who") ? 1 : 0);
        if (things != 1)
            diagnostics_.error(inner.where(), fmt::format("`near` is of one thing, found {}", things),
                               "one of: point, wall, who");
        return near;
    }

    void readCombined(const char* key, Combined::By by) {
        const JsonNode* node = get(key);
        if (!node) return;
        Combined combined{by, {}};
        const bool of_several = by == Combined::By::all || by == Combined::By::any;
        if (of_several && !isList(*node, "selectors")) return;
        const SchemaRule rule = of_several ? reader_.rule(key).item() : reader_.rule(key);
        for (const JsonNode& each : of_several ? std::span(node->items) : std::span(node, 1))
            combined.parts.push_back(readSelector(each, rule, layers_, diagnostics_));
        add(*node, std::move(combined));
    }

    const std::vector<std::string>& layers_;
    Diagnostics& diagnostics_;
    ObjectReader reader_;
    std::vector<Selector> parts_;
    bool found_any_ = false;
};

}  // namespace

Selector readSelector(const JsonNode& node, SchemaRule rule, const std::vector<std::string>& names,
                      Diagnostics& diagnostics) {
    return SelectorReader(node, rule, names, diagnostics).read();
}

}  // namespace throng::authoring
