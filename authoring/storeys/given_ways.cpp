// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/given_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "base/polygon.h"

namespace throng::authoring {
namespace {

constexpr double kLook = 0.1;         // m, along a way
constexpr double kMostLooks = 1.0e5;  // between two points
constexpr double kMostLeap = 0.5;     // m, up or down at a seam: more is through a railing

bool isWithinOutline(const Chart& floor, glm::dvec2 place) {
    constexpr double kHair = 1.0e-3;  // m: on the floor's edge is on the floor
    return distanceToPolygon(floor.floor, place) <= kHair;
}

/// Of a terrain, ground is known in cells: beside the last one is still on it.
bool isOn(const Chart& chart, glm::dvec2 place) {
    if (chart.contains(place) || chart.surface) return true;
    return !chart.is_link && !isWithin(chart.floor, place) && isWithinOutline(chart, place);
}

/// Whether a place that is not on a chart's own cell is on ground that goes on from it, up to a cell away.
bool isBesideGround(const Charts& charts, std::uint32_t chart, glm::dvec2 place) {
    for (const double y : {-kChartCell, 0.0, kChartCell})
        for (const double x : {-kChartCell, 0.0, kChartCell}) {
            const std::uint32_t owner = charts.rasters[chart].ownerOf(place + glm::dvec2(x, y));
            if (owner != gpu::NO_CHART && !charts.charts[owner].is_cabin && isOn(charts.charts[owner], place))
                return true;
        }
    return false;
}

std::optional<std::uint32_t> chartAt(const Charts& charts, std::uint32_t chart, glm::dvec2 place) {
    const std::uint32_t owner = charts.rasters[chart].ownerOf(place);
    const std::uint32_t there = owner == gpu::NO_CHART ? chart : owner;
    if (charts.charts[there].is_cabin) return std::nullopt;
    if (owner != gpu::NO_CHART && charts.charts[there].contains(place)) return there;
    return isBesideGround(charts, chart, place) ? std::optional(there) : std::nullopt;
}

/// Where a way leaves the ground, and from which chart.
struct Lost {
    double time = 0.0;
    glm::dvec2 place{0.0};
    std::uint32_t chart = 0;
    bool is_height = false;  ///< it is on ground, but not on that which it tells
    double height = 0.0;     ///< m: what it tells
};

Lost lostAt(const GivenPoint& at, std::uint32_t chart, bool is_height = false) {
    return {at.time, at.place, chart, is_height, at.height ? *at.height : 0.0};
}

/// Beside the end of a link its chart shows the floor, which is below its sides.
bool leaps(const Charts& charts, std::uint32_t from, glm::dvec2 before, std::uint32_t to, glm::dvec2 place) {
    return from != to &&
           std::abs(charts.charts[from].heightAt(before) - charts.charts[to].heightAt(place)) > kMostLeap;
}

/// Goes along a piece of a way. @returns where it leaves the ground
std::optional<Lost> walk(const Charts& charts, std::uint32_t& chart, const GivenPoint& a,
                         const GivenPoint& b) {
    const double apart = glm::distance(a.place, b.place);
    const int looks = static_cast<int>(std::clamp(std::ceil(apart / kLook), 1.0, kMostLooks));
    glm::dvec2 before = a.place;
    for (int look = 1; look <= looks; ++look) {
        const double share = static_cast<double>(look) / looks;
        const GivenPoint at{glm::mix(a.time, b.time, share), glm::mix(a.place, b.place, share), {}};
        const std::optional<std::uint32_t> there = chartAt(charts, chart, at.place);
        if (!there || leaps(charts, chart, before, *there, at.place)) return lostAt(at, chart);
        chart = *there;
        before = at.place;
    }
    return std::nullopt;
}

bool tellsAnother(const Charts& charts, std::uint32_t chart, const GivenPoint& point) {
    return point.height && std::abs(charts.charts[chart].heightAt(point.place) - *point.height) > kNearGround;
}

std::string groundName(const Charts& charts, std::uint32_t chart) {
    const bool is_level = !charts.charts[chart].is_link;
    return fmt::format("{} `{}`", is_level ? "level" : "link", charts.charts[chart].name);
}

std::string whereLost(const Charts& charts, const Lost& lost) {
    const Chart& chart = charts.charts[lost.chart];
    if (lost.is_height)
        return fmt::format("tells a height of {:.6g} m where its ground, {}, is at {:.6g} m,", lost.height,
                           groundName(charts, lost.chart), chart.heightAt(lost.place));
    if (!chart.surface && !chart.is_link && isWithinOutline(chart, lost.place))
        return fmt::format("is where stairs or lifts leave no room on {}", groundName(charts, lost.chart));
    return fmt::format("is beyond the {} {}",
                       chart.surface   ? "ground of"
                       : chart.is_link ? "sides of"
                                       : "floor of",
                       groundName(charts, lost.chart));
}

std::string hintFor(const Charts& charts, const Lost& lost) {
    if (lost.is_height)
        return fmt::format(
            "heights are those of the ground, within {:g} m; the first one says on which ground a "
            "way begins",
            kNearGround);
    const Chart& chart = charts.charts[lost.chart];
    if (!chart.surface && !chart.is_link && isWithinOutline(chart, lost.place))
        return "ways lead over stairs, escalators and ramps from one end to the other, and into no lift: end "
               "it "
               "before that place";
    return "ways go on where people can walk on: name the `level` on which it begins, or heights, set their "
           "`offset`, or end it at the edge";
}

class Following {
  public:
    Following(const GivenPeople& given, const Charts& charts) : given_(given), charts_(charts) {}

