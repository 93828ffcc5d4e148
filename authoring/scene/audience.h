// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/seat_rows.h"
#include "base/activities.h"
#include "shaders/shared/scene_types.h"

namespace throng::authoring {

/// Somebody who has a seat.
struct Spectator {
    std::size_t block = 0;   ///< of the layout's seats
    std::size_t number = 0;  ///< of those of the block
    Seat seat;
    gpu::Person person;       ///< what it draws; it is not simulated
    std::uint32_t party = 0;  ///< the first of those whom it sits with, in this list
    std::vector<Deed> deeds;  ///< the first begins before the shot does
};

/// Who sits where from the beginning, block by block and row by row, and what they do. Nobody in blocks that
/// people walk to or leave: those are simulated.
std::vector<Spectator> audienceOf(const Layout& layout);
/// Who sits in one block from the beginning; parties are as above.
std::vector<Spectator> audienceIn(const Layout& layout, std::size_t block);

/// What everybody is to do in shows who has one of these seats, in the order of time.
std::vector<std::vector<SeatCue>> cuesIn(const Layout& layout, const std::vector<Spectator>& seated);

/// How long one stands up, and how long one sits down, s.
inline constexpr double kRisesFor = 0.6, kSitsDownFor = 0.8;

}  // namespace throng::authoring
