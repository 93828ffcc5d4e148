// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/seat_mouths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "authoring/layout/row_line.h"

namespace throng::authoring {
namespace {

constexpr double kSlab = 0.15;           // m: what goes on over a passage is so thick
constexpr double kCheek = 0.1;           // m: the sides of a passage
constexpr double kBehindTheBlock = 0.7;  // m: room for a body between it and the block
constexpr double kMostAside = 0.3;       // m
constexpr double kComesToSide = 1.2;     // m of the row, as shaders/seats/pace.glsl has it

double treadOf(const SeatBlock& block, std::size_t row) {
    return block.height + static_cast<double>(row) * block.rise;
}

/// m behind the first row: where one walks before the seats of a row.
double walkOf(const SeatBlock& block, std::size_t row) {
    return static_cast<double>(row) * block.pitch - passingAhead(block);
}

/// m behind the first row: where the passage begins.
double openingOf(const SeatBlock& block) {
    return (static_cast<double>(landingRow(block)) + 0.5) * block.pitch;
}

/// m, of the floor of the passage, so far behind the first row.
double floorAt(const SeatBlock& block, double back) {
    const double share = std::clamp((back - openingOf(block)) / passageLength(block), 0.0, 1.0);
    const double landing = treadOf(block, landingRow(block));
    return landing + share * (block.mouths.height - landing);
}

double middleOfFlight(const SeatBlock& block) {
    return 0.5 * block.aisle_width + kCheek + 0.5 * kFlightWidth;
}

/// Places round an aisle: metres along the rows from its middle, and behind the first row.
class AislePlan {
  public:
    AislePlan(RowLines& lines, std::size_t aisle) : lines_(lines), share_(aisleShare(lines.block(), aisle)) {}

    double shareAt(double aside, double back) const { return lines_.at(back).advance(share_, aside); }
    glm::dvec2 at(glm::dvec2 aside_back) const {
        const RowLine& line = lines_.at(aside_back.y);
        return line.at(line.advance(share_, aside_back.x));
    }

  private:
    RowLines& lines_;
    double share_;
};

/// Whether there are rows behind the landing.
bool hasOpening(const SeatBlock& block) {
    return block.mouths.at == SeatBlock::Mouths::At::row && landingRow(block) + 1 < block.rows;
}

double sideOf(bool beyond) {
    return beyond ? 1.0 : -1.0;
}

/// The way up or down an aisle to a row.
class WayMaker {
  public:
    WayMaker(RowLines& lines, std::size_t aisle, bool beyond, std::size_t row)
        : block_(lines.block()),
          row_(row),
          plan_(lines, aisle),
          landing_(landingRow(block_)),
          side_(sideOf(beyond)),
          aside_(std::min(kMostAside, 0.25 * block_.aisle_width)) {
        way_.beyond = beyond;
    }

    WayToRow make() {
        const double back = openingOf(block_);
        addStraight({0.0, back + passageLength(block_)}, block_.mouths.height);
        addStraight({0.0, back}, treadOf(block_, landing_));
        if (row_ >= landing_ && hasOpening(block_))
            goBack();
        else
            goToFront();
        return {std::move(way_), aside_of_row_};
    }

  private:
    void goToFront() {
        addStraight({0.0, walkOf(block_, landing_)}, treadOf(block_, landing_));
        way_.fork = way_.points.back().along;
        for (std::size_t row = landing_; row > row_; --row) {
            addSteps(0.0, row, row - 1, {aside_, 0.0}, {side_ * aside_, 0.0});
            addStraight({0.0, walkOf(block_, row - 1)}, treadOf(block_, row - 1));
        }
    }

