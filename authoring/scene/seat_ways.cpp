// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/seat_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "authoring/layout/seat_mouths.h"
#include "authoring/scene/audience.h"
#include "authoring/scene/seat_plan.h"

namespace throng::authoring {
namespace {

/// Somebody and its seat.
struct Owner {
    SeatNumber seat;
    std::size_t aisle = 0;
    std::uint32_t row = 0;
    std::uint32_t place = 0;  ///< of those that its states lead to, the aisle
    bool sits_at_start = false;

    std::tuple<std::size_t, std::size_t, std::uint32_t> order() const { return {seat.block, aisle, row}; }
};

const BehaviourState* sittingState(const Behaviour* behaviour) {
    if (!behaviour) return nullptr;
    const auto found = std::ranges::find(behaviour->states, BehaviourState::Does::sit, &BehaviourState::does);
    return found == behaviour->states.end() ? nullptr : &*found;
}

std::vector<std::size_t> blocksOf(const BehaviourState& state) {
    std::vector<std::size_t> blocks;
    for (const Place& place : state.to.places)
        if (std::ranges::find(blocks, place.index) == blocks.end()) blocks.push_back(place.index);
    return blocks;
}

/// Which of the places that a state leads to is an aisle.
std::uint32_t placeOf(const BehaviourState& state, std::size_t block, std::size_t aisle) {
    const auto found = std::ranges::find_if(
        state.to.places, [&](const Place& place) { return place.index == block && place.number == aisle; });
    return static_cast<std::uint32_t>(found - state.to.places.begin());
}

class SeatBuilder {
  public:
    SeatBuilder(const Layout& layout, const Rebase& rebase, Scene& scene, Diagnostics& diagnostics)
        : layout_(layout), rebase_(rebase), scene_(scene), diagnostics_(diagnostics), plan_(layout) {}

    void build() {
        // Those who sit there come first.
        for (const bool at_start : {true, false})
            for (std::size_t group = 0; group < scene_.groups.size(); ++group)
                if (scene_.groups[group].block.has_value() == at_start) seatGroup(group);
        if (owners_.empty() || diagnostics_.hasErrors()) return;
        for (const std::uint32_t row : parting_) {
            scene_.people[row].party_first = row;
            scene_.people[row].party_size = 1;
        }
        std::ranges::sort(owners_, {}, &Owner::order);
        scene_.seats.sitter_of_row.assign(scene_.people.size(), gpu::NO_INDEX);
        for (std::size_t first = 0, end = 0; first < owners_.size(); first = end) {
            while (end < owners_.size() && owners_[end].seat.block == owners_[first].seat.block &&
                   owners_[end].aisle == owners_[first].aisle)
                ++end;
            for (std::size_t i = first; i < end; ++i)
                addWay(owners_[i], first, end);
        }
        if (!layout_.shows.empty()) addCues();
    }

  private:
    void seatGroup(std::size_t group) {
        const BehaviourState* sits = sittingState(behaviourOf(layout_, scene_, group));
        const gpu::SpawnQueue& rows = scene_.queues[group];
        if (!sits || rows.row_count == 0) return;
        const std::string& id = scene_.groups[group].id;
        const std::vector<SeatNumber> seats = scene_.groups[group].block
                                                  ? seatsAtStart(*scene_.groups[group].block)
                                                  : freeSeats(*sits, rows, id);
        for (std::uint32_t i = 0; i < seats.size(); ++i) {
            plan_.take(seats[i]);
            const std::size_t aisle = aisleOf(layout_.seats[seats[i].block], plan_.at(seats[i]));
            owners_.push_back({seats[i], aisle, rows.first_row + i, placeOf(*sits, seats[i].block, aisle),
                               scene_.groups[group].block.has_value()});
        }
        for (std::size_t i = 0; i < seats.size(); ++i)
            partWhoSitApart(owners_[owners_.size() - seats.size() + i]);
    }

    /// Nobody waits for company that goes to another aisle.
    void partWhoSitApart(const Owner& owner) {
        gpu::Person& person = scene_.people[owner.row];
        const auto is_of_party = [&](const Owner& other) {
            return other.row - person.party_first < person.party_size;
        };
        const bool apart = std::ranges::any_of(owners_, [&](const Owner& other) {
            return is_of_party(other) && (other.seat.block != owner.seat.block || other.aisle != owner.aisle);
        });
        if (apart) parting_.push_back(owner.row);
    }

    std::vector<SeatNumber> seatsAtStart(std::size_t block) const {
        std::vector<SeatNumber> seats;
        for (const Spectator& each : audienceIn(layout_, block))
            seats.push_back({block, each.number});
        return seats;
    }

    std::vector<SeatNumber> freeSeats(const BehaviourState& sits, const gpu::SpawnQueue& rows,
                                      const std::string& id) {
        const std::vector<std::size_t> blocks = blocksOf(sits);
        const std::size_t free = plan_.countFree(blocks);
        if (rows.row_count > free) {
            diagnostics_.error(sits.where,
                               fmt::format("`{}`: {} people are to sit, and {} of these seats are free", id,
                                           rows.row_count, free),
                               "name more blocks of seats, let fewer sit there from the beginning "
                               "(`occupancy`), or let fewer people come");
            return {};
        }
        std::vector<Party> parties;
        for (std::uint32_t i = 0; i < rows.row_count; i += parties.back().size)
            parties.push_back({i, std::max(scene_.people[rows.first_row + i].party_size, 1u)});
        return plan_.seat(parties, blocks, GroupRandom(layout_.simulation.seed, id));
    }

