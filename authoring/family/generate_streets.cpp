// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "authoring/family/generate.h"
#include "authoring/scene/random.h"

namespace throng::authoring::generate {
namespace {

constexpr double kPavement = 0.6;  // m between a street's edge and the houses

glm::dvec2 direction(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

/// Directions of the arms: even, and then each moved within what keeps narrow angles passable.
std::vector<double> armAngles(const GeneratorValues& values) {
    const std::uint64_t arms = values.whole("arms");
    const double even = 2.0 * std::numbers::pi / static_cast<double>(arms);
    constexpr double kMostShare = 0.25;  // of the even angle, so that two arms keep half of it between them
    const GroupRandom random(values.whole("seed"), "arms");
    std::vector<double> angles;
    angles.reserve(arms);
    for (std::uint64_t arm = 0; arm < arms; ++arm)
        angles.push_back(even *
                         (static_cast<double>(arm) + kMostShare * values["irregularity"] *
                                                         (2.0 * random.unit(arm, Purpose::goal_x) - 1.0)));
    return angles;
}

/// The houses between two arms: a wedge, its corner where the pavements meet.
std::vector<glm::dvec2> wedge(double from, double to, double half_width, double length) {
    const double angle = to - from;
    const glm::dvec2 middle = direction(from + 0.5 * angle);
    const double setback = half_width + kPavement;
    const glm::dvec2 corner = middle * (setback / std::sin(0.5 * angle));
    const glm::dvec2 left(-std::sin(from), std::cos(from));
    const glm::dvec2 right(std::sin(to), -std::cos(to));
    const double far = length + setback;
    return {corner, direction(from) * length + left * setback, middle * far,
            direction(to) * length + right * setback};
}

}  // namespace

Json crossing(const GeneratorValues& values) {
    const std::vector<double> angles = armAngles(values);
    const double half_width = 0.5 * values["width"];
    double narrowest = 2.0 * std::numbers::pi;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2.0 * std::numbers::pi;
        narrowest = std::min(narrowest, next - angles[i]);
    }
    // The corner of the narrowest wedge lies this far out along its arms.
    const double corner = (half_width + kPavement) / std::tan(0.5 * std::min(narrowest, 3.0));
    const double length = std::max(values["length"], 1.5 * corner + 8.0);

    Json layout = frameOf("crossing", values);
    for (std::size_t i = 0; i < angles.size(); ++i)
        layout["roads"].push_back({{"id", fmt::format("arm {}", i + 1)},
                                   {"centreline", points({{0.0, 0.0}, direction(angles[i]) * length})},
                                   {"width", values["width"]}});
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2.0 * std::numbers::pi;
        layout["walls"].push_back({{"id", fmt::format("houses {}", i + 1)},
                                   {"closed", true},
                                   {"height", 12.0},
                                   {"points", points(wedge(angles[i], next, half_width, length))}});
    }
    for (std::size_t i = 0; i < angles.size(); ++i) {
        Json goals = Json::object();
        for (std::size_t other = 0; other < angles.size(); ++other)
            if (other != i) goals[fmt::format("arm {}:end", other + 1)] = 1;
        layout["flows"].push_back({{"id", fmt::format("from arm {}", i + 1)},
                                   {"from", fmt::format("arm {}:end", i + 1)},
                                   {"to", {{"choose", goals}}},
                                   {"rate", values["rate"]}});
    }
    return layout;
}

