// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/routes.h"

#include <fmt/format.h>

#include "authoring/scene/raster.h"

namespace throng::authoring {
namespace {

/// All fields together stay below this, on the device and here.
constexpr std::size_t kMostFieldBytes = std::size_t{128} << 20;

}  // namespace

Routes::Routes(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry,
               const FieldGrid& grid)
    : layout_(layout), rebase_(rebase), geometry_(geometry), grid_(grid) {}

LocalPolygon Routes::outline(const Place& place, float depth) const {
    if (place.kind == Place::Kind::area) return rebase_.local(layout_.areas[place.index].polygon);
    const Road& road = layout_.roads[place.index];
    const std::vector<glm::vec2> line = rebase_.local(road.centreline);
    const bool start = place.kind == Place::Kind::road_start;
    const glm::vec2 end = start ? line.front() : line.back();
    const glm::vec2 next = start ? line[1] : line[line.size() - 2];
    const glm::vec2 inward = glm::normalize(next - end);
    const glm::vec2 aside = glm::vec2(-inward.y, inward.x) * static_cast<float>(0.5 * road.width);
    const glm::vec2 reach = inward * std::min(depth, glm::distance(end, next));
    return {end - aside, end + aside, end + reach + aside, end + reach - aside};
}

std::string Routes::name(const Place& place) const {
    if (place.kind == Place::Kind::area) return layout_.areas[place.index].id;
    return layout_.roads[place.index].id + (place.kind == Place::Kind::road_start ? ":start" : ":end");
}

const WalkMap& Routes::mapFor(bool keep_to_roads) {
    std::optional<WalkMap>& map = maps_[keep_to_roads ? 1 : 0];
    if (!map) map = makeWalkMap(geometry_, grid_, keep_to_roads);
    return *map;
}

bool Routes::hasRoom() const {
    return (fields_.size() + 1) * cellCount(grid_) * sizeof(gpu::FieldCell) <= kMostFieldBytes;
}

std::uint32_t Routes::solve(const std::vector<std::uint32_t>& targets, bool keep_to_roads) {
    if (!hasRoom()) {
        too_many_ = true;
        return 0;
    }
    fields_.push_back(solveField(mapFor(keep_to_roads), targets));
    return static_cast<std::uint32_t>(fields_.size() - 1);
}

std::uint32_t Routes::fieldTo(const Place& place, bool keep_to_roads) {
    const auto [entry, is_new] =
        known_.try_emplace(fmt::format("{}{}", keep_to_roads ? "on roads to " : "to ", name(place)), 0);
    if (is_new) entry->second = solve(cellsInPolygon(grid_, outline(place, kTargetDepth)), keep_to_roads);
    return entry->second;
}

/// The largest square around the point's cell, of those that halving kSurroundings gives, that nothing
/// blocks.
std::vector<std::uint32_t> Routes::clearSquare(glm::vec2 point) {
    const WalkMap& map = mapFor(false);
    const std::uint32_t cell = cellAt(grid_, point);
    const std::uint32_t x = cell % grid_.width;
    const std::uint32_t y = cell / grid_.width;
    auto side = static_cast<std::uint32_t>(kSurroundings / grid_.cell_size);
    for (; side > 1; side /= 2) {
        const std::uint32_t x0 = x / side * side;
        const std::uint32_t y0 = y / side * side;
        std::vector<std::uint32_t> cells;
        bool clear = true;
        for (std::uint32_t j = y0; clear && j < std::min(y0 + side, grid_.height); ++j)
            for (std::uint32_t i = x0; clear && i < std::min(x0 + side, grid_.width); ++i) {
                cells.push_back(j * grid_.width + i);
                clear = map.cost[cells.back()] < kUnreachable;
            }
        if (clear) return cells;
    }
    return {cell};
}

std::uint32_t Routes::fieldTo(glm::vec2 point) {
    const std::vector<std::uint32_t> targets = clearSquare(point);
    const std::string name = fmt::format("to {} cells from {}", targets.size(), targets.front());
    if (const auto known = known_.find(name); known != known_.end()) return known->second;
    if (!hasRoom()) return gpu::NO_INDEX;
    return known_[name] = solve(targets, false);
}

float Routes::reachable(std::uint32_t field, glm::vec2 from) const {
    return fields_.empty() ? 0.0f : fields_[field].reachable[cellAt(grid_, from)];
}

float Routes::reachable(std::uint32_t field, const LocalPolygon& from) const {
    if (fields_.empty()) return 0.0f;
    float least = kUnreachable;
    for (const std::uint32_t cell : cellsInPolygon(grid_, from))
        least = std::min(least, fields_[field].reachable[cell]);
    return least;
}

std::vector<gpu::FieldCell> Routes::takeCells() {
    std::vector<gpu::FieldCell> cells;
    cells.reserve(fields_.size() * cellCount(grid_));
    for (const Field& field : fields_)
        cells.insert(cells.end(), field.cells.begin(), field.cells.end());
    fields_.clear();
    return cells;
}

}  // namespace throng::authoring