    /// The charts of its points; what has left the ground goes on where it was.
    std::vector<std::uint32_t> follow(const std::vector<GivenPoint>& way, std::uint32_t chart) {
        std::vector<std::uint32_t> found = {chart};
        std::optional<Lost> lost;
        if (tellsAnother(charts_, chart, way.front())) lost = lostAt(way.front(), chart, true);
        for (std::size_t i = 1; i < way.size(); ++i) {
            if (!lost) lost = walk(charts_, chart, way[i - 1], way[i]);
            if (!lost && tellsAnother(charts_, chart, way[i])) lost = lostAt(way[i], chart, true);
            found.push_back(chart);
        }
        if (lost) count(*lost);
        ++person_;
        return found;
    }

    /// A way that begins nowhere.
    void skip(const GivenPoint& at, std::uint32_t chart, bool is_height) {
        count(lostAt(at, chart, is_height));
        ++person_;
    }

    void tell(Diagnostics& diagnostics) const {
        if (count_ == 0) return;
        const std::string others =
            count_ > 1 ? fmt::format(", and {} more of them likewise", count_ - 1) : std::string();
        diagnostics.error(given_.file.empty() ? given_.where : given_.file_where,
                          fmt::format("given `{}`: person {} {} at [{:.6g}, {:.6g}], at {:.6g} s{}",
                                      given_.id, first_person_, whereLost(charts_, first_), first_.place.x,
                                      first_.place.y, first_.time, others),
                          hintFor(charts_, first_));
    }

  private:
    void count(const Lost& lost) {
        if (count_++ > 0) return;
        first_ = lost;
        first_person_ = person_;
    }

    const GivenPeople& given_;
    const Charts& charts_;
    Lost first_;  ///< where any is
    std::size_t person_ = 0, first_person_ = 0, count_ = 0;
};

}  // namespace

std::optional<std::uint32_t> chartAfter(const Charts& charts, std::uint32_t chart, glm::dvec2 from,
                                        glm::dvec2 to) {
    if (walk(charts, chart, {0.0, from, {}}, {0.0, to, {}})) return std::nullopt;
    return chart;
}

std::optional<std::uint32_t> chartAtHeight(const Charts& charts, glm::dvec2 place, double height) {
    std::optional<std::uint32_t> nearest;
    double least = kNearGround;
    for (std::uint32_t chart = 0; chart < charts.charts.size(); ++chart) {
        const Chart& ground = charts.charts[chart];
        if (ground.is_cabin || !ground.contains(place)) continue;
        const double away = std::abs(ground.heightAt(place) - height);
        if (away > least) continue;
        least = away;
        nearest = chart;
    }
    return nearest;
}

GivenCharts chartsOfWays(
    const Layout& layout, const Charts& charts,
    const std::function<std::optional<std::uint32_t>(const GivenPeople&, glm::dvec2)>& begins,
    Diagnostics& diagnostics) {
    GivenCharts found;
    for (const GivenPeople& given : layout.given) {
        Following following(given, charts);
        std::vector<std::vector<std::uint32_t>>& ways = found.emplace_back();
        for (const std::vector<GivenPoint>& way : given.ways) {
            const GivenPoint& first = way.front();
            const std::optional<std::uint32_t> named = begins(given, first.place);
            const std::optional<std::uint32_t> begin =
                first.height ? chartAtHeight(charts, first.place, *first.height) : named;
            const std::optional<std::uint32_t> on =
                begin ? chartAt(charts, *begin, first.place) : std::optional<std::uint32_t>();
            if (on)
                ways.push_back(following.follow(way, *on));
            else {
                const std::uint32_t beside = begin.value_or(named.value_or(0));
                // There is ground, but not at the height that is told.
                const bool is_height = first.height && !begin && chartAt(charts, beside, first.place);
                following.skip(first, beside, is_height);
                ways.emplace_back(way.size(), beside);
            }
        }
        following.tell(diagnostics);
    }
    return found;
}

}  // namespace throng::authoring
