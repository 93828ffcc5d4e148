// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/camera_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace throng::io {

CameraView::CameraView(const authoring::View& view, glm::dvec3 origin, double margin, double range)
    : size_(view.size), shift_(view.shift), parallel_(view.parallel), margin_(margin), range_(range) {
    const std::array<double, 16>& m = view.matrix;
    glm::dmat4 to_world(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            to_world[column][row] = m[4 * static_cast<std::size_t>(row) + static_cast<std::size_t>(column)];
    for (int axis = 0; axis < 3; ++axis) {  // a camera that is scaled looks no other way
        to_world[axis] /= glm::length(glm::dvec3(to_world[axis]));
        to_world[3][axis] -= origin[axis];
    }
    to_camera_ = glm::inverse(to_world);
}

/// The line is cut down by each side of the picture in turn; what is left of it is seen.
bool CameraView::sees(glm::dvec3 feet, double height) const {
    const glm::dvec3 low(to_camera_ * glm::dvec4(feet, 1.0));
    const glm::dvec3 high(to_camera_ * glm::dvec4(feet + glm::dvec3(0.0, 0.0, height), 1.0));
    double from = 0.0, to = 1.0;
    const auto keep = [&](double at_low, double at_high) {  // where it is not below zero
        if (at_low < 0.0 && at_high < 0.0) to = -1.0;
        if ((at_low < 0.0) == (at_high < 0.0)) return;
        const double crossing = at_low / (at_low - at_high);
        if (at_low < 0.0)
            from = std::max(from, crossing);
        else
            to = std::min(to, crossing);
    };
    keep(-low.z + margin_, -high.z + margin_);
    keep(range_ + low.z, range_ + high.z);
    for (int axis = 0; axis < 2; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const double edge = side * shift_[axis] + 0.5 * size_[axis];  // m, at 1 m
            const double slant = parallel_ ? 1.0 : std::hypot(1.0, edge);
            const auto inside = [&](glm::dvec3 point) {
                const double limit = parallel_ ? edge : -point.z * edge;
                return (limit - side * point[axis]) / slant + margin_;
            };
            keep(inside(low), inside(high));
        }
    return from <= to;
}

}  // namespace throng::io
