// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/routes.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <glm/packing.hpp>
#include <limits>
#include <set>
#include <thread>

#include "authoring/scene/raster.h"

namespace throng::authoring {
namespace {

/// All fields together stay below this, on the device and here: what every device samples as one buffer.
constexpr std::size_t kMostFieldBytes = std::size_t{1} << 30;

void appendGround(const CoarseMap& coarse, std::vector<gpu::GroundCell>& ground) {
    const WalkMap& map = coarse.map;
    for (std::size_t cell = 0; cell < map.cost.size(); ++cell)
        ground.push_back({std::min(map.cost[cell], gpu::BLOCKED_COST),
                          glm::packSnorm2x16(map.one_way.empty() ? glm::vec2(0.0f) : map.one_way[cell]),
                          map.open_sides[cell], coarse.free_share[cell]});
}

}  // namespace

Routes::Routes(const Layout& layout, const Rebase& rebase, Ground& ground)
    : layout_(layout), rebase_(rebase), ground_(ground), grid_(ground.grid()) {}

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

bool Routes::hasRoom() const {
    return (fields_.size() + 1) * cellCount(grid_) * sizeof(gpu::FieldCell) <= kMostFieldBytes;
}

void Routes::solveAll(const std::vector<std::vector<Place>>& destinations, bool keep_to_roads) {
    struct Task {
        std::vector<std::uint32_t> targets;
        std::uint32_t field;
    };
    std::vector<Task> tasks;
    for (const std::vector<Place>& places : destinations) {
        const auto [entry, is_new] = known_.try_emplace(keyOf(places, keep_to_roads), 0);
        if (!is_new) continue;
        if (!hasRoom()) {
            too_many_ = true;
            return;
        }
        std::vector<std::uint32_t> targets = cellsOf(places);
        entry->second = addField({}, targets, keep_to_roads, places.size() > 1);
        tasks.push_back({std::move(targets), entry->second});
    }
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t task = next++; task < tasks.size(); task = next++)
            fields_[tasks[task].field] = ground_.solve(keep_to_roads, tasks[task].targets);
    };
    if (ground_.solver()) return work();  // a device works for this thread only
    std::vector<std::jthread> workers;
    for (std::size_t i = 0; i < std::min<std::size_t>(std::thread::hardware_concurrency(), tasks.size()); ++i)
        workers.emplace_back(work);
}

std::uint32_t Routes::addField(std::shared_ptr<const Field> field, std::vector<std::uint32_t> targets,
                               bool keep_to_roads, bool has_choice) {
    fields_.push_back(std::move(field));
    targets_.push_back(std::move(targets));
    on_roads_.push_back(keep_to_roads);
    has_choice_.push_back(has_choice);
    return static_cast<std::uint32_t>(fields_.size() - 1);
}

std::uint32_t Routes::solve(const std::vector<std::uint32_t>& targets, bool keep_to_roads, bool has_choice) {
    if (!hasRoom()) {
        too_many_ = true;
        return 0;
    }
    return addField(ground_.solve(keep_to_roads, targets), targets, keep_to_roads, has_choice);
}

std::uint32_t Routes::fieldTo(const Place& place, bool keep_to_roads) {
    return fieldTo(std::vector{place}, keep_to_roads);
}

std::uint32_t Routes::fieldTo(const std::vector<Place>& places, bool keep_to_roads) {
    const auto [entry, is_new] = known_.try_emplace(keyOf(places, keep_to_roads), 0);
    if (is_new) entry->second = solve(cellsOf(places), keep_to_roads, places.size() > 1);
    return entry->second;
}

std::string Routes::keyOf(const std::vector<Place>& places, bool keep_to_roads) const {
    std::string key = keep_to_roads ? "on roads" : "anywhere";
    for (const Place& place : places)
        key += "\n" + name(place);
    return key;
}

std::vector<std::uint32_t> Routes::cellsOf(const std::vector<Place>& places) const {
    std::vector<std::uint32_t> targets;
    for (const Place& place : places) {
        const std::vector<std::uint32_t> cells = cellsInPolygon(grid_, outline(place, kTargetDepth));
        targets.insert(targets.end(), cells.begin(), cells.end());
    }
    return targets;
}

