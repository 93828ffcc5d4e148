// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/ground.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <type_traits>

#include "authoring/scene/patches.h"
#include "authoring/scene/slope_costs.h"
#include "authoring/scene/walls.h"

namespace throng::authoring {
namespace {

/// Jams are larger than this, m, and their news should travel fast.
constexpr float kDetourCell = 0.75f;
constexpr double kMostDetourCells = 30'000.0;

/// Doors of 0.8 m at any angle stay open on cells of this size (m): free cells have to be found between two
/// walls, and walls without thickness take more than half a cell on either side.
constexpr float kDoorCell = 0.3f;
constexpr float kBlockCell = 0.25f;
constexpr double kMostBlockCells = 8.0e6;      // of one field
constexpr double kMostCellsOfBlocks = 48.0e6;  // of all fields
constexpr double kFewestBlockCells = 0.2e6;
constexpr double kMostFieldCells = 20.0e6;  // of all fields, where cells of kDoorCell do not need more
/// Who walks to a point of one's own takes corners more closely than who follows others to a place (m).
constexpr float kPointComfort = 0.05f;
constexpr float kStraight = 25.0f;  // m: as far as straight ways are looked for

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

std::string keyOf(const WalkGeometry& geometry, const GroundResolution& resolution) {
    std::string key;
    append(key, resolution);
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
    append(key, geometry.has_crossings);
    for (const LocalRoad& road : geometry.roads) {
        appendAll(key, road.centreline);
        append(key, road.width);
        append(key, road.one_way);
    }
    for (const LocalPolygon& area : geometry.areas)
        appendAll(key, area);
    for (const CostlyGround& ground : geometry.costly) {
        appendAll(key, ground.outline);
        append(key, ground.cost);
        append(key, ground.is_for_a_time);
    }
    if (geometry.slopes) appendAll(key, geometry.slopes->nodes());
    if (geometry.charts) {
        appendAll(key, geometry.charts->cells);
        appendAll(key, geometry.charts->shifts);
        appendAll(key, geometry.charts->cell_costs);
        appendAll(key, geometry.charts->lifts.plans);
    }
    return key;
}

void narrowSlopes(const SlopeCosts& slopes, Sight& sight) {
    const FieldGrid& cells = sight.grid();
    for (std::uint32_t y = 0; y < cells.height; ++y)
        for (std::uint32_t x = 0; x < cells.width; ++x)
            if (slopes.isWorthAWayRound(cellCentre(cells, x, y))) sight.setNarrow(x, y);
}

std::size_t bytesOf(const Field& field) {
    return field.cells.size() * sizeof(gpu::FieldCell) + field.reachable.size() * sizeof(float) +
           field.is_reached.size() / 8;
}

}  // namespace

GroundResolution resolutionFor(const WalkGeometry& geometry, std::size_t fields) {
    const auto count = static_cast<double>(std::max<std::size_t>(fields, 1));
    const glm::vec2 extent = geometry.maximum - geometry.minimum;
    const double area = static_cast<double>(extent.x) * static_cast<double>(extent.y);
    const auto needed = static_cast<float>(std::sqrt(area * count / kMostFieldCells));
    GroundResolution resolution;
    resolution.grid = makeGrid(geometry, std::clamp(needed, kSmallestCell, kDoorCell));
    // Without walls there are no doors.
    if (resolution.grid.cell_size > kDoorCell && !geometry.walls.empty() && !geometry.charts) {
        resolution.block_cell = fields > 16 ? kDoorCell : kBlockCell;
        resolution.most_block_cells = static_cast<std::uint32_t>(
            std::clamp(kMostCellsOfBlocks / count, kFewestBlockCells, kMostBlockCells));
    }
    return resolution;
}

Ground::Ground(WalkGeometry geometry, const GroundResolution& resolution)
    : geometry_(std::move(geometry)), grid_(resolution.grid) {
    if (resolution.block_cell > 0.0f)
        blocks_ = makeFieldBlocks(geometry_, resolution.block_cell, resolution.most_block_cells);
}

WalkGeometry Ground::geometryFor(Purpose purpose) const {
    WalkGeometry geometry = geometry_;
    if (purpose == kToPoints) geometry.wall_comfort = kPointComfort;
    return geometry;
}

const WalkMap& Ground::mapFor(Purpose purpose) {
    const std::lock_guard lock(making_);
    std::optional<WalkMap>& map = maps_[purpose];
    if (!map) map = makeWalkMap(geometryFor(purpose), grid_, purpose == kOnRoads);
    return *map;
}

const CoarseMap& Ground::coarse(bool keep_to_roads) {
    const std::lock_guard lock(making_);
    std::optional<CoarseMap>& coarse = coarse_[keep_to_roads ? 1 : 0];
    if (!coarse)
        coarse =
            geometry_.charts ? coarsenCharts(map(keep_to_roads)) : coarsen(map(keep_to_roads), coarseGrid());
    return *coarse;
}

/// Whether one may go from a coarse cell to the next is the same within a chart and over its seams.
CoarseMap Ground::coarsenCharts(WalkMap fine) const {
    for (const auto& [image, owner] : fine.seams->shown) {
        fine.cost[image] = fine.cost[owner];
        if (!fine.one_way.empty()) fine.one_way[image] = fine.one_way[owner];
    }
    CoarseMap coarse = coarsen(fine, coarseGrid());
    blockOthers(*geometry_.charts, coarse.map);
    return coarse;
}

FieldGrid Ground::coarseGrid() const {
    return makeGrid(geometry_, kDetourCell, kMostDetourCells);
}

const std::vector<float>& Ground::roadDistances() {
    const std::lock_guard lock(making_);
    if (!road_distances_) road_distances_ = roadDistance(geometry_, grid_);
    return *road_distances_;
}

const BlockMap& Ground::blockMapFor(Purpose purpose) {
    const std::lock_guard lock(making_);
    std::optional<BlockMap>& map = block_maps_[purpose];
    if (!map) map = makeBlockMap(geometryFor(purpose), blocks_, purpose == kOnRoads);
    return *map;
}

const std::vector<float>& Ground::costFor(Purpose purpose) {
    return blocks_.empty() ? mapFor(purpose).cost : blockMapFor(purpose).cost;
}

template <class Visit>
void Ground::visitSpots(glm::vec2 lower, glm::vec2 upper, Visit visit) const {
    if (blocks_.empty())
        visitBox(grid_, lower, upper, visit);
    else
        blocks_.visitNodes(lower, upper, visit);
}

const Sight& Ground::sight() {
    if (const Sight* known = known_sight_.load(std::memory_order_acquire)) return *known;
    const std::lock_guard lock(making_);
    if (sight_) return *sight_;
    const FieldGrid& cells = blocks_.empty() ? grid_ : blocks_.cells;
    const std::vector<float>& cost = costFor(kAnywhere);
    const float roomy = 1.0f + WallCost(geometry_, cells.cell_size)(geometry_.largest_radius);
    sight_.emplace(cells);
    const auto set = [&](std::uint32_t x, std::uint32_t y, float here) {
        if (here < kUnreachable) sight_->setFree(x, y);
        if (here < kUnreachable && here <= roomy) sight_->setRoomy(x, y);
    };
    for (std::uint32_t y = 0; y < cells.height; ++y)
        for (std::uint32_t x = 0; x < cells.width; ++x) {
            if (blocks_.empty()) {
                set(x, y, cost[std::size_t{y} * cells.width + x]);
            } else if (const std::uint32_t node = blocks_.fineNode(x, y); node != gpu::NO_INDEX) {
                set(x, y, cost[node]);
            } else if (x % FieldBlocks::kSide == 0 && y % FieldBlocks::kSide == 0 &&
                       blocks_.isOpen(x / FieldBlocks::kSide, y / FieldBlocks::kSide)) {
                sight_->setTileOpen(x / FieldBlocks::kSide, y / FieldBlocks::kSide);
            }
        }
    // Nobody goes straight over ground that is worth a way round it.
    visitCostly(geometry_.costly, cells,
                [&](std::uint32_t cell) { sight_->setNarrow(cell % cells.width, cell / cells.width); });
    if (geometry_.slopes) narrowSlopes(*geometry_.slopes, *sight_);
    sight_->finish();
    known_sight_.store(&*sight_, std::memory_order_release);
    return *sight_;
}

/// The middle of the nearest free cell that nothing parts from the point.
std::optional<glm::vec2> Ground::freeCellNear(glm::vec2 point) {
    constexpr int kReach = 4;             // cells
    constexpr float kAnything = 1.0e-3f;  // m: a radius that no wall lets through
    const FieldGrid& cells = sight().grid();
    const auto x = static_cast<int>(column(cells, point.x)), y = static_cast<int>(row(cells, point.y));
    std::optional<glm::vec2> nearest;
    for (int j = std::max(0, y - kReach); j <= std::min(static_cast<int>(cells.height) - 1, y + kReach); ++j)
        for (int i = std::max(0, x - kReach); i <= std::min(static_cast<int>(cells.width) - 1, x + kReach);
             ++i) {
            if (!sight().isFree(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j))) continue;
            const glm::vec2 centre =
                cellCentre(cells, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
            if (nearest && glm::distance(*nearest, point) <= glm::distance(centre, point)) continue;
            if (straightIsClear(geometry_, point, centre, kAnything)) nearest = centre;
        }
    return nearest;
}

std::uint32_t Ground::spotAt(glm::vec2 point) {
    const FieldGrid& cells = sight().grid();
    if (!sight().isFree(column(cells, point.x), row(cells, point.y)))
        point = freeCellNear(point).value_or(point);
    return blocks_.empty() ? cellAt(grid_, point) : blocks_.nodeAt(point);
}

std::vector<std::uint32_t> Ground::spotsIn(const LocalPolygon& polygon) {
    std::vector<std::uint32_t> spots;
    const Box box = boundsOf(polygon, 0.0f);
    visitSpots(box.lower, box.upper, [&](std::uint32_t spot, glm::vec2 at) {
        if (insidePolygon(polygon, at)) spots.push_back(spot);
    });
    if (!spots.empty()) return spots;
    glm::vec2 middle(0.0f);
    for (const glm::vec2 point : polygon)
        middle += point / static_cast<float>(polygon.size());
    if (const std::uint32_t spot = spotAt(middle); spot != gpu::NO_INDEX) spots.push_back(spot);
    return spots;
}

float Ground::lengthFrom(const Field& field, std::uint32_t spot) const {
    if (spot == gpu::NO_INDEX) return kUnreachable;
    return field.lengthFrom(cellOf(spot));
}

/// A straight wall takes one cut, and the rest is the same rectangle for all points near it.
GoalBox Ground::clearBox(glm::vec2 point, float side) {
    const Sight& free = sight();
    const FieldGrid& cells = free.grid();
    const auto x = static_cast<int>(column(cells, point.x)), y = static_cast<int>(row(cells, point.y));
    const int count = std::max(1, static_cast<int>(side / cells.cell_size));
    int x0 = x / count * count, x1 = std::min(x0 + count, static_cast<int>(cells.width));
    int y0 = y / count * count, y1 = std::min(y0 + count, static_cast<int>(cells.height));
    for (;;) {
        int nearest = std::numeric_limits<int>::max(), blocked_x = x, blocked_y = y;
        for (int line = y0; line < y1; ++line)
            for (int place = x0; place < x1; ++place) {
                const int away = std::max(std::abs(place - x), std::abs(line - y));
                if (away == 0 || away >= nearest ||
                    free.isFree(static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(line)))
                    continue;
                nearest = away;
                blocked_x = place;
                blocked_y = line;
            }
        if (blocked_x == x && blocked_y == y) break;
        if (std::abs(blocked_x - x) >= std::abs(blocked_y - y))
            (blocked_x < x ? x0 : x1) = blocked_x < x ? blocked_x + 1 : blocked_x;
        else
            (blocked_y < y ? y0 : y1) = blocked_y < y ? blocked_y + 1 : blocked_y;
    }
    return {cells.minimum + glm::vec2(x0, y0) * cells.cell_size,
            cells.minimum + glm::vec2(x1, y1) * cells.cell_size};
}

/// @param room clear: from anywhere in it the way is straight
StraightWays Ground::straightTo(const GoalBox& goals, glm::vec2 middle, const GoalBox& room) {
    StraightWays ways;
    ways.to = middle;
    const std::vector<float>& cost = costFor(kToPoints);
    ways.from.assign(cost.size(), 0);
    const float cell = sight().grid().cell_size, close = geometry_.largest_radius + cell;
    std::vector<glm::vec2> corners = {middle};
    if (goals.lower != goals.upper)
        corners = {goals.lower, goals.upper, {goals.lower.x, goals.upper.y}, {goals.upper.x, goals.lower.y}};
    const GoalBox ends = corners.size() > 1 ? goals : GoalBox{middle, middle};
    const glm::vec2 lower = glm::min(goals.lower, room.lower), upper = glm::max(goals.upper, room.upper);
    visitSpots(lower - kStraight, upper + kStraight, [&](std::uint32_t spot, glm::vec2 at) {
        if (cost[spot] == kUnreachable) return;
        const bool is_inside =
            at.x > room.lower.x && at.x < room.upper.x && at.y > room.lower.y && at.y < room.upper.y;
        const bool is_clear =
            is_inside || sight_->isOpen(glm::min(at, ends.lower), glm::max(at, ends.upper)) ||
            std::all_of(corners.begin(), corners.end(),
                        [&](glm::vec2 corner) { return sight_->isClear(at, corner, close); });
        if (is_clear || glm::distance(at, middle) < 1.5f * cell) ways.from[spot] = 1;
    });
    return ways;
}

Field Ground::solveFine(Purpose purpose, const Targets& targets, const StraightWays* straight) {
    Field field = blocks_.empty() ? solveField(mapFor(purpose), targets, solver_, straight)
                                  : solveField(blockMapFor(purpose), targets, straight);
    field.reachable = {};  // the cells say as much
    return field;
}

std::shared_ptr<const Field> Ground::solve(bool keep_to_roads, const Targets& targets) {
    return once(solved_[keep_to_roads ? 1 : 0], targets,
                [&] { return solveFine(keep_to_roads ? kOnRoads : kAnywhere, targets, nullptr); });
}

std::shared_ptr<const Field> Ground::solveTo(const GoalBox& goals) {
    return once(
        solved_to_,
        std::array{goals.lower.x, goals.lower.y, goals.upper.x, goals.upper.y, 0.0f, 0.0f, 0.0f, 0.0f}, [&] {
            const glm::vec2 middle = 0.5f * (goals.lower + goals.upper);
            const FieldGrid& cells = sight().grid();
            glm::vec2 reached = middle;
            if (!sight().isFree(column(cells, middle.x), row(cells, middle.y)))
                reached = freeCellNear(middle).value_or(middle);
            Targets targets;
            const std::uint32_t x = column(cells, reached.x), y = row(cells, reached.y);
            if (blocks_.empty())
                targets = {cellAt(grid_, reached)};
            else if (const std::uint32_t node = blocks_.fineNode(x, y); node != gpu::NO_INDEX)
                targets = {node};
            const glm::vec2 around(1.5f * cells.cell_size);
            const StraightWays straight =
                straightTo(goals, reached, {goals.lower - around, goals.upper + around});
            return solveFine(kToPoints, targets, &straight);
        });
}

std::shared_ptr<const Field> Ground::solveTo(const GoalBox& goals, const GoalBox& room) {
    return once(solved_to_,
                std::array{goals.lower.x, goals.lower.y, goals.upper.x, goals.upper.y, room.lower.x,
                           room.lower.y, room.upper.x, room.upper.y},
                [&] {
                    StraightWays straight = straightTo(goals, 0.5f * (goals.lower + goals.upper), room);
                    straight.is_start = false;
                    const Targets targets = spotsIn(
                        {room.lower, {room.upper.x, room.lower.y}, room.upper, {room.lower.x, room.upper.y}});
                    return solveFine(kAnywhere, targets, &straight);
                });
}

std::shared_ptr<const Field> Ground::solveCoarse(bool keep_to_roads, const Targets& targets) {
    return once(solved_coarse_[keep_to_roads ? 1 : 0], targets,
                [&] { return solveField(coarse(keep_to_roads).map, targets, solver_); });
}

template <class Key, class Solve>
std::shared_ptr<const Field> Ground::once(std::map<Key, std::shared_ptr<const Field>>& solved, const Key& key,
                                          Solve solve) {
    {
        const std::lock_guard lock(solving_);
        if (const auto known = solved.find(key); known != solved.end()) return known->second;
    }
    auto field = std::make_shared<const Field>(solve());
    const std::lock_guard lock(solving_);
    return solved.try_emplace(key, std::move(field)).first->second;
}

std::size_t Ground::bytes() const {
    const std::lock_guard lock(solving_);
    std::size_t sum = 0;
    for (const Solved* solved : {&solved_[0], &solved_[1], &solved_coarse_[0], &solved_coarse_[1]})
        for (const auto& [targets, field] : *solved)
            sum += bytesOf(*field) + targets.size() * sizeof(std::uint32_t);
    for (const auto& [box, field] : solved_to_)
        sum += bytesOf(*field);
    return sum;
}

std::shared_ptr<Ground> GroundCache::groundFor(const WalkGeometry& geometry,
                                               const GroundResolution& resolution) {
    constexpr std::size_t kMostEntries = 16;
    constexpr std::size_t kMostBytes = std::size_t{192} << 20;
    std::string key = keyOf(geometry, resolution);
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
    entries_.push_front({std::move(key), std::make_shared<Ground>(geometry, resolution)});
    return entries_.front().ground;
}

}  // namespace throng::authoring