Json corridor(const GeneratorValues& values) {
    const double half_length = 0.5 * values["length"];
    const double half_width = 0.5 * values["width"];
    constexpr double kWall = 0.2;  // m thick
    constexpr double kEnd = 3.0;   // m, depth of the areas at the ends
    constexpr double kPass = 1.2;  // m, what is left beside a pillar at least
    Json layout = frameOf("corridor", values);
    layout["areas"] = Json::array(
        {{{"id", "west"}, {"polygon", rectangle(-half_length, -half_width, -half_length + kEnd, half_width)}},
         {{"id", "east"}, {"polygon", rectangle(half_length - kEnd, -half_width, half_length, half_width)}}});
    const double wall = half_width + 0.5 * kWall;
    for (const double side : {-wall, wall})
        layout["walls"].push_back(
            {{"id", side < 0.0 ? "south" : "north"},
             {"thickness", kWall},
             {"points", points({{-half_length - 1.0, side}, {half_length + 1.0, side}})}});
    const double radius = values["pillar_radius"];
    const double free = half_width - radius - kPass;
    if (free > 0.0 && values["length"] > 2.0 * (kEnd + kPass + radius) + 1.0)
        addPillars(layout,
                   scatter(
                       values.whole("pillars"), {-half_length + kEnd + kPass + radius, -free},
                       {half_length - kEnd - kPass - radius, free}, 2.0 * radius + kPass,
                       values.whole("seed"), [](glm::dvec2, const void*) { return true; }, nullptr),
                   radius);
    for (const auto& [name, from, to] :
         {std::array{"forth", "west", "east"}, std::array{"back", "east", "west"}})
        if (values[name] > 0.0)
            layout["flows"].push_back({{"id", name}, {"from", from}, {"to", to}, {"rate", values[name]}});
    return layout;
}

StreetLines layStreets(std::uint64_t blocks, const GeneratorValues& values, const char* which) {
    const GroupRandom random(values.whole("seed"), which);
    const double width = values["width"];
    StreetLines lines;
    for (std::uint64_t i = 0; i <= blocks; ++i) {
        lines.streets.push_back(lines.end + 0.5 * width);
        lines.end += width;
        if (i == blocks) break;
        const double size = values["block"] * (0.75 + 0.5 * random.unit(i, Purpose::goal_x));
        lines.blocks.emplace_back(lines.end, lines.end + size);
        lines.end += size;
    }
    return lines;
}

void addBlocks(Json& layout, const StreetLines& across, const StreetLines& along) {
    for (std::size_t row = 0; row < along.blocks.size(); ++row)
        for (std::size_t column = 0; column < across.blocks.size(); ++column)
            layout["walls"].push_back({{"id", fmt::format("block {}-{}", column + 1, row + 1)},
                                       {"closed", true},
                                       {"height", 15.0},
                                       {"points", rectangle(across.blocks[column].first + kPavement,
                                                            along.blocks[row].first + kPavement,
                                                            across.blocks[column].second - kPavement,
                                                            along.blocks[row].second - kPavement)}});
}

Json streets(const GeneratorValues& values) {
    const StreetLines across = layStreets(values.whole("columns"), values, "columns");
    const StreetLines along = layStreets(values.whole("rows"), values, "rows");
    constexpr double kBeyond = 8.0;  // m that streets lead out of the grid
    Json layout = frameOf("streets", values);
    std::vector<std::string> ends;
    const auto add_street = [&](const std::string& id, glm::dvec2 from, glm::dvec2 to) {
        layout["roads"].push_back(
            {{"id", id}, {"centreline", points({from, to})}, {"width", values["width"]}});
        ends.push_back(id + ":start");
        ends.push_back(id + ":end");
    };
    for (std::size_t i = 0; i < along.streets.size(); ++i)
        add_street(fmt::format("street {}", i + 1), {-kBeyond, along.streets[i]},
                   {across.end + kBeyond, along.streets[i]});
    for (std::size_t i = 0; i < across.streets.size(); ++i)
        add_street(fmt::format("avenue {}", i + 1), {across.streets[i], -kBeyond},
                   {across.streets[i], along.end + kBeyond});
    addBlocks(layout, across, along);
    for (const std::string& from : ends) {
        Json goals = Json::object();
        for (const std::string& to : ends)
            if (to != from) goals[to] = 1;
        layout["flows"].push_back({{"id", "from " + from},
                                   {"from", from},
                                   {"to", {{"choose", goals}}},
                                   {"rate", values["rate"] / static_cast<double>(ends.size())}});
    }
    return layout;
}

}  // namespace throng::authoring::generate