    void addWay(const Owner& owner, std::size_t first, std::size_t end) {
        const SeatBlock& block = layout_.seats[owner.seat.block];
        const Seat& seat = plan_.at(owner.seat);
        gpu::SeatWay way{};
        way.place = rebase_.local(seat.place);
        way.stand = rebase_.local(seat.place + kStandsAhead * seat.ahead);
        way.height = static_cast<float>(seat.height);
        way.heading = static_cast<float>(std::atan2(seat.ahead.y, seat.ahead.x));
        way.aside = static_cast<float>(std::min(0.3, 0.25 * aisleWidth(block)));
        way.row = owner.row;
        way.first_of_aisle = static_cast<std::uint32_t>(first);
        way.count_of_aisle = static_cast<std::uint32_t>(end - first);
        way.lane = static_cast<std::uint32_t>(2 * seat.row + (seat.section > owner.aisle ? 1 : 0));
        way.shift = glm::vec2(block.shift);
        if (hasPassages(block))
            addPassage(block, owner.aisle, seat, way);
        else
            addPoints(block, owner.aisle, seat, way);
        scene_.seats.sitter_of_row[owner.row] = static_cast<std::uint32_t>(scene_.seats.ways.size());
        scene_.seats.ways.push_back(way);
        gpu::Sitter sitter{};
        sitter.mode = owner.sits_at_start ? gpu::SITTER_SITS : gpu::SITTER_WALKS;
        sitter.along = owner.sits_at_start ? way.length : 0.0f;
        sitter.activity = gpu::ACTIVITY_SIT;
        sitter.seated = owner.sits_at_start ? 0 : gpu::NO_INDEX;
        scene_.seats.sitters.push_back(sitter);
        scene_.behaviours.minds[owner.row].seat = owner.place;
    }

    void addCues() {
        std::vector<Spectator> seated;
        for (const Owner& owner : owners_)
            seated.push_back({owner.seat.block, owner.seat.seat, plan_.at(owner.seat), {}, 0, {}});
        scene_.seats.cues = cuesIn(layout_, seated);
    }

    void addPassage(const SeatBlock& block, std::size_t aisle, const Seat& seat, gpu::SeatWay& way) {
        const AisleWay found = ways_.try_emplace(&block, block).first->second.to(aisle, seat);
        way.first_point = static_cast<std::uint32_t>(scene_.seats.points.size());
        way.point_count = static_cast<std::uint32_t>(found.points.size());
        for (const AislePoint& point : found.points)
            scene_.seats.points.push_back({rebase_.local(point.place), glm::vec2(point.beside),
                                           glm::vec2(point.alone), static_cast<float>(point.height),
                                           static_cast<float>(point.along)});
        way.fork = static_cast<float>(found.fork);
        way.mouth = static_cast<float>(found.mouth);
        way.length = scene_.seats.points.back().along;
        way.branch = found.branch;
        way.free_side = found.beyond ? 1 : 2;
    }

    /// Up the aisle, step by step, and along the row.
    void addPoints(const SeatBlock& block, std::size_t aisle, const Seat& seat, gpu::SeatWay& way) {
        std::vector<gpu::SeatPoint>& points = scene_.seats.points;
        way.first_point = static_cast<std::uint32_t>(points.size());
        const auto add = [&](glm::dvec2 place, double height) {
            gpu::SeatPoint point{rebase_.local(place), glm::vec2(0.0f), glm::vec2(0.0f),
                                 static_cast<float>(height), 0.0f};
            if (points.size() > way.first_point)
                point.along = points.back().along + glm::distance(points.back().place, point.place);
            points.push_back(point);
        };
        const std::vector<glm::dvec2> line = aisleLine(block, aisle);
        const std::vector<double> heights = aisleHeights(block, aisle);
        for (std::size_t i = 0; i <= seat.row; ++i)
            add(line[i], heights[i]);
        const std::vector<RowPoint> row = wayAlongRow(block, aisle, seat);
        add(row.front().place, row.front().height);
        way.mouth = points.back().along;
        for (std::size_t i = 1; i < row.size(); ++i)
            add(row[i].place, row[i].height);
        way.point_count = static_cast<std::uint32_t>(points.size()) - way.first_point;
        way.length = points.back().along;
        way.fork = gpu::NO_FORK;
        way.free_side = way.lane % 2 == 0 ? 1 : 0;
    }

    const Layout& layout_;
    const Rebase& rebase_;
    Scene& scene_;
    Diagnostics& diagnostics_;
    SeatPlan plan_;
    std::vector<Owner> owners_;
    std::vector<std::uint32_t> parting_;          // rows
    std::map<const SeatBlock*, BlockWays> ways_;  // of blocks with passages
};

}  // namespace

const Behaviour* behaviourOf(const Layout& layout, const Scene& scene, std::size_t group) {
    std::optional<std::size_t> found;
    if (group < layout.flows.size())
        found = layout.flows[group].behaviour;
    else if (group < layout.flows.size() + layout.formations.size())
        found = layout.formations[group - layout.flows.size()].behaviour;
    else if (scene.groups[group].block)
        found = layout.seats[*scene.groups[group].block].behaviour;
    return found ? &layout.behaviours[*found] : nullptr;
}

void buildSeats(const Layout& layout, const Rebase& rebase, Scene& scene, Diagnostics& diagnostics) {
    if (std::ranges::none_of(layout.seats, &SeatBlock::isOpen)) return;
    SeatBuilder(layout, rebase, scene, diagnostics).build();
}

}  // namespace throng::authoring
