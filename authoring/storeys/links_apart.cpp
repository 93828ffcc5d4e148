// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/links_apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "authoring/layout/polygon_check.h"
#include "authoring/storeys/cabin.h"

namespace throng::authoring {
namespace {

using Polygon = std::vector<glm::dvec2>;

/// What of a convex polygon lies left of a line.
Polygon leftPart(const Polygon& polygon, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 along = to - from;
    const auto left = [&](glm::dvec2 at) { return along.x * (at.y - from.y) - along.y * (at.x - from.x); };
    Polygon part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double at_a = left(a), at_b = left(b);
        if (at_a >= 0.0) part.push_back(a);
        if ((at_a < 0.0) != (at_b < 0.0)) part.push_back(glm::mix(a, b, at_a / (at_a - at_b)));
    }
    return part;
}

/// On a terrain, charts that are no links are its grounds.
bool isLanding(const Chart& chart, const Layout& layout) {
    return !chart.surface && layout.levels[chart.index].is_landing;
}

/// Where people walk on a flight or a landing, or what a cabin is moved through.
class Space {
  public:
    Space(const Chart& chart, const Layout& layout)
        : chart_(chart), link_(layout.links[chart.is_link ? chart.index : linkOfLanding(chart, layout)]) {
        if (!chart.is_link) heights_ = {layout.levels[chart.index].height, layout.levels[chart.index].height};
        for (std::size_t stop = 0; chart.is_cabin && stop < link_.lift.levels.size(); ++stop) {
            const double height = heightOfStop(layout, link_.lift, stop);
            const auto [low, high] = heights_.value_or(std::pair(height, height));
            heights_ = {std::min(low, height), std::max(high, height)};
        }
    }

    /// Counter-clockwise.
    Polygon outline() const {
        if (isLanding()) return chart_.floor;
        constexpr double kTouch = 0.05;  // m, by which railings may be in each other
        Footprint walked = chart_.link;
        walked.half_width -= kTouch;
        return walked.outline(kTouch, walked.length - kTouch);
    }
    /// m: lowest and highest at a place.
    std::pair<double, double> heightsAt(glm::dvec2 at) const {
        if (heights_) return *heights_;
        const double height = chart_.link.heightAt(chart_.link.alongOf(at));
        return {height, height};
    }
    bool isLanding() const { return !chart_.is_link; }
    /// One leads on to the other, which is looked at where links are read, or both are floors.
    bool needsNoLook(const Space& other) const {
        const bool same_link =
            link_.where.line == other.link_.where.line && link_.where.column == other.link_.where.column;
        const std::size_t apart = chart_.index > other.chart_.index ? chart_.index - other.chart_.index
                                                                    : other.chart_.index - chart_.index;
        if (isLanding() || other.isLanding()) return same_link || isLanding() == other.isLanding();
        return same_link && apart <= 1;
    }
    const Link& link() const { return link_; }

  private:
    const Chart& chart_;
    const Link& link_;
    std::optional<std::pair<double, double>> heights_;  // m, where they are the same all over it
};

struct Meeting {
    glm::dvec2 at{0.0};
    double apart = 0.0;  ///< m, 0 where one goes through the other
};

/// The least room between two where one is over the other, if that is too little.
std::optional<Meeting> meetingOf(const Space& a, const Space& b) {
    Polygon common = a.outline();
    const Polygon other = b.outline();
    for (std::size_t i = 0; i < other.size() && common.size() > 2; ++i)
        common = leftPart(common, other[i], other[(i + 1) % other.size()]);
    constexpr double kLeast = 1.0e-6;  // m^2, and m: less is rounding
    if (common.size() < 3 || signedArea(common) < kLeast) return std::nullopt;
    double a_over_b = std::numeric_limits<double>::infinity(), b_over_a = a_over_b;
    Meeting meeting;
    for (const glm::dvec2 at : common) {
        const auto [a_low, a_high] = a.heightsAt(at);
        const auto [b_low, b_high] = b.heightsAt(at);
        a_over_b = std::min(a_over_b, a_low - b_high);
        b_over_a = std::min(b_over_a, b_low - a_high);
        meeting.at += at / static_cast<double>(common.size());
    }
    meeting.apart = std::max({a_over_b, b_over_a, 0.0});
    return meeting.apart < kHeadroom - kLeast ? std::optional(meeting) : std::nullopt;
}

void tellOf(const Meeting& meeting, const Link& first, const Link& second, Diagnostics& diagnostics) {
    const std::string how = meeting.apart > 0.0
                                ? fmt::format("are only {:.2f} m over each other", meeting.apart)
                                : std::string("go through each other");
    const glm::dvec2 at = glm::round(100.0 * meeting.at) / 100.0 + 0.0;  // no -0.00
    diagnostics.error(
        second.where,
        fmt::format("links `{}` and `{}` {} at [{:.2f}, {:.2f}]", first.id, second.id, how, at.x, at.y),
        fmt::format("move one of them: people need {} m over their heads", kHeadroom));
}

}  // namespace

void checkLinksApart(const std::vector<Chart>& charts, const Layout& layout, Diagnostics& diagnostics) {
    std::vector<Space> spaces;
    for (const Chart& chart : charts)
        if (chart.is_link ? chart.stop == 0 : isLanding(chart, layout)) spaces.emplace_back(chart, layout);
    for (std::size_t i = 0; i < spaces.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            if (spaces[i].needsNoLook(spaces[j])) continue;
            if (const auto meeting = meetingOf(spaces[i], spaces[j]))
                tellOf(*meeting, spaces[j].link(), spaces[i].link(), diagnostics);
        }
}

}  // namespace throng::authoring
