// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/chart.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "authoring/storeys/cabin.h"
#include "authoring/storeys/chart_raster.h"
#include "base/polygon.h"

namespace throng::authoring {
namespace {

Chart floorChart(const Level& level, std::size_t index) {
    Chart chart;
    chart.name = level.id;
    chart.index = index;
    chart.height = level.height;
    chart.floor = level.floor;
    return chart;
}

Chart linkChart(const Layout& layout, std::size_t index) {
    const Link& link = layout.links[index];
    Chart chart;
    chart.name = link.id;
    chart.is_link = true;
    chart.index = index;
    chart.link_from = link.from;
    chart.link_to = link.to;
    chart.link.begin = link.begin;
    chart.link.length = glm::distance(link.begin, link.end);
    chart.link.along = (link.end - link.begin) / chart.link.length;
    chart.link.half_width = halfWidthOf(link);
    chart.link.low = link.heights ? link.heights->x : layout.levels[link.from].height;
    chart.link.high = link.heights ? link.heights->y : layout.levels[link.to].height;
    return chart;
}

/// The cabin of a lift where it stands at one of its levels, from its doors to its back.
Chart cabinChart(const Layout& layout, std::size_t index, std::size_t stop) {
    const Link& link = layout.links[index];
    const Lift& lift = link.lift;
    Chart chart;
    chart.name = link.id;
    chart.is_link = chart.is_cabin = true;
    chart.index = index;
    chart.stop = stop;
    chart.half_door = 0.5 * lift.door_width;
    chart.link_from = lift.levels[stop];
    chart.link_to = kNoLevel;
    const glm::dvec2 outward = outOfCabin(lift, stop);
    chart.link.begin = lift.at + 0.5 * lift.size.y * outward;
    chart.link.along = -outward;
    chart.link.length = lift.size.y;
    chart.link.half_width = 0.5 * lift.size.x;
    chart.link.low = chart.link.high = heightOfStop(layout, lift, stop);
    return chart;
}

/// Floors are open where a lift goes through them.
bool goesThrough(const Lift& lift, const Layout& layout, double height) {
    double low = heightOfStop(layout, lift, 0), high = low;
    for (std::size_t stop = 1; stop < lift.levels.size(); ++stop) {
        low = std::min(low, heightOfStop(layout, lift, stop));
        high = std::max(high, heightOfStop(layout, lift, stop));
    }
    return height > low - kHeadroom && height < high + kHeadroom;
}

/// Which part of a link is nearer to a height than headroom; nothing where none is.
std::optional<std::pair<double, double>> tooNear(const Footprint& link, double height) {
    const double rise = (link.high - link.low) / link.length;
    double from = 0.0, to = link.length;
    if (rise == 0.0) {
        if (std::abs(link.low - height) >= kHeadroom) return std::nullopt;
    } else {
        const double a = (height - kHeadroom - link.low) / rise, b = (height + kHeadroom - link.low) / rise;
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return to - from > 1.0e-6 ? std::optional(std::pair(from, to)) : std::nullopt;
}

/// Floors are open under and over the landings of links that turn, as they are along their flights.
void openForLandings(const Layout& layout, std::vector<Chart>& charts) {
    for (std::size_t level = 0; level < layout.levels.size(); ++level)
        for (std::size_t landing = 0; landing < layout.levels.size(); ++landing) {
            const double apart = std::abs(layout.levels[level].height - layout.levels[landing].height);
            if (layout.levels[landing].is_landing && !layout.levels[level].is_landing && apart < kHeadroom)
                charts[level].openings.push_back(layout.levels[landing].floor);
        }
}

/// @param end that the level is at: 0 where the link begins, 1 where it ends
bool isBeyond(const Footprint& link, int end, glm::dvec2 in_link, glm::dvec2 on_floor) {
    constexpr double kNear = 0.5;  // m: the two points are beside each other
    const double inside = link.alongOf(in_link), outside = link.alongOf(on_floor);
    if (std::abs(link.asideOf(on_floor)) > link.half_width + kNear) return false;
    return end == 0 ? outside <= 0.0 && inside < kNear
                    : outside >= link.length && inside > link.length - kNear;
}

}  // namespace

double Footprint::alongOf(glm::dvec2 point) const {
    return glm::dot(point - begin, along);
}

double Footprint::asideOf(glm::dvec2 point) const {
    return glm::dot(point - begin, glm::dvec2(-along.y, along.x));
}

glm::dvec2 Footprint::at(double forward, double aside) const {
    return begin + forward * along + aside * glm::dvec2(-along.y, along.x);
}

std::vector<glm::dvec2> Footprint::outline(double from, double to) const {
    return {at(from, -half_width), at(to, -half_width), at(to, half_width), at(from, half_width)};
}

bool Chart::contains(glm::dvec2 home) const {
    if (surface) return surface->contains(home);
    if (is_link) {
        constexpr double kHair = 1.0e-9;  // m: no gap is left between it and the floor
        const double forward = link.alongOf(home);
        return forward >= -kHair && forward <= link.length + kHair &&
               std::abs(link.asideOf(home)) <= link.half_width;
    }
    return isWithin(floor, home) &&
           std::none_of(openings.begin(), openings.end(),
                        [&](const std::vector<glm::dvec2>& opening) { return isWithin(opening, home); });
}

double Chart::heightAt(glm::dvec2 home) const {
    if (surface) return surface->heightAt(home);
    return is_link ? link.heightAt(std::clamp(link.alongOf(home), 0.0, link.length)) : height;
}

std::pair<glm::dvec2, glm::dvec2> Chart::bounds() const {
    if (surface)
        return {kChartCell * glm::dvec2(surface->first),
                kChartCell * glm::dvec2(surface->first + surface->size)};
    const std::vector<glm::dvec2>& corners = is_link ? link.outline(0.0, link.length) : floor;
    glm::dvec2 lower = corners.front(), upper = corners.front();
    for (const glm::dvec2 corner : corners) {
        lower = glm::min(lower, corner);
        upper = glm::max(upper, corner);
    }
    return {lower, upper};
}

bool areJoined(const Chart& a, std::size_t a_index, glm::dvec2 in_a, const Chart& b, std::size_t b_index,
               glm::dvec2 in_b) {
    if (a.surface && b.surface) return areJoined(*a.surface, in_a, *b.surface, in_b);
    if (a.is_link && b.is_link) return false;
    if (b.is_link) return areJoined(b, b_index, in_b, a, a_index, in_a);
    if (!a.is_link) return std::abs(a.height - b.height) <= kMostStep;
    if (a.is_cabin && std::max(std::abs(a.link.asideOf(in_a)), std::abs(a.link.asideOf(in_b))) > a.half_door)
        return false;
    return (a.link_from == b_index && isBeyond(a.link, 0, in_a, in_b)) ||
           (a.link_to == b_index && isBeyond(a.link, 1, in_a, in_b));
}

std::size_t linkOfLanding(const Chart& landing, const Layout& layout) {
    const auto leads = [&](const Link& link) { return !link.isLift() && link.to == landing.index; };
    return static_cast<std::size_t>(std::ranges::find_if(layout.links, leads) - layout.links.begin());
}

std::vector<Chart> chartsOf(const Layout& layout) {
    std::vector<Chart> charts;
    for (std::size_t i = 0; i < layout.levels.size(); ++i)
        charts.push_back(floorChart(layout.levels[i], i));
    for (std::size_t i = 0; i < layout.links.size(); ++i)
        if (layout.links[i].isLift())
            for (std::size_t stop = 0; stop < layout.links[i].lift.levels.size(); ++stop)
                charts.push_back(cabinChart(layout, i, stop));
        else
            charts.push_back(linkChart(layout, i));
    for (std::size_t level = 0; level < layout.levels.size(); ++level)
        for (std::size_t i = layout.levels.size(); i < charts.size(); ++i)
            if (charts[i].is_cabin) {
                if (charts[i].stop == 0 &&
                    goesThrough(layout.links[charts[i].index].lift, layout, charts[level].height))
                    charts[level].openings.push_back(charts[i].link.outline(0.0, charts[i].link.length));
            } else if (const auto part = tooNear(charts[i].link, charts[level].height))
                charts[level].openings.push_back(charts[i].link.outline(part->first, part->second));
    openForLandings(layout, charts);
    return charts;
}

}  // namespace throng::authoring