/// A rectangle without a blocked cell that holds the point's cell: a square of kSurroundings, cut at the
/// nearest blocked cell until none is left. A straight wall takes one cut, and the rest is the same rectangle
/// for all points near it.
std::vector<std::uint32_t> Routes::clearRectangle(glm::vec2 point) {
    const WalkMap& map = ground_.map(false);
    const auto width = static_cast<int>(grid_.width);
    const auto cell = static_cast<int>(cellAt(grid_, point));
    const int x = cell % width, y = cell / width;
    const int side = std::max(1, static_cast<int>(kSurroundings / grid_.cell_size));
    int x0 = x / side * side, x1 = std::min(x0 + side, width);
    int y0 = y / side * side, y1 = std::min(y0 + side, static_cast<int>(grid_.height));
    for (;;) {
        int nearest = std::numeric_limits<int>::max(), blocked_x = x, blocked_y = y;
        for (int line = y0; line < y1; ++line)
            for (int column = x0; column < x1; ++column) {
                const int away = std::max(std::abs(column - x), std::abs(line - y));
                if (away == 0 || away >= nearest ||
                    map.cost[static_cast<std::size_t>(line) * grid_.width +
                             static_cast<std::size_t>(column)] < kUnreachable)
                    continue;
                nearest = away;
                blocked_x = column;
                blocked_y = line;
            }
        if (blocked_x == x && blocked_y == y) break;
        if (std::abs(blocked_x - x) >= std::abs(blocked_y - y))
            (blocked_x < x ? x0 : x1) = blocked_x < x ? blocked_x + 1 : blocked_x;
        else
            (blocked_y < y ? y0 : y1) = blocked_y < y ? blocked_y + 1 : blocked_y;
    }
    std::vector<std::uint32_t> cells;
    for (int line = y0; line < y1; ++line)
        for (int column = x0; column < x1; ++column)
            cells.push_back(static_cast<std::uint32_t>(line * width + column));
    return cells;
}

std::uint32_t Routes::fieldTo(glm::vec2 point) {
    // A rectangle holds the cell that it was made for, so one that is known is found by any of its cells.
    const std::uint32_t cell = cellAt(grid_, point);
    if (const auto known = field_of_cell_.find(cell); known != field_of_cell_.end()) return known->second;
    if (!hasRoom()) return gpu::NO_INDEX;
    const std::vector<std::uint32_t> targets = clearRectangle(point);
    const std::uint32_t field = solve(targets, false, false);
    for (const std::uint32_t target : targets)
        field_of_cell_.try_emplace(target, field);
    return field;
}

float Routes::reachable(std::uint32_t field, glm::vec2 from) const {
    return fields_.empty() ? 0.0f : fields_[field]->reachable[cellAt(grid_, from)];
}

float Routes::reachable(std::uint32_t field, const LocalPolygon& from) const {
    if (fields_.empty()) return 0.0f;
    float least = kUnreachable;
    for (const std::uint32_t cell : cellsInPolygon(grid_, from))
        least = std::min(least, fields_[field]->reachable[cell]);
    return least;
}

std::vector<gpu::FieldCell> Routes::cells() const {
    std::vector<gpu::FieldCell> cells;
    cells.reserve(fields_.size() * cellCount(grid_));
    for (const std::shared_ptr<const Field>& field : fields_)
        cells.insert(cells.end(), field->cells.begin(), field->cells.end());
    return cells;
}

Detours Routes::detours() {
    Detours detours;
    detours.grid = ground_.coarseGrid();
    detours.has_choice = has_choice_;
    std::optional<std::uint32_t> map_index[2];
    for (std::size_t field = 0; field < fields_.size(); ++field) {
        const CoarseMap& coarse = ground_.coarse(on_roads_[field]);
        std::optional<std::uint32_t>& index = map_index[on_roads_[field] ? 1 : 0];
        if (!index) {
            index = static_cast<std::uint32_t>(detours.ground.size() / cellCount(detours.grid));
            appendGround(coarse, detours.ground);
        }
        detours.ground_of_field.push_back(*index);
        std::set<std::uint32_t> cells;
        for (const std::uint32_t cell : targets_[field])
            if (coarse.cell_of[cell] != gpu::NO_INDEX) cells.insert(coarse.cell_of[cell]);
        const auto solved = ground_.solveCoarse(on_roads_[field], {cells.begin(), cells.end()});
        for (const float distance : solved->reachable)
            detours.distances.push_back(std::min(distance, gpu::BLOCKED_COST));
    }
    return detours;
}

}  // namespace throng::authoring
