// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/lane_line.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace throng::authoring {

double LaneLine::alongAt(glm::dvec2 place) const {
    double least = 1.0e300, found = 0.0, before = 0.0;
    for (std::size_t i = 1; i < points_.size(); ++i) {
        const glm::dvec2 axis = points_[i] - points_[i - 1];
        const double length = glm::length(axis);
        const double along = std::clamp(glm::dot(place - points_[i - 1], axis) / length, 0.0, length);
        const double apart = glm::distance(place, points_[i - 1] + axis * (along / length));
        if (apart < least) {
            least = apart;
            found = before + along;
        }
        before += length;
    }
    return found;
}

std::size_t LaneLine::pieceAt(double along, double& before) const {
    before = 0.0;
    for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
        const double length = glm::distance(points_[i], points_[i - 1]);
        if (along < before + length) return i;
        before += length;
    }
    return points_.size() - 1;
}

glm::dvec2 LaneLine::placeAt(double along) const {
    double before = 0.0;
    const std::size_t end = pieceAt(along, before);
    return points_[end - 1] + glm::normalize(points_[end] - points_[end - 1]) * (along - before);
}

glm::dvec2 LaneLine::wayAt(double along) const {
    double before = 0.0;
    const std::size_t end = pieceAt(along, before);
    return glm::normalize(points_[end] - points_[end - 1]);
}

}  // namespace throng::authoring
