// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/ground.h"

#include <algorithm>
#include <type_traits>

#include "authoring/scene/raster.h"

namespace throng::authoring {
namespace {

/// Jams are larger than this, m, and their news should travel fast.
constexpr float kDetourCell = 0.75f;
constexpr double kMostDetourCells = 30'000.0;

template <class T>
void append(std::string& key, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
void appendAll(std::string& key, const std::vector<T>& values) {
    append(key, values.size());
    for (const T& value : values)
        append(key, value);
}

std::string keyOf(const WalkGeometry& geometry, const FieldGrid& grid) {
    std::string key;
    append(key, grid);
    append(key, geometry.minimum);
    append(key, geometry.maximum);
    append(key, geometry.smallest_radius);
    append(key, geometry.largest_radius);
    append(key, geometry.walls.size());
    for (const gpu::WallSegment& wall : geometry.walls) {  // member by member: there may be padding
        append(key, wall.a);
        append(key, wall.b);
        append(key, wall.half_thickness);
    }
    for (const LocalPolygon& solid : geometry.solids)
        appendAll(key, solid);
    append(key, geometry.roads.size());
    for (const LocalRoad& road : geometry.roads) {
        appendAll(key, road.centreline);
        append(key, road.width);
        append(key, road.one_way);
    }
    for (const LocalPolygon& area : geometry.areas)
        appendAll(key, area);
    return key;
}

std::size_t bytesOf(const Field& field) {
    return field.cells.size() * sizeof(gpu::FieldCell) + field.reachable.size() * sizeof(float);
}

}  // namespace

Ground::Ground(WalkGeometry geometry, const FieldGrid& grid) : geometry_(std::move(geometry)), grid_(grid) {}

const WalkMap& Ground::map(bool keep_to_roads) {
    const std::lock_guard lock(making_);
    std::optional<WalkMap>& map = maps_[keep_to_roads ? 1 : 0];
    if (!map) map = makeWalkMap(geometry_, grid_, keep_to_roads);
    return *map;
}

const CoarseMap& Ground::coarse(bool keep_to_roads) {
    const std::lock_guard lock(making_);
    std::optional<CoarseMap>& coarse = coarse_[keep_to_roads ? 1 : 0];
    if (!coarse) coarse = coarsen(map(keep_to_roads), coarseGrid());
    return *coarse;
}

FieldGrid Ground::coarseGrid() const {
    return makeGrid(geometry_, kDetourCell, kMostDetourCells);
}

const std::vector<float>& Ground::roadDistances() {
    const std::lock_guard lock(making_);
    if (!road_distances_) road_distances_ = roadDistance(geometry_, grid_);
    return *road_distances_;
}

std::shared_ptr<const Field> Ground::solve(bool keep_to_roads, const Targets& targets) {
    return solveOnce(solved_[keep_to_roads ? 1 : 0], map(keep_to_roads), targets);
}

std::shared_ptr<const Field> Ground::solveCoarse(bool keep_to_roads, const Targets& targets) {
    return solveOnce(solved_coarse_[keep_to_roads ? 1 : 0], coarse(keep_to_roads).map, targets);
}

std::shared_ptr<const Field> Ground::solveOnce(Solved& solved, const WalkMap& map, const Targets& targets) {
    {
        const std::lock_guard lock(solving_);
        if (const auto known = solved.find(targets); known != solved.end()) return known->second;
    }
    auto field = std::make_shared<const Field>(solveField(map, targets, solver_));
    const std::lock_guard lock(solving_);
    return solved.try_emplace(targets, std::move(field)).first->second;
}

std::size_t Ground::bytes() const {
    const std::lock_guard lock(solving_);
    std::size_t sum = 0;
    for (const Solved* solved : {&solved_[0], &solved_[1], &solved_coarse_[0], &solved_coarse_[1]})
        for (const auto& [targets, field] : *solved)
            sum += bytesOf(*field) + targets.size() * sizeof(std::uint32_t);
    return sum;
}

std::shared_ptr<Ground> GroundCache::groundFor(const WalkGeometry& geometry, const FieldGrid& grid) {
    constexpr std::size_t kMostEntries = 16;
    constexpr std::size_t kMostBytes = std::size_t{192} << 20;
    std::string key = keyOf(geometry, grid);
    const auto known =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
    if (known != entries_.end()) {
        entries_.splice(entries_.begin(), entries_, known);
        return entries_.front().ground;
    }
    std::size_t sum = 0;
    for (auto entry = entries_.begin(); entry != entries_.end();) {
        sum += entry->ground->bytes();
        const bool too_many = sum > kMostBytes || std::distance(entries_.begin(), entry) + 1 >=
                                                      static_cast<std::ptrdiff_t>(kMostEntries);
        entry = too_many ? entries_.erase(entry) : std::next(entry);
    }
    entries_.push_front({std::move(key), std::make_shared<Ground>(geometry, grid)});
    return entries_.front().ground;
}

}  // namespace throng::authoring
