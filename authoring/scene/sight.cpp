// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/sight.h"

#include "authoring/scene/raster.h"

namespace throng::authoring {
namespace {

/// How far it is along a ray to the end of the piece of an axis that it is in.
float toEdge(float at, float direction, float lower, float upper) {
    if (direction > 0.0f) return (upper - at) / direction;
    return direction < 0.0f ? (lower - at) / direction : kUnreachable;
}

}  // namespace

Sight::Sight(const FieldGrid& grid)
    : grid_(grid),
      across_((grid.width + kSide - 1) / kSide),
      free_(std::size_t{across_} * ((grid.height + kSide - 1) / kSide), 0),
      roomy_(free_) {}

void Sight::setTileOpen(std::uint32_t tile_x, std::uint32_t tile_y) {
    free_[std::size_t{tile_y} * across_ + tile_x] = roomy_[std::size_t{tile_y} * across_ + tile_x] =
        ~std::uint64_t{0};
}

void Sight::finish(std::size_t most_pieces) {
    const glm::uvec2 cells(grid_.width, grid_.height);
    piece_ = 1;
    while (std::size_t{cells.x / piece_} * (cells.y / piece_) > most_pieces)
        piece_ *= 2;
    pieces_ = cells / piece_;  // what is left over at an end counts as closed
    const std::size_t line = pieces_.x + 1;
    closed_before_.assign(line * (pieces_.y + 1), 0);
    for (std::uint32_t y = 0; y < pieces_.y; ++y) {
        std::uint32_t closed = 0;
        for (std::uint32_t x = 0; x < pieces_.x; ++x) {
            closed += isPieceOpen(x * piece_, y * piece_) ? 0 : 1;
            closed_before_[(y + 1) * line + x + 1] = closed_before_[y * line + x + 1] + closed;
        }
    }
}

bool Sight::isPieceOpen(std::uint32_t first_x, std::uint32_t first_y) const {
    for (std::uint32_t y = first_y; y < first_y + piece_; ++y)
        for (std::uint32_t x = first_x; x < first_x + piece_; ++x)
            if (!(free_[tileOf(x, y)] & roomy_[tileOf(x, y)] & bitOf(x, y))) return false;
    return true;
}

bool Sight::isOpen(glm::vec2 lower, glm::vec2 upper) const {
    const float side = static_cast<float>(piece_) * grid_.cell_size;
    const glm::vec2 first = (lower - grid_.minimum) / side - 1.0f,
                    last = (upper - grid_.minimum) / side + 2.0f;
    if (!(first.x >= 0.0f && first.y >= 0.0f && last.x <= static_cast<float>(pieces_.x) &&
          last.y <= static_cast<float>(pieces_.y)))
        return false;
    const std::size_t line = pieces_.x + 1;
    const auto left = static_cast<std::size_t>(first.x), right = static_cast<std::size_t>(last.x),
               bottom = static_cast<std::size_t>(first.y) * line,
               top = static_cast<std::size_t>(last.y) * line;
    return closed_before_[top + right] - closed_before_[top + left] ==
           closed_before_[bottom + right] - closed_before_[bottom + left];
}

bool Sight::isClear(glm::vec2 from, glm::vec2 to, float close) const {
    constexpr float kHair = 0.01f;  // cells, across the edge
    const glm::vec2 start = (from - grid_.minimum) / grid_.cell_size;
    const glm::vec2 way = (to - from) / grid_.cell_size;
    const float length = glm::length(way), last = length - close / grid_.cell_size;
    const glm::vec2 direction = length > 0.0f ? way / length : glm::vec2(0.0f);
    for (float walked = 0.0f; walked < length;) {
        const glm::vec2 at = start + walked * direction;
        if (at.x < 0.0f || at.y < 0.0f) return false;
        const auto x = static_cast<std::uint32_t>(at.x), y = static_cast<std::uint32_t>(at.y);
        if (x >= grid_.width || y >= grid_.height) return false;
        const std::uint64_t tile = (walked < last ? roomy_ : free_)[tileOf(x, y)];
        if (!(tile & bitOf(x, y))) return false;
        const std::uint32_t piece = ~tile == 0 ? kSide : 1;
        const glm::vec2 lower(x / piece * piece, y / piece * piece);
        const glm::vec2 upper = lower + static_cast<float>(piece);
        walked += std::max(0.0f, std::min(toEdge(at.x, direction.x, lower.x, upper.x),
                                          toEdge(at.y, direction.y, lower.y, upper.y))) +
                  kHair;
    }
    return true;
}

}  // namespace throng::authoring
