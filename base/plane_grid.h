// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace throng {

/// Things with a place in the plane, sorted into square cells, so that those near a place are found fast.
class PlaneGrid {
  public:
    /// @param cell m; enlarged where the bounds would need more than some millions of cells
    PlaneGrid(glm::dvec2 minimum, glm::dvec2 maximum, double cell) : minimum_(minimum) {
        const glm::dvec2 extent =
            glm::dvec2(std::max(maximum.x - minimum.x, 1.0), std::max(maximum.y - minimum.y, 1.0));
        cell_ = std::max(cell, std::sqrt(extent.x * extent.y / 4.0e6));
        width_ = static_cast<int>(extent.x / cell_) + 1;
        height_ = static_cast<int>(extent.y / cell_) + 1;
        starts_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1);
    }

    /// Sorts `places`; what is found later are indices into them.
    void sort(const std::vector<glm::dvec2>& places) {
        std::fill(starts_.begin(), starts_.end(), 0);
        for (const glm::dvec2 place : places)
            ++starts_[cellOf(place) + 1];
        for (std::size_t i = 1; i < starts_.size(); ++i)
            starts_[i] += starts_[i - 1];
        items_.resize(places.size());
        cursors_.assign(starts_.begin(), starts_.end() - 1);
        for (std::uint32_t i = 0; i < places.size(); ++i)
            items_[cursors_[cellOf(places[i])]++] = i;
    }

    /// Calls visit(index) for all within `reach` of `place`, and for some further away.
    template <class Visit>
    void near(glm::dvec2 place, double reach, Visit&& visit) const {
        const int x0 = column(place.x - reach), x1 = column(place.x + reach);
        for (int y = line(place.y - reach); y <= line(place.y + reach); ++y) {
            const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
            for (std::uint32_t i = starts_[first + static_cast<std::size_t>(x0)];
                 i < starts_[first + static_cast<std::size_t>(x1) + 1]; ++i)
                visit(items_[i]);
        }
    }

  private:
    int column(double x) const {
        return std::clamp(static_cast<int>(std::floor((x - minimum_.x) / cell_)), 0, width_ - 1);
    }
    int line(double y) const {
        return std::clamp(static_cast<int>(std::floor((y - minimum_.y) / cell_)), 0, height_ - 1);
    }
    std::size_t cellOf(glm::dvec2 place) const {
        return static_cast<std::size_t>(line(place.y)) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(column(place.x));
    }

    glm::dvec2 minimum_;
    double cell_;
    int width_ = 1, height_ = 1;
    std::vector<std::uint32_t> starts_, cursors_, items_;
};

}  // namespace throng
