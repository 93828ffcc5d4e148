// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/storeys/chart.h"
#include "shaders/shared/chart_types.h"

namespace throng::authoring {

inline constexpr double kChartCell = 0.25;  ///< m

/// Whose ground is around one chart, as its people see it: its own, and beyond its seams that of others, as
/// far as people sense. Seams are where the owner changes.
///
/// Cells lie on one lattice in home coordinates: cell (i, j) covers kChartCell * (i, j) to
/// kChartCell * (i + 1, j + 1).
class ChartRaster {
  public:
    /// @param reach m: how far people sense
    ChartRaster(const std::vector<Chart>& charts, std::size_t chart, double reach);

    glm::ivec2 first() const { return first_; }
    glm::ivec2 size() const { return size_; }
    /// The chart that owns a cell of the lattice, gpu::NO_CHART where nobody can stand or that is out of
    /// reach.
    std::uint32_t ownerAt(glm::ivec2 cell) const;
    /// As ownerAt(), of the cell around a point.
    std::uint32_t ownerOf(glm::dvec2 home) const;
    /// On which other charts somebody in a cell is present, too; each a byte, gpu::NO_CHART after the last.
    std::uint32_t imagesAt(glm::ivec2 cell) const;
    /// Leaves out images that would be above or below others: where a chart shows other ground than that on
    /// which somebody stands.
    /// @param rasters of all charts
    void keepToOwnGround(const std::vector<ChartRaster>& rasters);
    /// The most of these anywhere.
    std::uint32_t mostImages() const { return most_images_; }
    /// Whether there is any seam to another chart.
    bool isJoinedTo(std::size_t other) const;

  private:
    struct Gate {  ///< where another chart's ground begins
        glm::ivec2 cell;
        std::uint32_t chart;
    };
    std::size_t indexOf(glm::ivec2 cell) const;
    bool isInside(glm::ivec2 cell) const;
    void claimOwn(const Chart& chart, std::size_t index);
    void goOn(const std::vector<Chart>& charts, std::size_t index, double reach);
    void castImages(double reach);

    glm::ivec2 first_{0}, size_{0};
    std::vector<std::uint8_t> owners_;
    std::vector<std::uint32_t> images_;
    std::vector<Gate> gates_;
    std::uint32_t most_images_ = 0;
};

/// The middle of a cell of the lattice, m.
inline glm::dvec2 chartCellMiddle(glm::ivec2 cell) {
    return kChartCell * (glm::dvec2(cell) + 0.5);
}
glm::ivec2 chartCellOf(glm::dvec2 home);

}  // namespace throng::authoring
