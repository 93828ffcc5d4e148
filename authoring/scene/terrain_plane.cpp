// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "authoring/scene/chart_map.h"
#include "authoring/scene/slope_costs.h"
#include "authoring/scene/terrain_charts.h"

namespace throng::authoring {

PlaneGround planeGroundOf(const Charts& charts, const ChartMap& map, glm::dvec2 origin) {
    constexpr int kSpread = 2;  // cells: so far beyond its edges, ground has a height
    PlaneGround plane;
    plane.minimum = map.grid.minimum;
    plane.cell = map.grid.cell_size;
    plane.width = map.grid.width;
    plane.height = map.grid.height;
    plane.cells.assign(map.cells.size(), {std::numeric_limits<float>::quiet_NaN(), glm::vec2(0.0f)});
    glm::dvec2 lower(std::numeric_limits<double>::max()), upper = -lower;
    for (const Chart& chart : charts.charts) {
        lower = glm::min(lower, chart.bounds().first - charts.reach - 1.0);
        upper = glm::max(upper, chart.bounds().second + charts.reach + 1.0);
    }
    plane.lower = glm::vec2(lower - origin);
    plane.upper = glm::vec2(upper - origin);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
        const std::uint32_t chart = map.cells[i].charts & gpu::NO_CHART,
                            owner = map.cells[i].charts >> 8 & gpu::NO_CHART;
        if (chart == gpu::NO_CHART || owner == gpu::NO_CHART) continue;
        const glm::uvec2 at(i % map.grid.width, i / map.grid.width);
        const glm::vec2 place = map.grid.minimum + (glm::vec2(at) + 0.5f) * map.grid.cell_size;
        const glm::dvec2 home = origin + glm::dvec2(place - map.shifts[chart]);
        plane.cells[i] = {static_cast<float>(charts.charts[owner].heightAt(home)), map.shifts[chart]};
    }
    for (int round = 0; round < kSpread; ++round) {
        const std::vector<PlaneGround::Cell> before = plane.cells;
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (!std::isnan(before[i].height) || (map.cells[i].charts & gpu::NO_CHART) == gpu::NO_CHART)
                continue;
            const std::size_t x = i % plane.width;
            for (const std::size_t beside :
                 {x > 0 ? i - 1 : i, x + 1 < plane.width ? i + 1 : i, i >= plane.width ? i - plane.width : i,
                  i + plane.width < before.size() ? i + plane.width : i})
                if (!std::isnan(before[beside].height)) {
                    plane.cells[i] = before[beside];
                    break;
                }
        }
    }
    return plane;
}

std::vector<float> slopeCosts(const Terrain& terrain, const ChartMap& map, const MotionSettings& motion) {
    const SlopeCosts costs(motion);
    std::vector<float> result(map.cells.size(), 1.0f);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
        const std::uint32_t owner = map.cells[i].charts >> 8 & gpu::NO_CHART;
        // Links cost what they cost as a whole.
        if (owner == gpu::NO_CHART || map.is_link[owner]) continue;
        const glm::vec2 at = map.grid.minimum +
                             (glm::vec2(i % map.grid.width, i / map.grid.width) + 0.5f) * map.grid.cell_size;
        result[i] = costs.of(glm::length(terrain.slopeAt(at)), terrain.stepsAt(at) > 0.5f);
    }
    return result;
}

}  // namespace throng::authoring
