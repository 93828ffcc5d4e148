// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

#include "authoring/storeys/before_ends.h"
#include "authoring/storeys/chart_mesh.h"
#include "authoring/storeys/given_ways.h"
#include "authoring/storeys/links_apart.h"
#include "authoring/storeys/plane.h"
#include "authoring/storeys/railings.h"
#include "base/polygon.h"

namespace throng::authoring {
namespace {

constexpr double kRailingHeight = 1.1;  // m
constexpr double kShaftHeight = 2.3;    // m, of a lift's sides at each of its stops

class LayingOut {
  public:
    LayingOut(const Layout& layout, Diagnostics& diagnostics) : layout_(layout), diagnostics_(diagnostics) {}

    std::shared_ptr<const Charts> run() {
        if (layout_.levels.size() + layout_.links.size() >= kMostCharts)
            diagnostics_.error(layout_.levels.back().where,
                               fmt::format("there are {} levels and links, more than the {} that can be",
                                           layout_.levels.size() + layout_.links.size(), kMostCharts - 1));
        if (diagnostics_.hasErrors()) return nullptr;
        result_->charts = chartsOf(layout_);
        if (result_->charts.size() >= kMostCharts)
            diagnostics_.error(
                layout_.levels.back().where,
                fmt::format("levels, links and the stops of lifts are {}, more than the {} that can be",
                            result_->charts.size(), kMostCharts - 1));
        result_->reach = reachOf(layout_);
        checkStoreys();
        checkLinksApart(result_->charts, layout_, diagnostics_);
        if (diagnostics_.hasErrors()) return nullptr;
        layInPlane(*result_);
        checkLinks();
        if (diagnostics_.hasErrors()) return nullptr;
        const auto level = [](const GivenPeople& given, glm::dvec2) {
            return std::optional(static_cast<std::uint32_t>(given.level));
        };
        result_->given = chartsOfWays(layout_, *result_, level, diagnostics_);
        if (diagnostics_.hasErrors()) return nullptr;
        result_->plane = moved(layout_, result_->charts, result_->given);
        raiseWalls();
        copyWallsIntoMargins(*result_, standing_);
        thinRailingsBesideLinks();
        result_->home_mesh = homeMesh(result_->charts, layout_);
        result_->plane_mesh = planeMesh(result_->charts, layout_, result_->reach);
        return result_;
    }

  private:
    /// Two floors at nearly the same height may not lie over each other, nor so that nobody can stand
    /// between.
    void checkStoreys() {
        const auto& charts = result_->charts;
        for (std::size_t i = 0; i < layout_.levels.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const double apart = std::abs(charts[i].height - charts[j].height);
                if (apart >= kHeadroom) continue;
                if (const auto at = commonPoint(charts[i], charts[j]))
                    diagnostics_.error(
                        layout_.levels[i].where,
                        fmt::format(
                            "levels `{}` and `{}` lie over each other at [{:.2f}, {:.2f}], {:.2f} m apart",
                            charts[j].name, charts[i].name, at->x, at->y, apart),
                        fmt::format("people need {} m over their heads", kHeadroom));
            }
    }

    static std::optional<glm::dvec2> commonPoint(const Chart& a, const Chart& b) {
        const auto [lower_a, upper_a] = a.bounds();
        const auto [lower_b, upper_b] = b.bounds();
        const glm::dvec2 lower = glm::max(lower_a, lower_b), upper = glm::min(upper_a, upper_b);
        const double step = std::max(kChartCell, std::max(upper.x - lower.x, upper.y - lower.y) / 400.0);
        const glm::ivec2 count(glm::ceil((upper - lower) / step));
        for (int y = 0; y < count.y; ++y)
            for (int x = 0; x < count.x; ++x)
                if (const glm::dvec2 at = lower + (glm::dvec2(x, y) + 0.5) * step;
                    a.contains(at) && b.contains(at))
                    return at;
        return std::nullopt;
    }

    void checkLinks() {
        for (std::size_t i = layout_.levels.size(); i < result_->charts.size(); ++i) {
            const Chart& link = result_->charts[i];
            if (link.is_cabin) {
                checkCabin(i);
                continue;
            }
            for (const std::size_t level : {link.link_from, link.link_to}) {
                if (result_->rasters[i].isJoinedTo(level)) {
                    tellOfNarrowEnd(link, level);
                    continue;
                }
                const glm::dvec2 end =
                    level == link.link_from ? link.link.at(0.0, 0.0) : link.link.at(link.link.length, 0.0);
                diagnostics_.error(
                    layout_.links[link.index].where,
                    fmt::format("link `{}` does not reach the floor of level `{}` at [{:.2f}, {:.2f}]",
                                link.name, result_->charts[level].name, end.x, end.y),
                    "its path has to end on the floor's edge, or on the floor");
            }
        }
    }

    /// A link that only partly ends at its floor is a bottleneck that nobody sees.
    void tellOfNarrowEnd(const Chart& link, std::size_t level) const {
        constexpr double kLeast = 0.6, kBeyond = 0.05;  // share of its width; m
        constexpr int kPlaces = 40;
        const double end = level == link.link_from ? -kBeyond : link.link.length + kBeyond;
        int on_floor = 0;
        for (int i = 0; i < kPlaces; ++i) {
            const double aside = link.link.half_width * ((2.0 * i + 1.0) / kPlaces - 1.0);
            on_floor += result_->charts[level].contains(link.link.at(end, aside));
        }
        const double share = static_cast<double>(on_floor) / kPlaces;
        if (share >= kLeast) return;
        const double width = layout_.links[link.index].width;
        diagnostics_.warning(
            layout_.links[link.index].where,
            fmt::format("link `{}` meets the floor of level `{}` with {:.1f} m of its {:.1f} m", link.name,
                        result_->charts[level].name, share * width, width),
            "move its end to where the floor is as wide");
    }

