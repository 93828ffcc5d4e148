// SPDX-License-Identifier: Apache-2.0
// Charts and their seams (authoring/storeys/charts.h). Without CHARTS, the ground is one, and nobody is an image.

#ifdef CHARTS
#include "shaders/shared/chart_types.h"

layout(std430) readonly buffer ChartCells { ChartCell chart_cells[]; };
layout(std430) readonly buffer ChartShifts { vec2 chart_shifts[]; };  // m, by chart

ChartCell chartCellAt(vec2 position) {
    vec2 at = floor((position - parameters.grid_minimum) / parameters.chart_cell);
    uvec2 cell = uvec2(clamp(at, vec2(0.0), vec2(parameters.chart_width, parameters.chart_height) - 1.0));
    return chart_cells[cell.y * parameters.chart_width + cell.x];
}

/// In whose part of the plane somebody is.
uint chartOf(ChartCell cell) { return cell.charts & NO_CHART; }
/// Whose ground it is that somebody stands on.
uint ownerOf(ChartCell cell) { return (cell.charts >> 8u) & NO_CHART; }

/// Rows of images come after those of people, as many for each image that somebody may have.
uint personOf(uint site_row) { return site_row % parameters.row_count; }

/// m: from a person to what a row of sites has of it.
/// @returns whether there is such an image
bool imageShift(uint site_row, vec2 position, out vec2 shift) {
    shift = vec2(0.0);
    uint image = site_row / parameters.row_count;
    if (image == 0u) return true;
    ChartCell cell = chartCellAt(position);
    uint there = (cell.images >> (8u * (image - 1u))) & NO_CHART;
    if (there == NO_CHART) return false;
    shift = chart_shifts[there] - chart_shifts[chartOf(cell)];
    return true;
}
#else
uint personOf(uint site_row) { return site_row; }
bool imageShift(uint site_row, vec2 position, out vec2 shift) {
    shift = vec2(0.0);
    return true;
}
#endif
