// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/row_line.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace throng::authoring {
namespace {

/// To the left of a direction.
glm::dvec2 leftOf(glm::dvec2 way) {
    return {-way.y, way.x};
}

}  // namespace

RowLine::RowLine(const SeatBlock& block, double back) {
    const std::vector<glm::dvec2>& front = block.front;
    std::vector<glm::dvec2> left;
    for (std::size_t i = 0; i + 1 < front.size(); ++i)
        left.push_back(leftOf(glm::normalize(front[i + 1] - front[i])));
    for (std::size_t i = 0; i < front.size(); ++i) {
        const glm::dvec2 before = left[i == 0 ? 0 : i - 1], after = left[std::min(i, left.size() - 1)];
        const glm::dvec2 sum = before + after;
        points_.push_back(front[i] - back * 2.0 * sum / glm::dot(sum, sum));
        shares_.push_back(i == 0 ? 0.0 : shares_.back() + glm::distance(front[i], front[i - 1]));
    }
    for (double& share : shares_)
        share /= shares_.back();
    left_ = std::move(left);
}

double RowLine::lengthBetween(double from, double to) const {
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
        const double low = std::max(from, shares_[i]), high = std::min(to, shares_[i + 1]);
        if (high > low) length += lengthOfPiece(i) * (high - low) / (shares_[i + 1] - shares_[i]);
    }
    return length;
}

double RowLine::advance(double from, double metres) const {
    if (metres < 0.0) return advance(0.0, std::max(lengthBetween(0.0, from) + metres, 0.0));
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
        if (shares_[i + 1] <= from) continue;
        const double low = std::max(from, shares_[i]);
        const double per_share = lengthOfPiece(i) / (shares_[i + 1] - shares_[i]);
        const double rest = (shares_[i + 1] - low) * per_share;
        if (metres <= rest) return low + metres / per_share;
        metres -= rest;
    }
    return 1.0;
}

glm::dvec2 RowLine::at(double share) const {
    const std::size_t i = pieceAt(share);
    const double u = (share - shares_[i]) / (shares_[i + 1] - shares_[i]);
    return points_[i] + u * (points_[i + 1] - points_[i]);
}

std::vector<glm::dvec2> RowLine::between(double from, double to) const {
    std::vector<glm::dvec2> line{at(from)};
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (shares_[i] > from + 1.0e-9 && shares_[i] < to - 1.0e-9) line.push_back(points_[i]);
    line.push_back(at(to));
    return line;
}

bool RowLine::goesOn() const {
    for (std::size_t i = 0; i + 1 < points_.size(); ++i)
        if (glm::dot(leftOf(points_[i + 1] - points_[i]), left_[i]) <= 0.0) return false;
    return true;
}

double RowLine::lengthOfPiece(std::size_t i) const {
    return glm::distance(points_[i], points_[i + 1]);
}

std::size_t RowLine::pieceAt(double share) const {
    const auto above = std::upper_bound(shares_.begin() + 1, shares_.end() - 1, share);
    return static_cast<std::size_t>(above - shares_.begin()) - 1;
}

}  // namespace throng::authoring