    /// Round the opening, up the flight on the seat's side, and on in the middle. Those of the landing's own
    /// row come to the foot of the flight, so that nobody waits before the opening.
    void goBack() {
        const double flight = side_ * middleOfFlight(block_), height = treadOf(block_, landing_);
        const double narrow = std::min(kMostAside, 0.25 * kFlightWidth);
        const std::size_t last = std::min(lastCutRow(block_), row_);
        way_.branch = way_.beyond ? 1 : 2;
        add({0.0, walkOf(block_, landing_)}, height, {aside_, side_ * aside_}, {side_ * aside_, 0.0});
        way_.fork = way_.points.back().along;
        add({flight, walkOf(block_, landing_)}, height, {-narrow, row_ == landing_ ? 0.0 : side_ * aside_},
            {0.0, 0.0});
        for (std::size_t row = landing_; row < last; ++row) {
            addSteps(flight, row, row + 1, {-narrow, 0.0}, {0.0, 0.0});
            const bool turns = row + 1 == last && row_ > last;
            add({flight, walkOf(block_, row + 1)}, treadOf(block_, row + 1),
                {-narrow, turns ? -side_ * aside_ : 0.0}, {0.0, 0.0});
        }
        aside_of_row_ = flight;
        if (row_ == last) return;
        aside_of_row_ = 0.0;
        add({0.0, walkOf(block_, last)}, treadOf(block_, last), {-aside_, -side_ * aside_},
            {side_ * aside_, 0.0});
        for (std::size_t row = last; row < row_; ++row) {
            addSteps(0.0, row, row + 1, {-aside_, 0.0}, {side_ * aside_, 0.0});
            add({0.0, walkOf(block_, row + 1)}, treadOf(block_, row + 1), {-aside_, 0.0},
                {side_ * aside_, 0.0});
        }
    }

    /// Two steps to a row, as they are built: level between them, and quickly up on each.
    void addSteps(double aside, std::size_t from, std::size_t to, glm::dvec2 beside, glm::dvec2 alone) {
        constexpr std::array kEdges = {0.35,
                                       0.85};  // of the pitch behind where one walks before the lower row
        constexpr double kHalfRise = 0.08;     // m
        if (block_.rise == 0.0) return;
        const std::size_t lower = std::min(from, to);
        const double low = treadOf(block_, lower);
        std::vector<glm::dvec2> places;  // m behind that, and height
        for (std::size_t step = 0; step < kEdges.size(); ++step)
            for (const double end : {-1.0, 1.0})
                places.emplace_back(
                    kEdges[step] * block_.pitch + end * kHalfRise,
                    low + 0.5 * block_.rise * static_cast<double>(step + (end > 0.0 ? 1 : 0)));
        if (from > to) std::ranges::reverse(places);
        for (const glm::dvec2 place : places)
            add({aside, walkOf(block_, lower) + place.x}, place.y, beside, alone);
    }

    void addStraight(glm::dvec2 at, double height) { add(at, height, {aside_, 0.0}, {side_ * aside_, 0.0}); }

    /// As far along as those walk who are alone: two who follow each other are nowhere nearer than it tells.
    void add(glm::dvec2 at, double height, glm::dvec2 beside, glm::dvec2 alone) {
        const glm::dvec2 place = plan_.at(at), walked = at + alone;
        AislePoint point{place, height, 0.0, plan_.at(at + beside) - place, plan_.at(walked) - place};
        if (!way_.points.empty()) point.along = way_.points.back().along + glm::distance(walked, last_);
        last_ = walked;
        way_.points.push_back(point);
    }

