// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/seat_plan.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace throng::authoring {
namespace {

constexpr std::uint64_t kRunDraw = 2, kOrderDraw = 3, kGapDraw = 4;  // of Purpose::seat

/// In a row, and reached from one aisle.
bool isBeside(const SeatBlock& block, const Seat& one, const Seat& other) {
    return one.row == other.row && one.section == other.section &&
           aisleOf(block, one) == aisleOf(block, other);
}

/// Larger ones first, as long as there is room for them; then as the seed has it.
std::vector<std::size_t> bySize(const std::vector<Party>& parties, const GroupRandom& random) {
    std::vector<std::size_t> order(parties.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
        return std::pair(-static_cast<int>(parties[i].size),
                         random.word(parties[i].first, Purpose::seat, kOrderDraw));
    });
    return order;
}

/// Those that do not fit anywhere sit apart.
std::vector<Party> inOnes(const Party& party) {
    std::vector<Party> ones;
    for (std::uint64_t i = 0; i < party.size; ++i)
        ones.push_back({party.first + i, 1});
    return ones;
}

}  // namespace

SeatPlan::SeatPlan(const Layout& layout) : layout_(layout) {
    for (const SeatBlock& block : layout.seats) {
        seats_.push_back(block.isOpen() ? seatsOf(block) : std::vector<Seat>{});
        free_.emplace_back(seats_.back().size(), true);
    }
}

std::size_t SeatPlan::countFree(const std::vector<std::size_t>& blocks) const {
    std::size_t count = 0;
    for (const std::size_t block : blocks)
        count += static_cast<std::size_t>(std::ranges::count(free_[block], true));
    return count;
}

std::vector<SeatPlan::Run> SeatPlan::runsOf(const std::vector<std::size_t>& blocks) const {
    std::vector<Run> runs;
    for (const std::size_t block : blocks)
        for (std::size_t i = 0; i < seats_[block].size(); ++i) {
            if (!free_[block][i]) continue;
            const bool goes_on = i > 0 && free_[block][i - 1] &&
                                 isBeside(layout_.seats[block], seats_[block][i - 1], seats_[block][i]);
            if (!goes_on) runs.push_back({{block, i}, 0, 0, {}});
            runs.back().left = ++runs.back().count;
        }
    return runs;
}

std::vector<SeatNumber> SeatPlan::seat(const std::vector<Party>& drawn,
                                       const std::vector<std::size_t>& blocks, const GroupRandom& random) {
    std::vector<Run> runs = runsOf(blocks);
    std::vector<Party> parties = drawn;
    std::size_t people = 0;
    for (const Party& party : drawn)
        people += party.size;
    const auto place = [&](std::size_t party) {
        const std::size_t size = parties[party].size;
        std::size_t room = 0;
        for (const Run& run : runs)
            room += run.left >= size ? run.left : 0;
        if (room == 0) return false;
        std::size_t chosen = random.word(parties[party].first, Purpose::seat, kRunDraw) % room;
        for (Run& run : runs) {
            if (run.left < size) continue;
            if (chosen >= run.left) {
                chosen -= run.left;
                continue;
            }
            run.left -= size;
            run.parties.push_back(party);
            break;
        }
        return true;
    };
    std::vector<Party> apart;
    for (const std::size_t party : bySize(drawn, random))
        if (!place(party))
            for (const Party& one : inOnes(drawn[party]))
                apart.push_back(one);
    for (const Party& one : apart) {
        parties.push_back(one);
        place(parties.size() - 1);
    }
    std::vector<SeatNumber> seats(people);
    for (const Run& run : runs)
        spread(run, parties, random, seats);
    return seats;
}

/// Each empty seat falls before one of the parties, or behind the last.
void SeatPlan::spread(const Run& run, const std::vector<Party>& parties, const GroupRandom& random,
                      std::vector<SeatNumber>& seats) {
    std::vector<std::size_t> gaps(run.parties.size() + 1, 0);
    for (std::size_t i = 0; i < run.left; ++i)
        ++gaps[random.word(run.first.seat + i, Purpose::seat, kGapDraw + run.first.block) % gaps.size()];
    std::vector<std::size_t> order = run.parties;
    std::ranges::stable_sort(order, {}, [&](std::size_t party) {
        return random.word(parties[party].first, Purpose::seat, kOrderDraw);
    });
    SeatNumber next = run.first;
    for (std::size_t i = 0; i < order.size(); ++i) {
        next.seat += gaps[i];
        const Party& party = parties[order[i]];
        for (std::uint64_t member = 0; member < party.size; ++member, ++next.seat) {
            seats[party.first + member] = next;
            take(next);
        }
    }
}

}  // namespace throng::authoring
