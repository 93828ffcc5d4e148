// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/chart_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <queue>

namespace throng::authoring {
namespace {

constexpr std::array kBeside = {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)};

std::uint32_t imageIn(std::uint32_t images, std::uint32_t place) {
    return images >> (8 * place) & gpu::NO_CHART;
}

std::uint32_t imageCount(std::uint32_t images) {
    std::uint32_t count = 0;
    while (count < gpu::MOST_IMAGES && imageIn(images, count) != gpu::NO_CHART)
        ++count;
    return count;
}

/// @returns the same with one more, unless it is among them or there are as many as there may be
std::uint32_t withImage(std::uint32_t images, std::uint32_t chart) {
    const std::uint32_t count = imageCount(images);
    if (count == gpu::MOST_IMAGES) return images;
    for (std::uint32_t place = 0; place < count; ++place)
        if (imageIn(images, place) == chart) return images;
    return (images & ~(gpu::NO_CHART << (8 * count))) | chart << (8 * count);
}

/// Whether a place lies beside a link, further down or up its slope than people there heed who is beyond its
/// railing.
bool isAlongside(const Chart& chart, glm::ivec2 cell) {
    constexpr double kHeeded = 0.5;  // m: about as far as a railing hides little of who stands behind it
    if (!chart.is_link || chart.is_cabin) return false;
    const glm::dvec2 place = chartCellMiddle(cell);
    const double along = chart.link.alongOf(place);
    return !chart.contains(place) && std::min(along, chart.link.length - along) > kHeeded;
}

}  // namespace

glm::ivec2 chartCellOf(glm::dvec2 home) {
    return glm::ivec2(glm::floor(home / kChartCell));
}

ChartRaster::ChartRaster(const std::vector<Chart>& charts, std::size_t chart, double reach) {
    const auto [lower, upper] = charts[chart].bounds();
    first_ = chartCellOf(lower - reach) - 1;
    size_ = chartCellOf(upper + reach) + 2 - first_;
    owners_.assign(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y), gpu::NO_CHART);
    images_.assign(owners_.size(), gpu::NO_IMAGES);
    claimOwn(charts[chart], chart);
    goOn(charts, chart, reach);
    castImages(reach);
}

std::size_t ChartRaster::indexOf(glm::ivec2 cell) const {
    const glm::ivec2 at = cell - first_;
    return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size_.x) +
           static_cast<std::size_t>(at.x);
}

bool ChartRaster::isInside(glm::ivec2 cell) const {
    const glm::ivec2 at = cell - first_;
    return at.x >= 0 && at.y >= 0 && at.x < size_.x && at.y < size_.y;
}

std::uint32_t ChartRaster::ownerAt(glm::ivec2 cell) const {
    return isInside(cell) ? owners_[indexOf(cell)] : gpu::NO_CHART;
}

std::uint32_t ChartRaster::ownerOf(glm::dvec2 home) const {
    return ownerAt(chartCellOf(home));
}

std::uint32_t ChartRaster::imagesAt(glm::ivec2 cell) const {
    return isInside(cell) ? images_[indexOf(cell)] : gpu::NO_IMAGES;
}

bool ChartRaster::isJoinedTo(std::size_t other) const {
    return std::any_of(gates_.begin(), gates_.end(), [&](const Gate& gate) { return gate.chart == other; });
}

void ChartRaster::claimOwn(const Chart& chart, std::size_t index) {
    for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x) {
            const glm::ivec2 cell = first_ + glm::ivec2(x, y);
            if (chart.contains(chartCellMiddle(cell)))
                owners_[indexOf(cell)] = static_cast<std::uint8_t>(index);
        }
}

/// Goes on over seams, and over the seams of the charts beyond these, from cell to cell: ground that lies
/// above or below is not reached that way, nor what is beyond a railing's end further than somebody there
/// would sense.
void ChartRaster::goOn(const std::vector<Chart>& charts, std::size_t own, double reach) {
    struct Reached {
        glm::ivec2 cell, seam;
    };
    std::queue<Reached> reached;
    const auto enter = [&](glm::ivec2 from, std::size_t from_chart, glm::ivec2 cell) {
        const glm::dvec2 here = chartCellMiddle(from), there = chartCellMiddle(cell);
        for (std::size_t chart = 0; chart < charts.size(); ++chart) {
            if (chart == from_chart || !charts[chart].contains(there) ||
                !areJoined(charts[from_chart], from_chart, here, charts[chart], chart, there))
                continue;
            owners_[indexOf(cell)] = static_cast<std::uint8_t>(chart);
            gates_.push_back({cell, static_cast<std::uint32_t>(chart)});
            return true;
        }
        return false;
    };
    for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x) {
            const glm::ivec2 cell = first_ + glm::ivec2(x, y);
            if (ownerAt(cell) != own) continue;
            for (const glm::ivec2 side : kBeside)
                if (isInside(cell + side) && ownerAt(cell + side) == gpu::NO_CHART &&
                    enter(cell, own, cell + side))
                    reached.push({cell + side, cell});
        }
    while (!reached.empty()) {
        const auto [cell, seam] = reached.front();
        reached.pop();
        const std::size_t chart = ownerAt(cell);
        for (const glm::ivec2 side : kBeside) {
            const glm::ivec2 next = cell + side;
            if (!isInside(next) || ownerAt(next) != gpu::NO_CHART || isAlongside(charts[own], next) ||
                glm::distance(glm::dvec2(next), glm::dvec2(seam)) * kChartCell > reach)
                continue;
            if (charts[chart].contains(chartCellMiddle(next)))
                owners_[indexOf(next)] = static_cast<std::uint8_t>(chart);
            else if (!enter(cell, chart, next))
                continue;
            reached.push({next, seam});
        }
    }
}

void ChartRaster::castImages(double reach) {
    const int cells = static_cast<int>(std::ceil(reach / kChartCell));
    for (const Gate& gate : gates_)
        for (int dy = -cells; dy <= cells; ++dy)
            for (int dx = -cells; dx <= cells; ++dx) {
                const glm::ivec2 cell = gate.cell + glm::ivec2(dx, dy);
                if (dx * dx + dy * dy > cells * cells || !isInside(cell)) continue;
                std::uint32_t& images = images_[indexOf(cell)];
                images = withImage(images, gate.chart);
            }
}

void ChartRaster::leaveOutUnseen(const std::vector<Chart>& charts, const std::vector<ChartRaster>& rasters,
                                 std::size_t own) {
    for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x) {
            const glm::ivec2 cell = first_ + glm::ivec2(x, y);
            const std::uint32_t owner = ownerAt(cell);  // another chart's: for who is over a seam already
            if (owner == gpu::NO_CHART) continue;
            std::uint32_t& images = images_[indexOf(cell)];
            std::uint32_t left = gpu::NO_IMAGES;
            for (std::uint32_t place = 0; place < imageCount(images); ++place) {
                const std::uint32_t there = imageIn(images, place), seen = rasters[there].ownerAt(cell);
                const bool is_alongside = owner == own && isAlongside(charts[there], cell);
                if ((seen == gpu::NO_CHART || seen == owner) && !is_alongside) left = withImage(left, there);
            }
            images = left;
        }
}

std::uint32_t ChartRaster::mostImages() const {
    std::uint32_t most = 0;
    for (const std::uint32_t images : images_)
        most = std::max(most, imageCount(images));
    return most;
}

}  // namespace throng::authoring
