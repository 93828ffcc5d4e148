// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "authoring/layout/level_reader.h"

namespace throng::authoring {
namespace {

/// Keys of links that people walk on.
constexpr std::array kOfWays = {"from", "to", "path", "width", "walking", "stand"};
constexpr double kAlongDoors = 0.1;  // m: of a cabin's front beside its doors, at the least
constexpr double kSpeed = 1.0;       // m/s: the usual one of lifts in low houses

}  // namespace

void LevelReader::readLift(ObjectReader& reader, const JsonNode& node, Link link) {
    Lift& lift = link.lift;
    for (const char* key : kOfWays)
        if (const JsonNode* given = reader.get(key))
            diagnostics_.error(given->where,
                               fmt::format("`{}` is of links that people walk on, and a lift is none", key),
                               "a lift has `levels`, and its cabin is `at` a place");
    readStops(reader, node, lift);
    reader.point("at", "the middle of its cabin", lift.at);
    std::optional<glm::dvec2> size;
    reader.point("size", size);
    lift.size = size.value_or(lift.size);
    reader.number("doors", lift.doors);
    reader.number("door_width", lift.door_width);
    reader.number("door_time", lift.door_time);
    reader.number("dwell", lift.dwell);
    reader.number("speed", link.speed);
    lift.speed = node.find("speed") ? link.speed : kSpeed;
    std::uint64_t capacity = 0;
    reader.integer("capacity", capacity);
    if (capacity > 0) lift.capacity = static_cast<std::uint32_t>(capacity);
    reader.finish();
    claimId(node, link.id, links_, layout_.links.size(), "a link", diagnostics_);
    if (diagnostics_.hasErrors()) return;
    if (lift.door_width > lift.size.x - 2.0 * kAlongDoors + 1.0e-9)
        diagnostics_.error(node.find("door_width") ? node.find("door_width")->where : node.where,
                           fmt::format("the doors of lift `{}` are {:.2f} m wide, and its cabin {:.2f} m",
                                       link.id, lift.door_width, lift.size.x),
                           fmt::format("`door_width` can be {:.2f} here", lift.size.x - 2.0 * kAlongDoors));
    link.where = node.where;
    link.from = lift.levels.front();
    link.to = lift.levels.back();
    link.width = lift.size.x;
    layout_.links.push_back(std::move(link));
}

void LevelReader::readStops(ObjectReader& reader, const JsonNode& node, Lift& lift) const {
    if (!reader.require("levels", "the levels that it serves")) return;
    eachOf(reader, "levels", [&](const JsonNode& item) {
        const std::size_t level = levelNamed(item);
        if (std::ranges::find(lift.levels, level) != lift.levels.end())
            diagnostics_.error(item.where, fmt::format("the lift serves level `{}` already", item.text),
                               "name each level once");
        lift.levels.push_back(level);
    });
    lift.opposite.assign(lift.levels.size(), false);
    eachOf(reader, "opposite", [&](const JsonNode& item) {
        const auto found = std::ranges::find(lift.levels, levelNamed(item));
        if (found != lift.levels.end())
            lift.opposite[static_cast<std::size_t>(found - lift.levels.begin())] = true;
        else
            diagnostics_.error(item.where, fmt::format("the lift does not serve level `{}`", item.text),
                               "`opposite` names some of its `levels`");
    });
    if (diagnostics_.hasErrors()) return;
    if (lift.levels.size() < 2)
        return diagnostics_.error(node.find("levels")->where, "a lift that serves one level leads nowhere",
                                  "name two of the `levels`, or more");
    // From the lowest stop up.
    std::vector<std::pair<std::size_t, bool>> stops;
    for (std::size_t i = 0; i < lift.levels.size(); ++i)
        stops.emplace_back(lift.levels[i], lift.opposite[i]);
    const auto height = [&](const auto& stop) {
        const Level& level = layout_.levels[stop.first];
        return level.at ? level.at->z : level.height;
    };
    std::ranges::stable_sort(stops, {}, height);
    for (std::size_t i = 0; i < stops.size(); ++i) {
        lift.levels[i] = stops[i].first;
        lift.opposite[i] = stops[i].second;
        if (i > 0 && height(stops[i]) - height(stops[i - 1]) < kLeastLiftRise)
            diagnostics_.error(
                node.find("levels")->where,
                fmt::format("levels `{}` and `{}` are {:.2f} m apart: the stops of a lift are {} m or more",
                            layout_.levels[stops[i - 1].first].id, layout_.levels[stops[i].first].id,
                            height(stops[i]) - height(stops[i - 1]), kLeastLiftRise));
    }
}

}  // namespace throng::authoring
