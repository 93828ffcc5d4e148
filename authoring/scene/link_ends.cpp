// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/link_ends.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "authoring/layout/bent_link.h"
#include "authoring/layout/level_reader.h"
#include "authoring/link_kinds.h"
#include "authoring/storeys/cabin.h"
#include "authoring/storeys/chart_raster.h"

namespace throng::authoring {
namespace {

constexpr std::array kBeyondEnd = {0.05, 0.15, 0.3};            // m: looks at the ground beyond an end
constexpr std::array kAcrossEnd = {-0.8, -0.4, 0.0, 0.4, 0.8};  // of half its width
constexpr double kSameGround = 1.0;                             // m, in height, over the width of an end
constexpr double kUnderSlab = 0.25;                             // m: floors of cabins are as thick

/// The end of a link, or the doors of a lift.
struct LinkEnd {
    glm::dvec2 at{0.0}, outward{0.0};
    double half_width = 0.0;
    std::size_t level = 0;
};

class EndFinder {
  public:
    EndFinder(Layout& layout, const Walkable& ground, const TerrainPlaces& places, Diagnostics& diagnostics)
        : layout_(layout), ground_(ground), places_(places), diagnostics_(diagnostics) {}

    void run() {
        for (Link& link : layout_.links)
            if (link.isLift())
                raiseLift(link);
            else if (!layout_.levels[link.from].is_landing)
                raiseWay(link);
    }

  private:
    template <class Visit>
    void visitBeyond(const LinkEnd& end, double across, Visit visit) const {
        const glm::dvec2 left(-end.outward.y, end.outward.x);
        for (const double beyond : kBeyondEnd) {
            const glm::dvec2 place = end.at + beyond * end.outward + across * end.half_width * left;
            const std::uint32_t spot = places_.onFootAt(chartCellOf(place), end.level);
            if (spot != kNoSpot && visit(place, spot)) return;
        }
    }

    /// Of what there is beyond an end, the ground that is nearest to its level's place on foot: before the
    /// edge of a deck there may be the street below.
    std::uint32_t groundBeyond(const LinkEnd& end) const {
        std::uint32_t nearest = kNoSpot;
        for (const double across : kAcrossEnd)
            visitBeyond(end, across, [&](glm::dvec2, std::uint32_t spot) {
                if (nearest == kNoSpot ||
                    places_.stepsTo(spot, end.level) < places_.stepsTo(nearest, end.level))
                    nearest = spot;
                return false;
            });
        return nearest;
    }

    std::optional<double> heightAt(const LinkEnd& end) const {
        const std::uint32_t ground = groundBeyond(end);
        if (ground == kNoSpot) return std::nullopt;
        const double about = ground_.spots()[ground].height;
        double sum = 0.0, count = 0.0;
        for (const double across : kAcrossEnd)
            visitBeyond(end, across, [&](glm::dvec2 place, std::uint32_t spot) {
                if (std::abs(ground_.spots()[spot].height - about) > kSameGround) return false;
                const auto height = ground_.groundNear(place, ground_.spots()[spot].height);
                sum += height.value_or(0.0);
                count += height ? 1.0 : 0.0;
                return height.has_value();
            });
        return count > 0.0 ? std::optional(sum / count) : std::nullopt;
    }

    /// 0 where there is no ground, which is told.
    double heightAt(const LinkEnd& end, const Link& link, const std::string& what) {
        if (const auto height = heightAt(end)) return *height;
        std::string others;
        const auto [first, last] = ground_.spotsOf(chartCellOf(end.at + kBeyondEnd.back() * end.outward));
        for (std::uint32_t spot = first; spot < last; ++spot)
            others += fmt::format("{}{:.2f}", spot == first ? "" : ", ", ground_.spots()[spot].height);
        diagnostics_.error(
            link.where,
            fmt::format("{} no ground of level `{}` at [{:.2f}, {:.2f}]", what, layout_.levels[end.level].id,
                        end.at.x, end.at.y),
            others.empty() ? std::string("nobody can stand there: it has to be on the ground, or at its edge")
                           : fmt::format("people stand there at z = {}, and do not get there on foot from "
                                         "that level's `at`",
                                         others));
        return 0.0;
    }

    /// All flights of a link, from the one that begins on the terrain.
    void raiseWay(Link& first) {
        std::vector<Link*> flights = {&first};
        std::vector<Level*> landings;
        double run = glm::distance(first.begin, first.end);
        while (layout_.levels[flights.back()->to].is_landing) {
            const std::size_t landing = flights.back()->to;
            landings.push_back(&layout_.levels[landing]);
            for (Link& next : layout_.links)
                if (!next.isLift() && next.from == landing) flights.push_back(&next);
            if (flights.size() == landings.size()) return;
            run += glm::distance(flights.back()->begin, flights.back()->end);
        }
        const Link& last = *flights.back();
        const double half = halfWidthOf(first);
        const std::string name = landings.empty() ? first.id : first.id.substr(0, first.id.rfind(','));
        const double low = heightAt({first.begin, glm::normalize(first.begin - first.end), half, first.from},
                                    first, fmt::format("link `{}` begins on", name));
        const double high = heightAt({last.end, glm::normalize(last.end - last.begin), half, last.to}, first,
                                     fmt::format("link `{}` ends on", name));
        if (diagnostics_.hasErrors()) return;
        Link whole = first;
        whole.id = name;
        checkClimb(whole, std::abs(high - low), run, first.where, diagnostics_);
        std::vector<Link> copies;
        for (const Link* flight : flights)
            copies.push_back(*flight);
        raiseLandings(copies, landings, low, high, riserOf(first));
        for (std::size_t i = 0; i < flights.size(); ++i) {
            flights[i]->heights = {i == 0 ? low : landings[i - 1]->height,
                                   i < landings.size() ? landings[i]->height : high};
            if (landings.empty() || diagnostics_.hasErrors()) continue;
            checkClimb(*flights[i], std::abs(flights[i]->heights->y - flights[i]->heights->x),
                       glm::distance(flights[i]->begin, flights[i]->end), first.where, diagnostics_);
        }
    }

    void raiseLift(Link& link) {
        Lift& lift = link.lift;
        for (std::size_t stop = 0; stop < lift.levels.size(); ++stop) {
            const glm::dvec2 outward = outOfCabin(lift, stop);
            lift.heights.push_back(heightAt(
                {lift.at + 0.5 * lift.size.y * outward, outward, 0.5 * lift.door_width, lift.levels[stop]},
                link, fmt::format("the doors of lift `{}` open onto", link.id)));
            if (stop == 0 || diagnostics_.hasErrors()) continue;
            const double rise = lift.heights[stop] - lift.heights[stop - 1],
                         least = kLeastLiftRise + kUnderSlab;
            if (rise < least)
                diagnostics_.error(
                    link.where,
                    fmt::format(
                        "the grounds of levels `{}` and `{}` are {:.2f} m apart before the doors of lift "
                        "`{}`: its stops are {} m or more",
                        layout_.levels[lift.levels[stop - 1]].id, layout_.levels[lift.levels[stop]].id, rise,
                        link.id, least));
        }
    }

    Layout& layout_;
    const Walkable& ground_;
    const TerrainPlaces& places_;
    Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Layout> withLinkEnds(const Layout& layout, const Walkable& ground, const TerrainPlaces& places,
                                   Diagnostics& diagnostics) {
    Layout raised = layout;
    EndFinder(raised, ground, places, diagnostics).run();
    return diagnostics.hasErrors() ? std::nullopt : std::optional(std::move(raised));
}

}  // namespace throng::authoring
