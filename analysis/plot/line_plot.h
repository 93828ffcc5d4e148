// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace throng::analysis {

struct PlotSeries {
    std::string name;
    std::vector<glm::dvec2> points;  ///< in the order in which they are joined
    bool dashed = false;
    bool markers = true;  ///< a dot at each point
    int colour = -1;      ///< series of one number share a colour; -1: its place among the series
};

struct PlotAxis {
    std::string label;
    bool logarithmic = false;
    /// Both zero: whatever the points need.
    double minimum = 0.0;
    double maximum = 0.0;
};

struct LinePlot {
    std::string title;
    std::string note;  ///< small, under the title
    PlotAxis x, y;
    std::vector<PlotSeries> series;
    int width = 1200;  ///< px
    int height = 760;  ///< px
};

/// Draws the plot as PNG; the names stand at the lines' ends, spread so that they do not cover each other.
/// Points that a logarithmic axis cannot show are left out. Throws OutputError.
void writeLinePlot(const std::filesystem::path& path, const LinePlot& plot);

}  // namespace throng::analysis