    const SeatBlock& block_;
    std::size_t row_;
    AislePlan plan_;
    std::size_t landing_;
    double side_, aside_, aside_of_row_ = 0.0;
    glm::dvec2 last_{0.0};
    AisleWay way_;
};

double lengthTo(const RowLine& line, double from, double to) {
    return line.lengthBetween(std::min(from, to), std::max(from, to));
}

}  // namespace

bool hasPassages(const SeatBlock& block) {
    return block.mouths.at != SeatBlock::Mouths::At::front;
}

std::size_t landingRow(const SeatBlock& block) {
    const std::uint64_t last = block.rows - 1;
    if (block.mouths.at == SeatBlock::Mouths::At::back) return static_cast<std::size_t>(last);
    return static_cast<std::size_t>(std::min(block.mouths.row - 1, last));
}

std::size_t lastCutRow(const SeatBlock& block) {
    const std::size_t landing = landingRow(block);
    if (block.mouths.at != SeatBlock::Mouths::At::row) return landing;
    for (std::size_t row = landing + 1; row < block.rows; ++row) {
        const double front = (static_cast<double>(row) - 0.5) * block.pitch;
        if (treadOf(block, row) - kSlab - floorAt(block, front) >= kPassageHeadroom) return row;
    }
    return static_cast<std::size_t>(block.rows - 1);
}

double gapOfRow(const SeatBlock& block, std::size_t row) {
    const bool is_cut = hasOpening(block) && row >= landingRow(block) && row <= lastCutRow(block);
    return is_cut ? block.aisle_width + 2.0 * (kCheek + kFlightWidth) : block.aisle_width;
}

double passageLength(const SeatBlock& block) {
    const double behind = (static_cast<double>(block.rows) - 0.5) * block.pitch;
    return block.mouths.passage.value_or(behind - openingOf(block) + kBehindTheBlock);
}

glm::dvec2 passageFoot(const SeatBlock& block, std::size_t aisle) {
    RowLines lines(block);
    return AislePlan(lines, aisle).at({0.0, openingOf(block) + passageLength(block)});
}

std::vector<glm::dvec2> passageOutline(const SeatBlock& block, std::size_t aisle) {
    constexpr double kStep = 0.1;  // m
    RowLines lines(block);
    const AislePlan plan(lines, aisle);
    const double opening = openingOf(block), foot = opening + passageLength(block);
    double end = foot - kBehindTheBlock;
    while (end > opening && std::abs(floorAt(block, end) - block.mouths.height) < kPassageHeadroom + kSlab)
        end -= kStep;
    end = std::max(end, opening);
    const double begin = foot - kBehindTheBlock, half = 0.5 * block.aisle_width + kCheek;
    if (begin - end < kStep) return {};
    return {plan.at({-half, begin}), plan.at({half, begin}), plan.at({half, end}), plan.at({-half, end})};
}

BlockWays::BlockWays(const SeatBlock& block) : block_(block), lines_(block), length_(lengthOf(block)) {}

AisleWay BlockWays::to(std::size_t aisle, const Seat& seat) {
    const bool beyond = seat.section > aisle;
    const auto [found, is_new] = to_rows_.try_emplace({aisle, beyond, seat.row});
    if (is_new) found->second = WayMaker(lines_, aisle, beyond, seat.row).make();
    AisleWay way = found->second.way;
    addRow(way, aisle, found->second.aside, seat);
    return way;
}

/// @param aside m from the aisle's middle, where one turns into the row
void BlockWays::addRow(AisleWay& way, std::size_t aisle, double aside, const Seat& seat) {
    const double back = walkOf(block_, seat.row), side = sideOf(way.beyond);
    const RowLine& line = lines_.at(back);
    way.mouth = way.points.back().along;
    const double from = AislePlan(lines_, aisle).shareAt(aside, back), to = seat.along / length_;
    const double beside =
        line.advance(from, side * std::min(kComesToSide, std::abs(lengthTo(line, from, to))));
    const auto pieces = way.beyond ? line.between(beside, to) : line.between(to, beside);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const glm::dvec2 place = way.beyond ? pieces[i] : pieces[pieces.size() - 1 - i];
        const AislePoint& before = way.points.back();
        const double step = glm::distance(place, before.place + before.alone);
        if (i > 0 && step < 1.0e-6) continue;
        way.points.push_back(
            {place, treadOf(block_, seat.row), before.along + step, glm::dvec2(0.0), glm::dvec2(0.0)});
    }
}

std::vector<Flight> flightsOf(const SeatBlock& block, std::size_t aisle) {
    RowLines lines(block);
    const AislePlan plan(lines, aisle);
    const auto flight = [&](std::size_t from, std::size_t to, double aside, double width) {
        Flight made{{}, {}, width};
        for (std::size_t row = from; row <= to; ++row) {
            made.line.push_back(plan.at({aside, walkOf(block, row)}));
            made.heights.push_back(treadOf(block, row));
        }
        return made;
    };
    const std::size_t landing = landingRow(block), cut = lastCutRow(block), last = block.rows - 1;
    std::vector<Flight> flights;
    if (landing > 0) flights.push_back(flight(0, landing, 0.0, block.aisle_width));
    if (cut == landing) return flights;
    for (const double side : {1.0, -1.0})
        flights.push_back(flight(landing, cut, side * middleOfFlight(block), kFlightWidth));
    if (last > cut) flights.push_back(flight(cut, last, 0.0, block.aisle_width));
    return flights;
}

Flight passageOf(const SeatBlock& block, std::size_t aisle) {
    RowLines lines(block);
    const AislePlan plan(lines, aisle);
    const double opening = openingOf(block), landing = treadOf(block, landingRow(block));
    return {{plan.at({0.0, opening + passageLength(block)}), plan.at({0.0, opening}),
             plan.at({0.0, walkOf(block, landingRow(block))})},
            {block.mouths.height, landing, landing},
            block.aisle_width};
}

}  // namespace throng::authoring
