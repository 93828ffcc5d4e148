// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/given_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "authoring/layout/people_reader.h"

namespace throng::authoring {

void GivenReader::read(const JsonNode& node) {
    GivenPeople given;
    given.where = node.where;
    ObjectReader reader(node, schema_.definition("given"), "given people", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "their name in the account", given.id);
    given.level = levels_.levelOf(reader);
    readSource(reader, node, given);
    reader.number("start", given.start);
    std::optional<glm::dvec2> offset;
    reader.point("offset", offset);
    given.offset = offset.value_or(glm::dvec2(0.0));
    given.people = readPeople(reader, diagnostics_);
    reader.finish();
    for (std::vector<GivenPoint>& way : given.ways)
        for (GivenPoint& point : way)
            point = {point.time + given.start, point.place + given.offset, point.height};
    claimId(node, given.id, groups_, std::string::npos, "a flow, formation or given people", diagnostics_);
    layout_.given.push_back(std::move(given));
}

bool GivenReader::has(const std::string& id) const {
    return std::ranges::find(layout_.given, id, &GivenPeople::id) != layout_.given.end();
}

void GivenReader::readSource(ObjectReader& reader, const JsonNode& node, GivenPeople& given) {
    const JsonNode* file = reader.get("file");
    const JsonNode* ways = reader.get("ways");
    if ((file != nullptr) == (ways != nullptr))
        diagnostics_.error(node.where,
                           fmt::format("given people need exactly one of `file` (their trajectories) and "
                                       "`ways` (points [time, x, y]), these have {}",
                                       file ? "both" : "neither"),
                           R"(for example "file": "measured.csv")");
    reader.text("file", given.file);
    if (file) given.file_where = file->where;
    if (file && file->kind == JsonNode::Kind::text && file->text.empty())
        diagnostics_.error(file->where, "`file` is empty", "name a file, relative to the layout");
    reader.number("fps", given.fps);
    if (ways)
        refuseKeys(node, {"fps"}, "`ways` have seconds: `{}` has no meaning beside them", "leave `{}` out",
                   diagnostics_);
    if (!ways) return;
    const SchemaRule rule = reader.rule("ways");
    if (ways->kind == JsonNode::Kind::array && ways->items.empty())
        diagnostics_.error(ways->where, "expected at least one way", "for example [[[0, 0, 0], [5, 6, 0]]]");
    eachOf(reader, "ways", [&](const JsonNode& way) { readWay(way, rule.item(), given); });
}

void GivenReader::readWay(const JsonNode& node, SchemaRule rule, GivenPeople& given) {
    const std::size_t least = rule.leastItems(), most = rule.mostOf("maxItems");
    if (node.kind != JsonNode::Kind::array || node.items.size() < least || node.items.size() > most)
        return diagnostics_.error(
            node.where,
            fmt::format("expected a way of {} to {} points [time, x, y] or [time, x, y, z]", least, most));
    const Limits limits = rule.item().item().limits();
    std::vector<GivenPoint> way;
    for (const JsonNode& item : node.items) {
        if (item.kind != JsonNode::Kind::array || item.items.size() < 3 || item.items.size() > 4)
            return diagnostics_.error(
                item.where, "expected a point [time, x, y] or [time, x, y, z], in seconds and metres");
        std::array<std::optional<double>, 4> numbers;
        for (std::size_t i = 0; i < item.items.size(); ++i) {
            numbers[i] = numberOf(item.items[i], limits, diagnostics_);
            if (!numbers[i]) return;
        }
        if (!way.empty() && *numbers[0] <= way.back().time)
            return diagnostics_.error(item.where,
                                      fmt::format("the point at {:.6g} s comes after one at {:.6g} s",
                                                  *numbers[0], way.back().time),
                                      "each point is later than the one before");
        way.push_back({*numbers[0], {*numbers[1], *numbers[2]}, numbers[3]});
    }
    given.ways.push_back(std::move(way));
}

}  // namespace throng::authoring
