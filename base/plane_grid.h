// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

namespace throng {

/// Cells for so many things: emptying them all for every frame must not be most of the work.
inline double cellsFor(std::size_t things) {
    return std::min(4.0e6, 4096.0 + 16.0 * static_cast<double>(things));
}

/// Things with a place in the plane, sorted into square cells, so that those near a place are found fast.
class PlaneGrid {
  public:
    /// @param cell m; enlarged where the bounds would need more cells than `most`
    PlaneGrid(glm::dvec2 minimum, glm::dvec2 maximum, double cell, double most = 4.0e6) : minimum_(minimum) {
        const glm::dvec2 extent =
            glm::dvec2(std::max(maximum.x - minimum.x, 1.0), std::max(maximum.y - minimum.y, 1.0));
        // Of bounds that are long and thin, their length alone may make too many.
        cell_ = std::max(
            {cell, std::sqrt(extent.x * extent.y / most), 4.0 * std::max(extent.x, extent.y) / most});
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

    /// How many cells and things near() looks at, up to `enough` or a line of cells more.
    std::size_t workNear(glm::dvec2 place, double reach, std::size_t enough) const {
        const int x0 = column(place.x - reach), x1 = column(place.x + reach);
        std::size_t work = 0;
        for (int y = line(place.y - reach); y <= line(place.y + reach) && work <= enough; ++y) {
            const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
            work += static_cast<std::size_t>(x1 - x0 + 1) +
                    starts_[first + static_cast<std::size_t>(x1) + 1] -
                    starts_[first + static_cast<std::size_t>(x0)];
        }
        return work;
    }

    /// Whether near() would find nothing at all.
    bool isEmptyNear(glm::dvec2 place, double reach) const {
        const auto x0 = static_cast<std::size_t>(column(place.x - reach)),
                   x1 = static_cast<std::size_t>(column(place.x + reach));
        for (int y = line(place.y - reach); y <= line(place.y + reach); ++y) {
            const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
            if (starts_[first + x0] != starts_[first + x1 + 1]) return false;
        }
        return true;
    }

    /// Calls visit(index) for all within `reach` of `place`, and for some further away.
    template <class Visit>
    void near(glm::dvec2 place, double reach, Visit&& visit) const {
        const int x0 = column(place.x - reach), x1 = column(place.x + reach);
        for (int y = line(place.y - reach); y <= line(place.y + reach); ++y)
            visitCells(y, x0, x1, visit);
    }

    /// Calls visit(index) for all within `reach` of the straight line between two places, and for some
    /// further away.
    template <class Visit>
    void nearSegment(glm::dvec2 from, glm::dvec2 to, double reach, Visit&& visit) const {
        if (from.y > to.y) std::swap(from, to);
        const double rise = to.y - from.y, hair = 1.0e-6 * cell_;
        for (int y = line(from.y - reach); y <= line(to.y + reach); ++y) {
            // What of it comes near this line of cells, as a share; the first and the last hold all beyond
            // them.
            const double below = minimum_.y + y * cell_ - reach - hair - from.y;
            const double above = below + cell_ + 2.0 * (reach + hair);
            const double first = y > 0 && rise > 0.0 ? std::clamp(below / rise, 0.0, 1.0) : 0.0;
            const double last = y + 1 < height_ && rise > 0.0 ? std::clamp(above / rise, 0.0, 1.0) : 1.0;
            const double x0 = std::lerp(from.x, to.x, first), x1 = std::lerp(from.x, to.x, last);
            visitCells(y, column(std::min(x0, x1) - reach - hair), column(std::max(x0, x1) + reach + hair),
                       visit);
        }
    }

  private:
    template <class Visit>
    void visitCells(int y, int x0, int x1, Visit&& visit) const {
        const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
        for (std::uint32_t i = starts_[first + static_cast<std::size_t>(x0)];
             i < starts_[first + static_cast<std::size_t>(x1) + 1]; ++i)
            visit(items_[i]);
    }

    int column(double x) const { return clamped((x - minimum_.x) / cell_, width_); }
    int line(double y) const { return clamped((y - minimum_.y) / cell_, height_); }
    /// What lies outside, however far, belongs to the cells at the edge.
    static int clamped(double at, int count) {
        return at > 0.0 ? static_cast<int>(std::min(at, static_cast<double>(count - 1))) : 0;
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
