// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/seat_rows.h"
#include "authoring/scene/people.h"
#include "authoring/scene/random.h"

namespace throng::authoring {

/// A seat of the layout.
struct SeatNumber {
    std::size_t block = 0;
    std::size_t seat = 0;  ///< of seatsOf(block)
    auto operator<=>(const SeatNumber&) const = default;
};

/// Which seats of a layout are free, and who gets which.
class SeatPlan {
  public:
    explicit SeatPlan(const Layout& layout);

    const Seat& at(SeatNumber number) const { return seats_[number.block][number.seat]; }
    void take(SeatNumber number) { free_[number.block][number.seat] = false; }
    std::size_t countFree(const std::vector<std::size_t>& blocks) const;
    /// Seats for all of some parties, of each side by side wherever there is room, the rest of the seats
    /// between them. There have to be enough. @returns by person, in the parties' order
    std::vector<SeatNumber> seat(const std::vector<Party>& parties, const std::vector<std::size_t>& blocks,
                                 const GroupRandom& random);

  private:
    /// Free seats side by side, and the parties that get some of them.
    struct Run {
        SeatNumber first;
        std::size_t count = 0, left = 0;
        std::vector<std::size_t> parties;
    };
    std::vector<Run> runsOf(const std::vector<std::size_t>& blocks) const;
    void spread(const Run& run, const std::vector<Party>& parties, const GroupRandom& random,
                std::vector<SeatNumber>& seats);

    const Layout& layout_;
    std::vector<std::vector<Seat>> seats_;
    std::vector<std::vector<bool>> free_;
};

}  // namespace throng::authoring
