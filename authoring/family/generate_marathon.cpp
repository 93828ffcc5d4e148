// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "authoring/family/generate.h"

namespace throng::authoring::generate {
namespace {

constexpr double kBarrier = 0.1;  // m thick
constexpr double kBeside = 1.0;   // m that nobody stands beside a barrier, or before the town
constexpr double kFinish = 4.0;   // m, depth of the strip where people arrive
constexpr double kJitter = 0.1;   // m: how far people stand from their places in the field

/// The field before the town: people in lines across it, the first of which stands next to the town.
struct StartField {
    double top, bottom;    // m, of the lines
    std::uint64_t across;  // people in a line
    double spacing;        // m
    std::uint64_t people;

    StartField(double height, const GeneratorValues& values)
        : top(height - kBeside),
          bottom(kBeside),
          across(static_cast<std::uint64_t>((top - bottom) / values["spacing"]) + 1),
          spacing(values["spacing"]),
          people(values.whole("people")) {}

    std::uint64_t lines() const { return (people + across - 1) / across; }
    /// m, from the town to the back of so many lines
    double depth(std::uint64_t count) const { return kBeside + spacing * static_cast<double>(count); }

    /// Lines set off one wave after the other. Whole lines, so that no two waves stand in each other.
    void addWaves(Json& layout, std::uint64_t waves, double interval) const {
        waves = std::min(waves, lines());
        std::uint64_t first = 0;
        for (std::uint64_t wave = 0; wave < waves; ++wave) {
            const std::uint64_t columns = shareOf(lines(), wave, waves);
            const std::uint64_t count = std::min(columns * across, people - first * across);
            // Turned round: lines follow each other away from the town, and people stand in them from the
            // north on.
            layout["formations"].push_back({{"id", fmt::format("wave {}", wave + 1)},
                                            {"type", "grid"},
                                            {"origin", point({-depth(first) - 0.5 * spacing, top})},
                                            {"rotation", 180},
                                            {"rows", across},
                                            {"columns", columns},
                                            {"spacing", spacing},
                                            {"jitter", kJitter},
                                            {"count", count},
                                            {"goal", "finish"},
                                            {"arrival", "leave"},
                                            {"people", {{"profile", {{"runner", 1}}}}}});
            if (wave > 0 && interval > 0.0)
                layout["formations"].back()["wait"] = rounded(static_cast<double>(wave) * interval);
            first += columns;
        }
    }
};

void addStreets(Json& layout, const StreetLines& across, const StreetLines& along, double width) {
    const auto add = [&](const std::string& id, glm::dvec2 from, glm::dvec2 to) {
        layout["roads"].push_back({{"id", id}, {"centreline", points({from, to})}, {"width", width}});
    };
    for (std::size_t i = 0; i < along.streets.size(); ++i)
        add(fmt::format("street {}", i + 1), {0.0, along.streets[i]}, {across.end, along.streets[i]});
    for (std::size_t i = 0; i < across.streets.size(); ++i)
        add(fmt::format("avenue {}", i + 1), {across.streets[i], 0.0}, {across.streets[i], along.end});
    addBlocks(layout, across, along);
}

}  // namespace

/// The town is as wide as the field, which is about as deep as it is wide: a million people go in by twenty
/// streets, a thousand by one or two.
Json marathon(const GeneratorValues& values) {
    const double width = values["width"];
    const double side = std::sqrt(static_cast<double>(values.whole("people"))) * values["spacing"];
    const auto rows = static_cast<std::uint64_t>(std::max(1.0, std::round(side / (values["block"] + width))));
    const StreetLines across = layStreets(values.whole("columns"), values, "columns");
    const StreetLines along = layStreets(rows, values, "rows");
    const StartField field(along.end, values);
    const double back = -field.depth(field.lines()) - kBeside, finish = across.end + kFinish;
    Json layout = frameOf("marathon", values);
    layout["areas"] =
        Json::array({{{"id", "field"}, {"polygon", rectangle(back, 0.0, 0.0, along.end)}},
                     {{"id", "finish"}, {"polygon", rectangle(across.end, 0.0, finish, along.end)}}});
    addStreets(layout, across, along, width);
    const double south = -0.5 * kBarrier, north = along.end + 0.5 * kBarrier;
    layout["walls"].push_back(
        {{"id", "barrier"},
         {"thickness", kBarrier},
         {"height", 1.1},
         {"points", points({{finish, south}, {back, south}, {back, north}, {finish, north}})}});
    field.addWaves(layout, values.whole("waves"), values["interval"]);
    return layout;
}

}  // namespace throng::authoring::generate