    /// That a lift takes people somewhere, and its cabin takes people.
    void checkCabin(std::size_t chart) {
        const Chart& cabin = result_->charts[chart];
        const Link& link = layout_.links[cabin.index];
        const std::string& level = layout_.levels[cabin.link_from].id;
        const glm::dvec2 before = cabin.link.at(-kBeforeDoors, 0.0);
        if (!result_->rasters[chart].isJoinedTo(cabin.link_from))
            diagnostics_.error(
                link.where,
                fmt::format("the doors of lift `{}` open onto no floor at level `{}`, at [{:.2f}, {:.2f}]",
                            link.id, level, before.x, before.y),
                "turn its `doors`, list the level under `opposite`, or move it");
        for (const Wall& wall : layout_.walls)
            if (wall.level == cabin.link_from && standsBefore(wall, cabin, false))
                diagnostics_.error(link.where,
                                   fmt::format("the doors of lift `{}` open into wall `{}` at level `{}`",
                                               link.id, wall.id, level),
                                   fmt::format("leave {:.1f} m before them free", kBeforeDoors));
        if (cabin.stop > 0) return;
        checkRoomInCabin(layout_, link, diagnostics_);
    }

    void addWall(std::size_t chart, Wall wall) {
        wall.level = chart;
        standing_.push_back({result_->walls.size(), chart});
        result_->walls.push_back(wall);
    }

    /// Stands may lie behind the floor from which they keep people off.
    bool isOfStand(const Wall& wall) const {
        return std::ranges::any_of(layout_.seats, [&](const SeatBlock& block) {
            return block.where.line == wall.where.line && block.where.column == wall.where.column;
        });
    }

    /// A wall that nobody can come near to was meant for another level, or is out of place.
    void tellOfWallBeside(const Wall& wall) const {
        constexpr double kNearby = 0.5;  // m
        const Chart& chart = result_->charts[wall.level];
        for (std::size_t i = 0; i + 1 < wall.points.size() + (wall.closed ? 1 : 0); ++i)
            for (const double along : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                const glm::dvec2 at =
                    glm::mix(wall.points[i], wall.points[(i + 1) % wall.points.size()], along);
                for (const glm::dvec2 aside :
                     {glm::dvec2(0.0), glm::dvec2(kNearby, 0.0), glm::dvec2(-kNearby, 0.0),
                      glm::dvec2(0.0, kNearby), glm::dvec2(0.0, -kNearby)})
                    if (chart.contains(at + aside)) return;
            }
        diagnostics_.warning(
            wall.where,
            fmt::format("wall `{}` does not stand on the floor of level `{}`", wall.id, chart.name),
            "it is on the first level where it names no other");
    }

    /// The layout's walls stand on their levels; floors and links end in railings.
    void raiseWalls() {
        for (const Wall& wall : layout_.walls) {
            if (!isOfStand(wall)) tellOfWallBeside(wall);
            result_->ground_along_walls.emplace_back(result_->charts[wall.level].height);
            addWall(wall.level, wall);
        }
        for (std::size_t chart = 0; chart < result_->charts.size(); ++chart) {
            std::size_t count = 0;
            for (const Railing& railing : railingsOf(result_->charts, chart)) {
                Wall wall;
                wall.id = fmt::format("railing:{}:{}", result_->charts[chart].name, count++);
                wall.points = railing.points;
                wall.thickness = kRailing;
                wall.height = result_->charts[chart].is_cabin ? kShaftHeight : kRailingHeight;
                wall.where = result_->charts[chart].is_link
                                 ? layout_.links[result_->charts[chart].index].where
                                 : layout_.levels[chart].where;
                // Round a cabin there are its own sides: two in one place would be drawn through each other.
                const Chart* link = linkAlong(chart, railing);
                if (!link || !link->is_cabin) {
                    if (link) beside_links_.push_back(result_->walls.size());
                    result_->ground_along_walls.emplace_back(railing.low, railing.high);
                    addWall(chart, wall);
                }
                movePoints(wall.points, result_->charts[chart].shift);
                result_->plane.walls.push_back(std::move(wall));
            }
        }
    }

    /// The link whose side a railing of a floor stands along: as high as its cabin, or below its railing.
    const Chart* linkAlong(std::size_t floor, const Railing& railing) const {
        constexpr double kHair = 1.0e-6;  // m
        if (result_->charts[floor].is_link) return nullptr;
        const glm::dvec2 middle = 0.5 * (railing.points.front() + railing.points.back());
        for (const Chart& chart : result_->charts) {
            if (!chart.is_link || (chart.is_cabin && chart.link_from != floor)) continue;
            const double along = chart.link.alongOf(middle), aside = std::abs(chart.link.asideOf(middle));
            if (along > -kHair && along < chart.link.length + kHair && aside < chart.link.half_width + kHair)
                return &chart;
        }
        return nullptr;
    }

    /// Where two railings are in one place they would be drawn through each other: that of the floor is
    /// within that of the link.
    void thinRailingsBesideLinks() {
        constexpr double kShare = 0.6;
        for (const std::size_t wall : beside_links_)
            result_->walls[wall].thickness *= kShare;
    }

    const Layout& layout_;
    Diagnostics& diagnostics_;
    std::shared_ptr<Charts> result_ = std::make_shared<Charts>();
    std::vector<StandingWall> standing_;
    std::vector<std::size_t> beside_links_;  // of the walls: railings of floors
};

}  // namespace

std::shared_ptr<const Charts> layOut(const Layout& layout, Diagnostics& diagnostics) {
    return LayingOut(layout, diagnostics).run();
}

}  // namespace throng::authoring
