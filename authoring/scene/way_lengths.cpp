// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "authoring/scene/raster.h"

// People minimise what a way costs, and where walls are near or roads are left, that is more than its length.
// How long is the way that they take? It leads downhill on the cost, through a point between two neighbours,
// and from there on it is as long as theirs are.
namespace throng::authoring {
namespace {

class LengthTracer {
  public:
    LengthTracer(const WalkMap& map, const std::vector<float>& distance, const std::vector<float>& start)
        : map_(map), distance_(distance), lengths_(distance.size(), kUnreachable) {
        for (std::size_t cell = 0; cell < start.size(); ++cell)
            if (start[cell] < kUnreachable && distance[cell] >= start[cell]) lengths_[cell] = start[cell];
    }

    std::vector<float> run() {
        for (std::uint32_t cell = 0; cell < lengths_.size(); ++cell)
            if (distance_[cell] < kUnreachable && lengths_[cell] == kUnreachable && ownerOf(cell) == cell)
                trace(cell);
        if (map_.seams)
            for (const auto& [image, owner] : map_.seams->shown)
                lengths_[image] = lengths_[owner];
        return std::move(lengths_);
    }

  private:
    /// The better neighbour on an axis, if it is better than the cell.
    struct Neighbour {
        std::uint32_t cell = gpu::NO_INDEX;
        float fall = 0.0f;  // by how much
    };

    /// Cells on the way come first. Every step goes down, so there is an end.
    void trace(std::uint32_t from) {
        waiting_.assign(1, from);
        while (!waiting_.empty()) {
            const std::uint32_t cell = waiting_.back();
            const std::uint32_t width = map_.grid.width, x = cell % width;
            const Neighbour across = lower(cell, 1, x > 0, x + 1 < width, {1.0f, 0.0f});
            const Neighbour along =
                lower(cell, width, cell >= width, cell + width < distance_.size(), {0.0f, 1.0f});
            const std::size_t before = waiting_.size();
            for (const Neighbour& next : {across, along})
                if (next.fall > 0.0f && lengths_[next.cell] == kUnreachable) waiting_.push_back(next.cell);
            if (waiting_.size() > before) continue;
            waiting_.pop_back();
            lengths_[cell] = through(cell, across, along);
        }
    }

    float through(std::uint32_t cell, const Neighbour& across, const Neighbour& along) const {
        const float sum = across.fall + along.fall;
        if (sum <= 0.0f) return distance_[cell];
        float length = map_.grid.cell_size * std::hypot(across.fall, along.fall);
        for (const Neighbour& next : {across, along})
            if (next.fall > 0.0f) length += next.fall * lengths_[next.cell];
        return length / sum;
    }

    Neighbour lower(std::uint32_t cell, std::uint32_t stride, bool has_low, bool has_high,
                    glm::vec2 axis) const {
        Neighbour best;
        const auto look = [&](std::uint32_t next, glm::vec2 step) {
            const float fall = distance_[cell] - distance_[next];
            if (fall > best.fall && mayGo(cell, next, step)) best = {ownerOf(next), fall};
        };
        if (has_low) look(cell - stride, -axis);
        if (has_high) look(cell + stride, axis);
        return best;
    }

    std::uint32_t ownerOf(std::uint32_t cell) const { return map_.seams ? map_.seams->owner_of[cell] : cell; }

    bool mayGo(std::uint32_t cell, std::uint32_t next, glm::vec2 step) const {
        const std::uint8_t side = step.x != 0.0f ? gpu::OPEN_TO_X : gpu::OPEN_TO_Y;
        if (!map_.open_sides.empty() && !(map_.open_sides[std::min(cell, next)] & side)) return false;
        return map_.one_way.empty() || glm::dot(map_.one_way[cell], step) >= gpu::AGAINST_ONE_WAY;
    }

    const WalkMap& map_;
    const std::vector<float>& distance_;
    std::vector<float> lengths_;
    std::vector<std::uint32_t> waiting_;
};

}  // namespace

std::vector<float> wayLengths(const WalkMap& map, const std::vector<float>& distance,
                              const std::vector<float>& start) {
    return LengthTracer(map, distance, start).run();
}

}  // namespace throng::authoring
