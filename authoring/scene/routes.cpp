// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/routes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <glm/packing.hpp>
#include <set>

#include "authoring/layout/seat_rows.h"
#include "authoring/scene/raster.h"
#include "base/side_by_side.h"

namespace throng::authoring {
namespace {

/// All fields together stay below this, on the device and here: what every device samples as one buffer.
constexpr std::size_t kMostFieldBytes = std::size_t{1} << 30;
/// Goals get fields of their own up to this many cells: about half a second's work.
constexpr std::size_t kMostPointCells = 6'000'000;

void appendGround(const CoarseMap& coarse, std::vector<gpu::GroundCell>& ground) {
    const WalkMap& map = coarse.map;
    for (std::size_t cell = 0; cell < map.cost.size(); ++cell)
        ground.push_back({std::min(map.cost[cell], gpu::BLOCKED_COST),
                          glm::packSnorm2x16(map.one_way.empty() ? glm::vec2(0.0f) : map.one_way[cell]),
                          map.open_sides[cell], coarse.free_share[cell]});
}

}  // namespace

Routes::Routes(const Layout& layout, const Rebase& rebase, Ground& ground)
    : layout_(layout), rebase_(rebase), ground_(ground) {}

LocalPolygon Routes::outline(const Place& place, float depth) const {
    if (place.kind == Place::Kind::area) return rebase_.local(layout_.areas[place.index].polygon);
    if (place.kind == Place::Kind::aisle)
        return rebase_.local(footOf(layout_.seats[place.index], place.number));
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
    if (place.kind == Place::Kind::aisle)
        return fmt::format("{}, aisle {}", layout_.seats[place.index].id, place.number + 1);
    return layout_.roads[place.index].id + (place.kind == Place::Kind::road_start ? ":start" : ":end");
}

bool Routes::hasRoom() const {
    return (fields_.size() + 1) * ground_.cellsPerField() * sizeof(gpu::FieldCell) <= kMostFieldBytes;
}

std::uint32_t Routes::add(Entry entry) {
    fields_.push_back(std::move(entry));
    return static_cast<std::uint32_t>(fields_.size() - 1);
}

Routes::Entry Routes::entryOf(const std::vector<Place>& places, bool keep_to_roads) const {
    Entry entry;
    entry.has_choice = places.size() > 1;
    entry.on_roads = keep_to_roads;
    for (const Place& place : places) {
        const std::vector<std::uint32_t> cells = cellsInPolygon(ground_.grid(), outline(place, kTargetDepth));
        entry.targets.insert(entry.targets.end(), cells.begin(), cells.end());
    }
    return entry;
}

std::shared_ptr<const Field> Routes::solve(const std::vector<Place>& places, bool keep_to_roads) {
    Ground::Targets targets;
    for (const Place& place : places) {
        const Ground::Targets spots = ground_.spotsIn(outline(place, kTargetDepth));
        targets.insert(targets.end(), spots.begin(), spots.end());
    }
    return ground_.solve(keep_to_roads, targets);
}

void Routes::solveEach(const std::vector<std::uint32_t>& fields,
                       const std::function<void(std::uint32_t)>& solve) {
    if (ground_.solver())  // a device works for this thread only
        std::ranges::for_each(fields, solve);
    else
        doEach(fields.size(), [&](std::size_t i) { solve(fields[i]); });
}

void Routes::solveAll(const std::vector<std::vector<Place>>& destinations, bool keep_to_roads) {
    std::vector<std::uint32_t> fields;
    std::map<std::uint32_t, const std::vector<Place>*> places_of;
    for (const std::vector<Place>& places : destinations) {
        const auto [entry, is_new] = known_.try_emplace(keyOf(places, keep_to_roads), 0);
        if (!is_new) continue;
        if (!hasRoom()) {
            too_many_ = true;
            break;
        }
        entry->second = add(entryOf(places, keep_to_roads));
        fields.push_back(entry->second);
        places_of[entry->second] = &places;
    }
    solveEach(fields, [&](std::uint32_t field) {
        fields_[field].field = solve(*places_of.at(field), keep_to_roads);
    });
}

std::uint32_t Routes::fieldTo(const Place& place, bool keep_to_roads) {
    return fieldTo(std::vector{place}, keep_to_roads);
}

std::uint32_t Routes::fieldTo(const std::vector<Place>& places, bool keep_to_roads) {
    const auto [known, is_new] = known_.try_emplace(keyOf(places, keep_to_roads), 0);
    if (!is_new) return known->second;
    if (!hasRoom()) {
        too_many_ = true;
        return known->second;
    }
    Entry entry = entryOf(places, keep_to_roads);
    entry.field = solve(places, keep_to_roads);
    return known->second = add(std::move(entry));
}

std::string Routes::keyOf(const std::vector<Place>& places, bool keep_to_roads) const {
    std::string key = keep_to_roads ? "on roads" : "anywhere";
    for (const Place& place : places)
        key += "\n" + name(place);
    return key;
}

/// Points that share a clear rectangle of up to `side` metres; by themselves for 0.
/// @returns one group more than `most` where they are more than that
Routes::Groups Routes::groupsOf(const Points& points, float side, std::size_t most) const {
    Groups groups;
    for (const glm::vec2 at : points) {
        if (groups.size() > most) break;
        const auto holds = [&](const Group& group) {
            return side > 0.0f && at.x >= group.room->lower.x && at.x < group.room->upper.x &&
                   at.y >= group.room->lower.y && at.y < group.room->upper.y;
        };
        auto group = std::find_if(groups.begin(), groups.end(), holds);
        if (group == groups.end())
            group = groups.insert(
                group,
                {{at, at}, side > 0.0f ? std::optional(ground_.clearBox(at, side)) : std::nullopt, {}});
        group->bounds = {glm::min(group->bounds.lower, at), glm::max(group->bounds.upper, at)};
        group->points.push_back(at);
    }
    return groups;
}

std::size_t Routes::plan(const std::vector<PointGoal>& goals) {
    std::set<std::tuple<bool, float, float>> different;
    Points straight, others;
    for (const auto& [point, is_straight] : goals)
        if (different.emplace(is_straight, point.x, point.y).second)
            (is_straight ? straight : others).push_back(point);
    // At least as many as there are rooms, at most as many as do not take long.
    constexpr int kWidest = 32;  // m
    const std::size_t affordable = std::max<std::size_t>(1, kMostPointCells / ground_.cellsPerField());
    groups_ = groupsOf(others, 0.0f, affordable);
    if (groups_.size() > affordable) {
        const Groups fewest = groupsOf(others, float{kWidest}, others.size());
        const std::size_t most = std::max(affordable, fewest.size());
        groups_ = groupsOf(others, 0.0f, most);
        for (int side = 1; groups_.size() > most && side < kWidest; side *= 2)
            groups_ = groupsOf(others, static_cast<float>(side), most);
        if (groups_.size() > most) groups_ = fewest;
        for (Group& group : groups_)
            group.room.reset();
    }
    for (Group& group : groupsOf(straight, float{kWidest}, straight.size()))
        groups_.push_back(std::move(group));
    return groups_.size();
}

void Routes::solvePlanned() {
    std::vector<std::uint32_t> fields;
    std::map<std::uint32_t, const Group*> group_of;
    for (const Group& group : groups_) {
        if (!hasRoom()) break;
        Entry entry;
        const glm::vec2 middle = 0.5f * (group.bounds.lower + group.bounds.upper);
        if (group.room)
            entry.targets = cellsInPolygon(ground_.grid(), {group.room->lower,
                                                            {group.room->upper.x, group.room->lower.y},
                                                            group.room->upper,
                                                            {group.room->lower.x, group.room->upper.y}});
        else
            entry.targets = {ground_.blocks().empty() ? ground_.spotAt(middle)
                                                      : cellAt(ground_.grid(), middle)};
        const std::uint32_t field = add(std::move(entry));
        fields.push_back(field);
        group_of[field] = &group;
        for (const glm::vec2 point : group.points)
            field_of_point_[{point.x, point.y, group.room.has_value()}] = field;
    }
    if (fields.empty()) return;
    ground_.sight();  // for all of them
    solveEach(fields, [&](std::uint32_t field) {
        const Group& group = *group_of.at(field);
        fields_[field].field =
            group.room ? ground_.solveTo(group.bounds, *group.room) : ground_.solveTo(group.bounds);
    });
}

std::uint32_t Routes::fieldTo(const PointGoal& goal) {
    const auto known = field_of_point_.find({goal.first.x, goal.first.y, goal.second});
    return known == field_of_point_.end() ? gpu::NO_INDEX : known->second;
}

float Routes::reachable(std::uint32_t field, glm::vec2 from) const {
    if (fields_.empty()) return 0.0f;
    return ground_.lengthFrom(*fields_[field].field, ground_.spotAt(from));
}

float Routes::reachable(std::uint32_t field, const LocalPolygon& from) const {
    if (fields_.empty()) return 0.0f;
    float least = kUnreachable;
    for (const std::uint32_t spot : ground_.spotsIn(from))
        least = std::min(least, ground_.lengthFrom(*fields_[field].field, spot));
    return least;
}

bool Routes::leads(std::span<const glm::vec2> from, const Place& to) {
    const std::shared_ptr<const Field> field = solve({to}, false);
    return std::ranges::any_of(from, [&](glm::vec2 point) {
        const std::uint32_t spot = ground_.spotAt(point);
        return spot != gpu::NO_INDEX && ground_.lengthFrom(*field, spot) != kUnreachable;
    });
}

glm::vec2 Routes::directionFrom(std::uint32_t field, glm::vec2 from) const {
    const std::uint32_t spot = fields_.empty() ? gpu::NO_INDEX : ground_.spotAt(from);
    if (spot == gpu::NO_INDEX) return glm::vec2(0.0f);
    const gpu::FieldCell& cell = fields_[field].field->cells[ground_.cellOf(spot)];
    return cell.distance < 0.0f ? glm::vec2(0.0f) : glm::unpackSnorm2x16(cell.direction);
}

FieldStore Routes::store() const {
    FieldStore store;
    store.cells_per_field = ground_.cellsPerField();
    for (const Entry& entry : fields_)
        store.fields.emplace_back(entry.field, &entry.field->cells);
    const FieldBlocks& blocks = ground_.blocks();
    if (blocks.empty()) return store;
    store.block_cell = blocks.cells.cell_size;
    store.blocks_across = blocks.across;
    store.blocks_up = blocks.up;
    for (const std::uint32_t first : blocks.first_cells)
        store.block_table.push_back({std::bit_cast<float>(first), 0});
    return store;
}

Detours Routes::detours() {
    Detours detours;
    detours.grid = ground_.coarseGrid();
    if (!fields_.empty() && ground_.coarse(false).map.seams)
        for (const auto& [image, owner] : ground_.coarse(false).map.seams->shown)
            detours.shown.emplace_back(image, owner);
    if (!fields_.empty() && ground_.coarse(false).map.seams)
        detours.rides = ground_.coarse(false).map.seams->rides;
    std::optional<std::uint32_t> map_index[2];
    for (std::size_t field = 0; field < fields_.size(); ++field) {
        detours.has_choice.push_back(fields_[field].has_choice);
        const CoarseMap& coarse = ground_.coarse(fields_[field].on_roads);
        std::optional<std::uint32_t>& index = map_index[fields_[field].on_roads ? 1 : 0];
        if (!index) {
            index = static_cast<std::uint32_t>(detours.ground.size() / cellCount(detours.grid));
            appendGround(coarse, detours.ground);
        }
        detours.ground_of_field.push_back(*index);
        std::set<std::uint32_t> cells;
        for (const std::uint32_t cell : fields_[field].targets)
            if (coarse.cell_of[cell] != gpu::NO_INDEX) cells.insert(coarse.cell_of[cell]);
        const auto solved = ground_.solveCoarse(fields_[field].on_roads, {cells.begin(), cells.end()});
        for (const float distance : solved->reachable)
            detours.distances.push_back(std::min(distance, gpu::BLOCKED_COST));
    }
    return detours;
}

}  // namespace throng::authoring
