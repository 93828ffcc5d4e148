// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/seat_rows.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "authoring/layout/row_floor.h"
#include "authoring/layout/row_line.h"
#include "authoring/layout/seat_mouths.h"

namespace throng::authoring {
namespace {

constexpr double kArcStep = 1.0;       // degrees: of 100 m, the middle of a chord is 4 mm off
constexpr double kOutlineTurn = 0.14;  // rad that a piece of an outline turns at most

/// Shares between two aisles, or an aisle and an end.
struct Section {
    double from, to;
};

/// @param gap m between two sections, in the middle of which there is an aisle
std::vector<Section> sectionsOf(const SeatBlock& block, const RowLine& line, double gap) {
    std::vector<Section> sections;
    const auto count = static_cast<double>(block.aisles + 1);
    for (std::uint64_t i = 0; i <= block.aisles; ++i) {
        const double middle = static_cast<double>(i) / count, next = static_cast<double>(i + 1) / count;
        Section section{i == 0 ? 0.0 : line.advance(middle, 0.5 * gap), next};
        if (i < block.aisles) {
            const double room = line.lengthBetween(middle, next) - 0.5 * gap;
            section.to = line.advance(middle, std::max(room, 0.0));
        }
        sections.push_back(section);
    }
    return sections;
}

std::size_t seatsIn(const SeatBlock& block, const RowLine& line, const Section& section) {
    constexpr double kHair = 1.0e-6;
    const double room = section.to > section.from ? line.lengthBetween(section.from, section.to) : 0.0;
    return static_cast<std::size_t>(std::floor(room / block.width + kHair));
}

double middleRow(const SeatBlock& block) {
    return 0.5 * static_cast<double>(block.rows - 1) * block.pitch;
}

/// The middle of an aisle, so far behind the first row; of a block without any, beside its rows.
glm::dvec2 inAisle(const SeatBlock& block, std::size_t aisle, double back) {
    constexpr double kBeside = 0.45;  // m
    const RowLine line(block, back);
    const glm::dvec2 place = line.at(aisleShare(block, aisle));
    if (block.aisles > 0) return place;
    const glm::dvec2 ahead = line.aheadAt(aisleShare(block, aisle));
    const glm::dvec2 onwards(ahead.y, -ahead.x);  // along the row
    return place + (aisle == 0 ? -kBeside : kBeside) * onwards;
}

}  // namespace

double aisleShare(const SeatBlock& block, std::size_t aisle) {
    if (block.aisles == 0) return static_cast<double>(aisle);
    return static_cast<double>(aisle + 1) / static_cast<double>(block.aisles + 1);
}

std::vector<Seat> seatsOf(const SeatBlock& block) {
    std::vector<Seat> seats;
    const double whole = lengthOf(block);
    for (std::uint64_t row = 0; row < block.rows; ++row) {
        const RowLine line(block, static_cast<double>(row) * block.pitch);
        const RowFloor floor(block, row);
        const std::vector<Section> sections = sectionsOf(block, line, gapOfRow(block, row));
        for (std::size_t number = 0; number < sections.size(); ++number) {
            const std::size_t count = seatsIn(block, line, sections[number]);
            const double spare = line.lengthBetween(sections[number].from, sections[number].to) -
                                 static_cast<double>(count) * block.width;
            for (std::size_t i = 0; i < count; ++i) {
                const double share = line.advance(sections[number].from,
                                                  0.5 * spare + (static_cast<double>(i) + 0.5) * block.width);
                Seat seat{line.at(share), floor.at(share), line.aheadAt(share), static_cast<std::size_t>(row),
                          number,         share * whole};
                if (block.facing && *block.facing != seat.place)
                    seat.ahead = glm::normalize(*block.facing - seat.place);
                seats.push_back(seat);
            }
        }
    }
    return seats;
}

double lengthOf(const SeatBlock& block) {
    return RowLine(block, middleRow(block)).length();
}

std::size_t countSeats(const SeatBlock& block) {
    std::size_t count = 0;
    for (std::uint64_t row = 0; row < block.rows; ++row) {
        const RowLine line(block, static_cast<double>(row) * block.pitch);
        for (const Section& section : sectionsOf(block, line, gapOfRow(block, row)))
            count += seatsIn(block, line, section);
    }
    return count;
}

std::vector<std::vector<glm::dvec2>> standOutlines(const SeatBlock& block) {
    const double before = -0.5 * block.pitch, behind = (static_cast<double>(block.rows) - 0.5) * block.pitch;
    const RowLine front(block, before), back(block, behind);
    const std::vector<Section> near = sectionsOf(block, front, block.aisle_width),
                               far = sectionsOf(block, back, block.aisle_width);
    std::vector<std::vector<glm::dvec2>> outlines;
    for (std::size_t i = 0; i < near.size(); ++i) {
        if (near[i].to <= near[i].from || far[i].to <= far[i].from) continue;
        std::vector<std::pair<double, double>> cuts{{near[i].from, far[i].from}};
        glm::dvec2 way(0.0);
        for (std::size_t corner = 1; corner + 1 < front.corners().size(); ++corner) {
            const double share = front.corners()[corner];
            if (share <= std::max(near[i].from, far[i].from) || share >= std::min(near[i].to, far[i].to))
                continue;
            const glm::dvec2 before_it = front.leftOfPiece(corner - 1), after = front.leftOfPiece(corner);
            if (way == glm::dvec2(0.0)) way = before_it;
            if (glm::dot(way, after) > std::cos(kOutlineTurn)) continue;
            cuts.emplace_back(share, share);
            way = after;
        }
        cuts.emplace_back(near[i].to, far[i].to);
        for (std::size_t cut = 0; cut + 1 < cuts.size(); ++cut)
            outlines.push_back({front.at(cuts[cut].first), back.at(cuts[cut].second),
                                back.at(cuts[cut + 1].second), front.at(cuts[cut + 1].first)});
    }
    return outlines;
}

std::vector<SeatRow> seatRows(const SeatBlock& block) {
    std::vector<SeatRow> rows;
    for (std::uint64_t row = 0; row < block.rows; ++row) {
        const RowLine line(block, static_cast<double>(row) * block.pitch);
        const RowFloor floor(block, row);
        for (const Section& section : sectionsOf(block, line, gapOfRow(block, row))) {
            if (seatsIn(block, line, section) == 0) continue;
            SeatRow made{line.between(section.from, section.to), floor.at(section.from)};
            if (block.on_terrain && block.ground) {
                const std::vector<double> shares = sharesOnFloor(block, line, section.from, section.to);
                made.line.clear();
                for (const double share : shares) {
                    made.line.push_back(line.at(share));
                    made.heights.push_back(floor.at(share));
                }
                made.height = std::ranges::min(made.heights);
            }
            rows.push_back(std::move(made));
        }
    }
    return rows;
}

double passingAhead(const SeatBlock& block) {
    constexpr double kOfTheNextRow = 0.5;  // m: its backs, and half of a body
    return std::clamp(block.pitch - kOfTheNextRow, 0.3, 0.42);
}

std::size_t countAisles(const SeatBlock& block) {
    return block.aisles > 0 ? static_cast<std::size_t>(block.aisles) : 2;
}

std::size_t aisleOf(const SeatBlock& block, const Seat& seat) {
    const double share = seat.along / lengthOf(block);
    if (block.aisles == 0) return share > 0.5 ? 1 : 0;
    if (seat.section == 0) return 0;
    if (seat.section == block.aisles) return seat.section - 1;
    const double middle = (static_cast<double>(seat.section) + 0.5) / static_cast<double>(block.aisles + 1);
    return share > middle ? seat.section : seat.section - 1;
}

std::vector<glm::dvec2> aisleLine(const SeatBlock& block, std::size_t aisle) {
    constexpr double kBeforeTheBlock = 0.7;  // m: room for a body between it and the block
    const double ahead = passingAhead(block);
    std::vector<glm::dvec2> line{inAisle(block, aisle, -0.5 * block.pitch - kBeforeTheBlock)};
    for (std::uint64_t row = 0; row < block.rows; ++row)
        line.push_back(inAisle(block, aisle, static_cast<double>(row) * block.pitch - ahead));
    return line;
}

std::vector<double> aisleHeights(const SeatBlock& block, std::size_t aisle) {
    std::vector<double> heights{heightOfFoot(block, aisleLine(block, aisle).front())};
    for (std::uint64_t row = 0; row < block.rows; ++row)
        heights.push_back(RowFloor(block, row).at(aisleShare(block, aisle)));
    return heights;
}

double aisleWidth(const SeatBlock& block) {
    constexpr double kBesideTheBlock = 0.9;
    return block.aisles > 0 ? block.aisle_width : kBesideTheBlock;
}

std::vector<RowPoint> wayAlongRow(const SeatBlock& block, std::size_t aisle, const Seat& seat) {
    const double back = static_cast<double>(seat.row) * block.pitch - passingAhead(block);
    const RowLine line(block, back);
    const RowFloor floor(block, seat.row);
    const double from = aisleShare(block, aisle), to = seat.along / lengthOf(block);
    std::vector<RowPoint> way;
    for (const double share : sharesOnFloor(block, line, std::min(from, to), std::max(from, to)))
        way.push_back({line.at(share), floor.at(share)});
    if (to < from) std::ranges::reverse(way);
    if (block.aisles == 0) way.insert(way.begin(), {inAisle(block, aisle, back), way.front().height});
    return way;
}

std::vector<glm::dvec2> footOf(const SeatBlock& block, std::size_t aisle) {
    constexpr double kHalf = 0.45;  // m
    const glm::dvec2 foot = hasPassages(block) ? passageFoot(block, aisle) : aisleLine(block, aisle).front();
    return {foot + glm::dvec2(-kHalf, -kHalf), foot + glm::dvec2(kHalf, -kHalf),
            foot + glm::dvec2(kHalf, kHalf), foot + glm::dvec2(-kHalf, kHalf)};
}

std::vector<std::vector<glm::dvec2>> aisleOutlines(const SeatBlock& block) {
    const double before = -0.5 * block.pitch, behind = (static_cast<double>(block.rows) - 0.5) * block.pitch;
    const RowLine front(block, before), back(block, behind);
    const std::vector<Section> near = sectionsOf(block, front, block.aisle_width),
                               far = sectionsOf(block, back, block.aisle_width);
    std::vector<std::vector<glm::dvec2>> outlines;
    for (std::size_t i = 0; i + 1 < near.size(); ++i)
        outlines.push_back(
            {front.at(near[i].to), back.at(far[i].to), back.at(far[i + 1].from), front.at(near[i + 1].from)});
    return outlines;
}

std::vector<glm::dvec2> arcFront(glm::dvec2 centre, double radius, double from, double to) {
    const int steps = std::max(2, static_cast<int>(std::ceil((to - from) / kArcStep)));
    std::vector<glm::dvec2> front;
    for (int i = 0; i <= steps; ++i) {
        const double angle = (from + (to - from) * i / steps) * std::numbers::pi / 180.0;
        front.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return front;
}

bool foldsBack(const SeatBlock& block) {
    const double behind = (static_cast<double>(block.rows) - 0.5) * block.pitch;
    return !RowLine(block, behind).goesOn() || !RowLine(block, -0.5 * block.pitch).goesOn();
}

}  // namespace throng::authoring
