// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/chart_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "authoring/scene/raster.h"

namespace throng::authoring {

const gpu::ChartCell& ChartMap::at(glm::vec2 place) const {
    return cells[row(grid, place.y) * grid.width + column(grid, place.x)];
}

glm::vec2 ChartMap::home(glm::vec2 place) const {
    if (empty()) return place;
    const std::uint32_t chart = chartAt(place);
    return chart == gpu::NO_CHART ? place : place - shifts[chart];
}

float costOfLink(const MotionSettings& motion, bool stairs, double slope) {
    constexpr double kFlat = 1.34;  // m/s
    if (!motion.isOn("slope_pace")) return 1.0f;
    const auto number = [&](const char* name) { return motion.number("slope_pace", name); };
    const auto pace = [&](double rise) {
        if (!stairs)
            return std::exp(-number("hiking") *
                            (std::abs(rise + number("fastest_down")) - number("fastest_down")));
        const double least = number(rise > 0.0 ? "stairs_up" : "stairs_down") / kFlat;
        return 1.0 + (least - 1.0) * std::min(std::abs(rise) / number("stairs_rise"), 1.0);
    };
    return static_cast<float>(std::max(1.0, 0.5 * (1.0 / pace(slope) + 1.0 / pace(-slope))));
}

ChartMap makeChartMap(const Charts& charts, glm::vec2 minimum, glm::vec2 maximum, glm::dvec2 origin) {
    ChartMap map;
    map.grid.minimum = minimum;
    map.grid.cell_size = static_cast<float>(kChartCell);
    map.grid.width = static_cast<std::uint32_t>(std::ceil((maximum.x - minimum.x) / map.grid.cell_size));
    map.grid.height = static_cast<std::uint32_t>(std::ceil((maximum.y - minimum.y) / map.grid.cell_size));
    map.cells.assign(cellCount(map.grid), {gpu::NO_CHART | gpu::NO_CHART << 8, gpu::NO_IMAGES});
    map.most_images = charts.most_images;
    const glm::ivec2 corner = chartCellOf(origin + glm::dvec2(minimum) + 0.5 * kChartCell);
    for (std::uint32_t chart = 0; chart < charts.charts.size(); ++chart) {
        const ChartRaster& raster = charts.rasters[chart];
        map.shifts.emplace_back(charts.charts[chart].shift);
        const Chart& each = charts.charts[chart];
        map.is_link.push_back(each.is_link);
        map.costs.push_back(each.is_link
                                ? costOfLink(charts.plane.simulation.motion,
                                             charts.plane.links[each.index].kind == Link::Kind::stairs,
                                             (each.link.high - each.link.low) / each.link.length)
                                : 1.0f);
        const glm::ivec2 shift(glm::round(charts.charts[chart].shift / kChartCell));
        for (int y = 0; y < raster.size().y; ++y)
            for (int x = 0; x < raster.size().x; ++x) {
                const glm::ivec2 cell = raster.first() + glm::ivec2(x, y);
                const glm::ivec2 at = cell + shift - corner;
                if (at.x < 0 || at.y < 0 || at.x >= static_cast<int>(map.grid.width) ||
                    at.y >= static_cast<int>(map.grid.height))
                    continue;
                map.cells[static_cast<std::size_t>(at.y) * map.grid.width + static_cast<std::size_t>(at.x)] =
                    {chart | raster.ownerAt(cell) << 8, raster.imagesAt(cell)};
            }
    }
    return map;
}

SeamCells seamCellsOf(const ChartMap& map, const FieldGrid& grid) {
    SeamCells seams;
    seams.blocked.assign(cellCount(grid), 0);
    seams.owner_of.resize(cellCount(grid));
    for (std::uint32_t y = 0; y < grid.height; ++y)
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const std::uint32_t cell = y * grid.width + x;
            seams.owner_of[cell] = cell;
            const glm::vec2 middle = cellCentre(grid, x, y);
            const gpu::ChartCell here = map.at(middle);
            const std::uint32_t chart = here.charts & gpu::NO_CHART, owner = here.charts >> 8 & gpu::NO_CHART;
            if (owner == chart && owner != gpu::NO_CHART) continue;
            seams.blocked[cell] = 1;
            if (owner == gpu::NO_CHART) continue;
            seams.owner_of[cell] = cellAt(grid, middle + map.shifts[owner] - map.shifts[chart]);
            seams.shown.push_back({cell, seams.owner_of[cell]});
        }
    std::sort(seams.shown.begin(), seams.shown.end(),
              [](const SeamCells::Shown& a, const SeamCells::Shown& b) {
                  return std::pair(a.owner, a.image) < std::pair(b.owner, b.image);
              });
    return seams;
}

}  // namespace throng::authoring
