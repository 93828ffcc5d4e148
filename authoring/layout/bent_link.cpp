// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/bent_link.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "authoring/link_kinds.h"

namespace throng::authoring {
namespace {

constexpr double kLanding = 0.6;         // m before and behind a corner, at least
constexpr double kShortestFlight = 0.5;  // m
constexpr double kSharpest = 130.0;      // degrees that one corner turns at most

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

glm::dvec2 leftOf(glm::dvec2 way) {
    return {-way.y, way.x};
}

/// Counter-clockwise, without points that lie on its edges (Andrew's monotone chain).
std::vector<glm::dvec2> hullOf(const std::vector<glm::dvec2>& corners) {
    constexpr double kHair = 1.0e-9, kSame = 1.0e-6;  // m^2; m
    // Of two that are nearly in one place, the one before and the one behind a third would hide that.
    std::vector<glm::dvec2> points;
    for (const glm::dvec2 corner : corners)
        if (std::ranges::none_of(points,
                                 [&](glm::dvec2 known) { return glm::distance(known, corner) < kSame; }))
            points.push_back(corner);
    std::ranges::sort(points,
                      [](glm::dvec2 a, glm::dvec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<glm::dvec2> hull;
    for (const bool back : {false, true}) {
        const std::size_t first = hull.size();
        for (const glm::dvec2 point : points) {
            while (hull.size() >= first + 2 &&
                   cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= kHair)
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        if (!back) std::ranges::reverse(points);
    }
    return hull;
}

class Bending {
  public:
    Bending(const Link& link, const std::vector<glm::dvec2>& path, std::optional<BentLinkFault>& fault)
        : link_(link), path_(path), half_(halfWidthOf(link)), fault_(fault) {}

    BentLink run(double low, double high, double riser) {
        for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
            if (glm::distance(path_[i], path_[i + 1]) < 0.05)
                return tell(
                    fmt::format("link `{}`: two points of its path are in one place, at [{:.2f}, {:.2f}]",
                                link_.id, path_[i].x, path_[i].y),
                    "leave one of them out");
            ways_.push_back(glm::normalize(path_[i + 1] - path_[i]));
        }
        for (std::size_t corner = 1; corner + 1 < path_.size(); ++corner)
            if (turnAt(corner) > kSharpest)
                return tell(
                    fmt::format("link `{}` turns by {:.0f} degrees at [{:.2f}, {:.2f}], {:.0f} at most",
                                link_.id, turnAt(corner), path_[corner].x, path_[corner].y, kSharpest),
                    fmt::format("for a half turn give the landing two corners, {:.1f} m apart",
                                std::ceil(10.0 * (2.0 * half_)) / 10.0));
        cut();
        if (!fault_) checkApart();
        if (fault_) return {};
        std::vector<Level*> landings;
        for (Level& landing : result_.landings)
            landings.push_back(&landing);
        raiseLandings(result_.flights, landings, low, high, riser);
        return std::move(result_);
    }

  private:
    struct Piece {  // of the path, between two landings
        glm::dvec2 begin, end;
    };

    BentLink tell(std::string message, std::string hint) {
        fault_ = {std::move(message), std::move(hint)};
        return {};
    }

    double turnAt(std::size_t corner) const {
        const double cosine = std::clamp(glm::dot(ways_[corner - 1], ways_[corner]), -1.0, 1.0);
        return std::acos(cosine) * 180.0 / std::numbers::pi;
    }

    /// m of the flights on either side that the landing at a corner takes up.
    double landingAt(std::size_t corner) const {
        const double turn = turnAt(corner) * std::numbers::pi / 180.0;
        return std::max(half_ * std::tan(0.5 * turn), kLanding);
    }

    /// Corners between which no flight fits have a landing together.
    void cut() {
        glm::dvec2 begin = path_.front();
        for (std::size_t corner = 1; corner + 1 < path_.size();) {
            addFlight(begin, path_[corner] - landingAt(corner) * ways_[corner - 1], corner - 1);
            std::vector<glm::dvec2> edge = cornerOf(corner);
            std::size_t last = corner;
            while (last + 2 < path_.size() && isShort(last)) {
                ++last;
                const std::vector<glm::dvec2> more = cornerOf(last);
                edge.insert(edge.end(), more.begin(), more.end());
            }
            begin = path_[last] + landingAt(last) * ways_[last];
            addEnds(edge, path_[corner] - landingAt(corner) * ways_[corner - 1], ways_[corner - 1]);
            addEnds(edge, begin, ways_[last]);
            addLanding(hullOf(edge));
            corner = last + 1;
        }
        addFlight(begin, path_.back(), path_.size() - 2);
    }

    bool isShort(std::size_t corner) const {
        const double between = glm::distance(path_[corner], path_[corner + 1]);
        return between < landingAt(corner) + landingAt(corner + 1) + kShortestFlight;
    }

    /// The outer corner of a landing, where the sides of both flights meet.
    std::vector<glm::dvec2> cornerOf(std::size_t corner) const {
        const glm::dvec2 before = ways_[corner - 1], after = ways_[corner];
        const glm::dvec2 sum = leftOf(before) + leftOf(after);
        const double outwards = cross(before, after) > 0.0 ? -1.0 : 1.0;
        return {path_[corner] + outwards * half_ * 2.0 * sum / glm::dot(sum, sum)};
    }

    void addEnds(std::vector<glm::dvec2>& edge, glm::dvec2 place, glm::dvec2 way) const {
        for (const double side : {-half_, half_})
            edge.push_back(place + side * leftOf(way));
    }

    void addFlight(glm::dvec2 begin, glm::dvec2 end, std::size_t piece) {
        const double length = glm::dot(end - begin, ways_[piece]);
        if (length < kShortestFlight && !fault_)
            fault_ = {
                fmt::format("link `{}` has {:.2f} m left for the flight from [{:.2f}, {:.2f}] to [{:.2f}, "
                            "{:.2f}] beside its landings, {:.1f} m at least",
                            link_.id, std::max(length, 0.0), path_[piece].x, path_[piece].y,
                            path_[piece + 1].x, path_[piece + 1].y, kShortestFlight),
                "move the corner away, or make the link narrower"};
        Link flight = link_;
        flight.begin = begin;
        flight.end = end;
        flight.id = fmt::format("{}, flight {}", link_.id, result_.flights.size() + 1);
        result_.flights.push_back(std::move(flight));
    }

    void addLanding(std::vector<glm::dvec2> floor) {
        Level landing;
        landing.id = fmt::format("{}, landing {}", link_.id, result_.landings.size() + 1);
        landing.floor = std::move(floor);
        landing.where = link_.where;
        landing.is_landing = true;
        result_.landings.push_back(std::move(landing));
    }

    /// Two flights that follow each other may not lie in one place.
    void checkApart() {
        for (std::size_t i = 0; i + 1 < result_.flights.size(); ++i) {
            const Link &a = result_.flights[i], &b = result_.flights[i + 1];
            if (!overlap(a, b) || fault_) continue;
            fault_ = {fmt::format(
                          "link `{}`: its flights from [{:.2f}, {:.2f}] and from [{:.2f}, {:.2f}] lie in one "
                          "place",
                          link_.id, a.begin.x, a.begin.y, b.begin.x, b.begin.y),
                      fmt::format("their middles have to be {:.2f} m apart", 2.0 * half_)};
        }
    }

    /// Rectangles, by the axes of both.
    bool overlap(const Link& a, const Link& b) const {
        constexpr double kHair = 1.0e-6;  // m
        for (const Link* link : {&a, &b}) {
            const glm::dvec2 along = glm::normalize(link->end - link->begin);
            for (const glm::dvec2 axis : {along, leftOf(along)}) {
                const auto [low_a, high_a] = spanOf(a, axis);
                const auto [low_b, high_b] = spanOf(b, axis);
                if (high_a < low_b + kHair || high_b < low_a + kHair) return false;
            }
        }
        return true;
    }

    std::pair<double, double> spanOf(const Link& flight, glm::dvec2 axis) const {
        const glm::dvec2 left = leftOf(glm::normalize(flight.end - flight.begin));
        const double begin = glm::dot(flight.begin, axis), end = glm::dot(flight.end, axis);
        const double aside = half_ * std::abs(glm::dot(left, axis));
        return {std::min(begin, end) - aside, std::max(begin, end) + aside};
    }

    const Link& link_;
    const std::vector<glm::dvec2>& path_;
    double half_;
    std::optional<BentLinkFault>& fault_;
    std::vector<glm::dvec2> ways_;
    BentLink result_;
};

}  // namespace

void raiseLandings(const std::vector<Link>& flights, const std::vector<Level*>& landings, double low,
                   double high, double riser) {
    double whole = 0.0, so_far = 0.0;
    for (const Link& flight : flights)
        whole += glm::distance(flight.begin, flight.end);
    const double steps = riser > 0.0 ? std::max(std::round(std::abs(high - low) / riser), 1.0) : 0.0;
    for (std::size_t i = 0; i < landings.size(); ++i) {
        so_far += glm::distance(flights[i].begin, flights[i].end);
        double share = so_far / whole;
        if (steps > 0.0) share = std::round(share * steps) / steps;
        landings[i]->height = low + share * (high - low);
    }
}

BentLink bend(const Link& link, const std::vector<glm::dvec2>& path, double low, double high, double riser,
              std::optional<BentLinkFault>& fault) {
    return Bending(link, path, fault).run(low, high, riser);
}

}  // namespace throng::authoring
