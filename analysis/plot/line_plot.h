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
};

struct LinePlot {
    std::string title;
    std::string note;  ///< small, under the title
    std::string x, y;  ///< what the axes say
    std::vector<PlotSeries> series;
};

/// Draws the plot as PNG; the names stand at the lines' ends, spread so that they do not cover each other.
/// Points that are no numbers are left out. Throws OutputError.
void writeLinePlot(const std::filesystem::path& path, const LinePlot& plot);

}  // namespace throng::analysis
