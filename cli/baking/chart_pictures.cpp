// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <set>

#include "authoring/storeys/charts.h"
#include "cli/baking/bake_description.h"

namespace throng::cli {
namespace {

using Picture = recording::BakeCharts::Picture;

/// Of the spots that make it up.
std::pair<double, double> heightsOf(const authoring::Surface& surface) {
    std::pair<double, double> heights{1.0e30, -1.0e30};
    for (const std::uint32_t spot : surface.spots) {
        if (spot == authoring::kNoSpot) continue;
        const double height = surface.ground->spots()[spot].height;
        heights = {std::min(heights.first, height), std::max(heights.second, height)};
    }
    return heights;
}

std::pair<double, double> heightsOf(const authoring::Chart& chart) {
    if (chart.surface) return heightsOf(*chart.surface);
    if (!chart.is_link) return {chart.height, chart.height};
    return std::minmax({chart.link.low, chart.link.high});
}

Picture pictureOf(const authoring::Chart& chart, const std::vector<authoring::Chart>& charts, double margin) {
    const std::string level = chart.is_link ? charts.at(chart.link_from).name : chart.name;
    Picture picture;
    picture.name = chart.is_cabin ? fmt::format("{} at {}", chart.name, level) : chart.name;
    picture.kind = chart.is_cabin ? "lift" : chart.is_link ? "link" : chart.surface ? "ground" : "level";
    picture.level = level;
    const auto [lower, upper] = chart.bounds();
    picture.lower = lower - margin;
    picture.upper = upper + margin;
    std::tie(picture.lowest, picture.highest) = heightsOf(chart);
    return picture;
}

recording::BakeCharts::Cells cellsOf(const authoring::ChartMap& map) {
    recording::BakeCharts::Cells cells;
    cells.minimum = map.grid.minimum;
    cells.size = map.grid.cell_size;
    cells.width = map.grid.width;
    cells.height = map.grid.height;
    cells.charts.reserve(map.cells.size());
    for (const gpu::ChartCell& cell : map.cells)
        cells.charts.push_back(static_cast<std::uint16_t>(cell.charts & 0xffffu));
    return cells;
}

}  // namespace

void describePictures(const LoadedLayout& loaded, recording::BakeDescription& bake) {
    if (!bake.charts) return;
    // A person's cell reaches so far over the edge of its floor.
    const double margin = std::max(loaded.layout.simulation.tile_radius, double{loaded.scene.largest_radius});
    std::set<std::string> taken;
    for (const authoring::Chart& chart : loaded.scene.charts->charts) {
        Picture picture = pictureOf(chart, loaded.scene.charts->charts, margin);
        const std::string name = picture.name;
        for (int number = 2; !taken.insert(picture.name).second; ++number)
            picture.name = fmt::format("{} ({})", name, number);
        bake.charts->pictures.push_back(std::move(picture));
    }
    bake.charts->cells = cellsOf(loaded.scene.chart_map);
}

}  // namespace throng::cli
