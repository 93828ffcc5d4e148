// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/chart_map.h"
#include "authoring/scene/raster.h"

namespace throng::authoring {
namespace {

/// The lower envelope of parabolas, in one dimension: squared distance to the nearest zero
/// (Felzenszwalb and Huttenlocher 2012).
class EnvelopePass {
  public:
    explicit EnvelopePass(std::size_t length) : sites_(length), bounds_(length + 1), values_(length) {}

    void run(float* data, std::size_t length, std::size_t stride) {
        for (std::size_t i = 0; i < length; ++i)
            values_[i] = data[i * stride];
        std::size_t last = 0;
        sites_[0] = 0;
        bounds_[0] = -kFar;
        bounds_[1] = kFar;
        for (std::size_t i = 1; i < length; ++i) {
            double meet = meeting(i, sites_[last]);
            while (meet <= bounds_[last])
                meet = meeting(i, sites_[--last]);
            sites_[++last] = i;
            bounds_[last] = meet;
            bounds_[last + 1] = kFar;
        }
        std::size_t site = 0;
        for (std::size_t i = 0; i < length; ++i) {
            while (bounds_[site + 1] < static_cast<double>(i))
                ++site;
            const double offset = static_cast<double>(i) - static_cast<double>(sites_[site]);
            data[i * stride] = static_cast<float>(offset * offset + values_[sites_[site]]);
        }
    }

    static constexpr float kNothing = 1.0e12f;  // squared cells: no zero anywhere

  private:
    static constexpr double kFar = 1.0e18;

    double meeting(std::size_t right, std::size_t left) const {
        const auto r = static_cast<double>(right);
        const auto l = static_cast<double>(left);
        return (values_[right] + r * r - values_[left] - l * l) / (2.0 * (r - l));
    }

    std::vector<std::size_t> sites_;
    std::vector<double> bounds_;
    std::vector<double> values_;
};

/// Distance in cells from every centre to the nearest centre where `mask` equals `wanted`.
std::vector<float> distanceTo(const std::vector<bool>& mask, bool wanted, const FieldGrid& grid) {
    std::vector<float> squared(mask.size());
    for (std::size_t cell = 0; cell < mask.size(); ++cell)
        squared[cell] = mask[cell] == wanted ? 0.0f : EnvelopePass::kNothing;
    EnvelopePass pass(std::max(grid.width, grid.height));
    for (std::uint32_t x = 0; x < grid.width; ++x)
        pass.run(&squared[x], grid.height, grid.width);
    for (std::uint32_t y = 0; y < grid.height; ++y)
        pass.run(&squared[std::size_t{y} * grid.width], grid.width, 1);
    for (float& value : squared)
        value = std::sqrt(value);
    return squared;
}

/// Links have no kerbs, and what lies beyond a seam goes on.
void goOnOverSeams(const ChartMap& charts, const FieldGrid& grid, std::vector<bool>& inside) {
    for (std::uint32_t cell = 0; cell < inside.size(); ++cell) {
        const std::uint32_t chart = charts.chartAt(cellCentre(grid, cell % grid.width, cell / grid.width));
        if (chart != gpu::NO_CHART && charts.is_link[chart]) inside[cell] = true;
    }
    for (const auto& [image, owner] : seamCellsOf(charts, grid).shown)
        inside[image] = inside[owner];
}

}  // namespace

// The union is rasterised first and measured afterwards: pieces that only share an edge (a road that ends at
// a plaza) then have no edge between them, which the distances to each piece would show.
std::vector<float> roadDistance(const WalkGeometry& geometry, const FieldGrid& grid) {
    if (!geometry.hasKerbs()) return {};
    const float seam = 0.25f * grid.cell_size;
    std::vector<bool> inside(cellCount(grid), false);
    for (const LocalRoad& road : geometry.roads)
        markRoad(grid, road, seam, inside);
    for (const LocalPolygon& area : geometry.areas)
        for (const std::uint32_t cell : cellsInPolygon(grid, area))
            inside[cell] = true;

    if (geometry.charts) goOnOverSeams(*geometry.charts, grid, inside);

    const std::vector<float> to_outside = distanceTo(inside, false, grid);
    const std::vector<float> to_inside = distanceTo(inside, true, grid);
    std::vector<float> distance(inside.size());
    for (std::size_t cell = 0; cell < distance.size(); ++cell)
        distance[cell] = (inside[cell] ? to_outside[cell] - 0.5f : 0.5f - to_inside[cell]) * grid.cell_size;
    return distance;
}

}  // namespace throng::authoring
