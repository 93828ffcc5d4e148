// SPDX-License-Identifier: Apache-2.0
#include "analysis/follow/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

#include "analysis/plot/canvas.h"

namespace throng::analysis {
namespace {

constexpr int kWidth = 1600, kHeight = 900;  // px
constexpr double kDots = 1.6;                // px
constexpr double kTau = 6.283185307179586;
constexpr std::size_t kMostBars = 150;
constexpr double kShortestBar = 0.25;  // s: less is noise of single steps
constexpr std::size_t kNamedRules = 7;
constexpr Colour kGrey = colourFromHex(0x9a9a9a), kInk = colourFromHex(0x303030),
                 kGrid = colourFromHex(0xe6e6e6), kWall = colourFromHex(0x505050),
                 kOthers = colourFromHex(0xd5d9df), kBack = colourFromHex(0xc4002f),
                 kStands = colourFromHex(0xe69f00), kWay = colourFromHex(0x1f5fa8);

/// Where something is drawn, px.
struct Frame {
    double left, top, right, bottom;
};
constexpr Frame kPlan = {60, 90, 700, 730}, kSpeed = {800, 90, 1570, 340}, kRules = {800, 420, 1570, 760};

/// What each rule added along the wish, in equal pieces of time.
struct Bars {
    double from = 0.0, width = 0.0;                    // s
    std::map<std::string, std::vector<double>> rules;  // m/s^2
    std::vector<std::string> named;                    // those that did most, the most first
};

Bars barsOf(const FollowPlot& plot) {
    Bars bars;
    bars.from = plot.account.from;
    const double span = std::max(plot.account.to - plot.account.from, plot.step_seconds);
    bars.width = std::max(span / static_cast<double>(kMostBars), kShortestBar);
    const auto count = static_cast<std::size_t>(std::ceil(span / bars.width));
    std::map<std::string, double> sizes;
    for (const FollowedStep& step : plot.steps) {
        const double at = (step.time - plot.step_seconds - bars.from) / bars.width;
        const std::size_t bar = std::min(static_cast<std::size_t>(std::max(at, 0.0)), count - 1);
        for (const Influence& each : step.influences) {
            if (each.changed != Changed::velocity) continue;
            std::vector<double>& values = bars.rules.try_emplace(each.rule, count, 0.0).first->second;
            values[bar] +=
                glm::dot(glm::dvec2(each.after) - glm::dvec2(each.before), wayOf(step)) / bars.width;
        }
    }
    for (const auto& [rule, values] : bars.rules) {
        for (const double value : values)
            sizes[rule] += std::abs(value);
        bars.named.push_back(rule);
    }
    std::ranges::stable_sort(bars.named, std::greater(),
                             [&](const std::string& rule) { return sizes[rule]; });
    return bars;
}

class Drawing {
  public:
    explicit Drawing(const FollowPlot& plot)
        : plot_(plot), canvas_(kWidth, kHeight), time_(plot.account.from, plot.account.to) {}

    const Canvas& draw() {
        canvas_.use(kInk);
        canvas_.text(kPlan.left, 34, 20, plot_.title, 0.0, true);
        canvas_.text(kPlan.left, 62, 14, caption());
        drawPlan();
        drawSpeed();
        drawRules(barsOf(plot_));
        return canvas_;
    }

  private:
    std::string caption() const {
        const FollowAccount& a = plot_.account;
        return fmt::format(
            "{:.1f} m in {:.1f} s; stood {:.1f} s, walked backward {:.1f} s, was astray {:.1f} s", a.walked,
            a.to - a.from, a.standing, a.backward, a.astray);
    }
    cairo_t* pen() const { return canvas_.get(); }

    void line(glm::dvec2 a, glm::dvec2 b, double width) const {
        cairo_set_line_width(pen(), width);
        cairo_move_to(pen(), a.x, a.y);
        cairo_line_to(pen(), b.x, b.y);
        cairo_stroke(pen());
    }
    void circle(glm::dvec2 at, double radius, bool filled) const {
        cairo_new_path(pen());
        cairo_arc(pen(), at.x, at.y, radius, 0.0, kTau);
        cairo_set_line_width(pen(), 1.2);
        filled ? cairo_fill(pen()) : cairo_stroke(pen());
    }
    void clipTo(const Frame& frame) const {
        cairo_save(pen());
        cairo_rectangle(pen(), frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top);
        cairo_clip(pen());
    }

    // The plan.

    glm::dvec2 inWorld(glm::dvec2 place) const { return plot_.origin + place; }
    glm::dvec2 inPlan(glm::dvec2 world) const {
        const glm::dvec2 middle(0.5 * (kPlan.left + kPlan.right), 0.5 * (kPlan.top + kPlan.bottom));
        const glm::dvec2 offset = (world - middle_) * scale_;
        return {middle.x + offset.x, middle.y - offset.y};
    }

    void drawPlan() {
        constexpr double kMargin = 1.5, kLeast = 5.0;  // m
        glm::dvec2 low = inWorld(plot_.steps.front().place), high = low;
        for (const FollowedStep& step : plot_.steps) {
            low = glm::min(low, inWorld(step.place));
            high = glm::max(high, inWorld(step.place));
        }
        middle_ = 0.5 * (low + high);
        scale_ = (kPlan.right - kPlan.left) /
                 std::max({high.x - low.x + 2.0 * kMargin, high.y - low.y + 2.0 * kMargin, kLeast});
        clipTo(kPlan);
        for (const authoring::Wall& wall : plot_.walls)
            drawWall(wall);
        drawMoment();
        drawWay();
        cairo_restore(pen());
        canvas_.use(kInk);
        cairo_set_line_width(pen(), 1.0);
        cairo_rectangle(pen(), kPlan.left, kPlan.top, kPlan.right - kPlan.left, kPlan.bottom - kPlan.top);
        cairo_stroke(pen());
        drawScaleBar();
    }

    void drawWall(const authoring::Wall& wall) const {
        if (wall.points.empty()) return;
        cairo_new_path(pen());
        for (const glm::dvec2 point : wall.points) {
            const glm::dvec2 at = inPlan(point);
            cairo_line_to(pen(), at.x, at.y);
        }
        const bool open = wall.isOpen(plot_.account.from);
        canvas_.use(open ? kOthers : kWall);
        if (wall.closed) {
            cairo_close_path(pen());
            cairo_fill(pen());
            return;
        }
        cairo_set_line_cap(pen(), CAIRO_LINE_CAP_ROUND);
        cairo_set_line_width(pen(), std::max(wall.thickness * scale_, 1.0));
        cairo_stroke(pen());
    }

    /// Those whom it sensed when it fared worst: as it came to stand, or began to walk backward.
    const FollowedStep* moment() const {
        const std::optional<Spell>& worst = plot_.account.longest_standstill
                                                ? plot_.account.longest_standstill
                                                : plot_.account.longest_backward;
        if (!worst) return nullptr;
        const auto found = std::ranges::find_if(
            plot_.steps, [&](const FollowedStep& step) { return step.time > worst->from; });
        return found == plot_.steps.end() ? nullptr : &*found;
    }

    void body(const Capsule& shape) const {
        const glm::dvec2 at = inPlan(inWorld(shape.middle)),
                         half(shape.axis.x * scale_, -shape.axis.y * scale_);
        const double across = std::atan2(half.y, half.x), radius = shape.thickness * scale_;
        cairo_new_path(pen());
        cairo_arc(pen(), at.x + half.x, at.y + half.y, radius, across - 0.25 * kTau, across + 0.25 * kTau);
        cairo_arc(pen(), at.x - half.x, at.y - half.y, radius, across + 0.25 * kTau, across + 0.75 * kTau);
        cairo_close_path(pen());
        cairo_set_line_width(pen(), 1.2);
        cairo_stroke(pen());
    }

    void drawMoment() const {
        const FollowedStep* step = moment();
        if (!step) return;
        canvas_.use(kGrey);
        for (const SensedPerson& other : step->sensed) {
            const glm::dvec2 at = inPlan(inWorld(other.place));
            body(bodyOf(other));
            const double radius = other.radius * scale_;
            canvas_.text(at.x + radius + 3, at.y + 4, 11, fmt::format("{}", other.row));
        }
        canvas_.use(kInk);
        const glm::dvec2 at = inPlan(inWorld(step->place));
        body(bodyAfter(*step));
        line(at, inPlan(inWorld(step->place) + wayOf(*step) * 0.6), 1.5);
    }

    void drawWay() const {
        for (const FollowedStep& step : plot_.steps) {
            const bool back = isBackward(step);
            const bool slow = glm::length(step.velocity) < 0.1f;
            canvas_.use(back ? kBack : slow ? kStands : kWay);
            circle(inPlan(inWorld(step.place)), back || slow ? 1.5 * kDots : kDots, true);
        }
        canvas_.use(kWay);
        circle(inPlan(inWorld(plot_.steps.front().place_before)), 6.0, false);
        circle(inPlan(inWorld(plot_.steps.back().place)), 5.0, true);
    }

    void drawScaleBar() const {
        const double y = kPlan.bottom + 24;
        line({kPlan.left, y}, {kPlan.left + scale_, y}, 2.0);
        canvas_.text(kPlan.left + scale_ + 8, y + 5, 13, "1 m");
        double x = kPlan.left;
        const std::pair<const char*, Colour> names[] = {
            {"walks", kWay}, {"slower than 0.1 m/s", kStands}, {"backward", kBack}};
        for (const auto& [name, colour] : names) {
            canvas_.use(colour);
            circle({x + 5, y + 26}, 5.0, true);
            canvas_.use(kInk);
            canvas_.text(x + 16, y + 31, 13, name);
            x += 30.0 + 7.5 * static_cast<double>(std::string_view(name).size());
        }
        if (!moment()) return;
        canvas_.text(
            kPlan.left, y + 54, 13,
            fmt::format("outlines: itself and whom it sensed at {:.2f} s, with rows; the stroke is its wish",
                        moment()->time));
    }

    // Over time.

    double acrossOf(double time) const { return kSpeed.left + time_.at(time) * (kSpeed.right - kSpeed.left); }

    void axes(const Frame& frame, const Scale& scale, const std::string& title) const {
        const auto up = [&](double value) {
            return frame.bottom - scale.at(value) * (frame.bottom - frame.top);
        };
        for (const double tick : scale.ticks()) {
            canvas_.use(kGrid);
            line({frame.left, up(tick)}, {frame.right, up(tick)}, 1.0);
            canvas_.use(kInk);
            canvas_.text(frame.left - 8, up(tick) + 5, 12, tickText(tick), 1.0);
        }
        for (const double tick : time_.ticks()) {
            canvas_.use(kInk);
            canvas_.text(acrossOf(tick), frame.bottom + 18, 12, tickText(tick), 0.5);
        }
        canvas_.text(frame.left, frame.top - 10, 14, title);
        line({frame.left, frame.bottom}, {frame.right, frame.bottom}, 1.0);
    }

    void drawSpeed() const {
        std::vector<double> values = {0.0};
        for (const FollowedStep& step : plot_.steps) {
            values.push_back(glm::length(glm::dvec2(step.wish)));
            values.push_back(glm::dot(glm::dvec2(step.velocity), wayOf(step)));
        }
        const Scale scale(values);
        const auto up = [&](double value) {
            return kSpeed.bottom - scale.at(value) * (kSpeed.bottom - kSpeed.top);
        };
        axes(kSpeed, scale,
             "speed, m/s: wished (grey), had along the wish (blue); backward in red; over time, s");
        for (const FollowedStep& step : plot_.steps) {
            const double x = acrossOf(step.time);
            canvas_.use(kGrey);
            circle({x, up(values[1 + 2 * static_cast<std::size_t>(&step - plot_.steps.data())])}, 1.0, true);
            canvas_.use(isBackward(step) ? kBack : kWay);
            circle({x, up(glm::dot(glm::dvec2(step.velocity), wayOf(step)))}, kDots, true);
        }
    }

    Colour colourOf(const Bars& bars, const std::string& rule) const {
        const auto place = static_cast<std::size_t>(std::ranges::find(bars.named, rule) - bars.named.begin());
        return place < kNamedRules ? groupColour(place) : kOthers;
    }

    void drawRules(const Bars& bars) const {
        std::vector<double> ends = {0.0};
        const std::size_t count = bars.rules.empty() ? 0 : bars.rules.begin()->second.size();
        for (std::size_t bar = 0; bar < count; ++bar) {
            double above = 0.0, below = 0.0;
            for (const auto& [rule, values] : bars.rules)
                (values[bar] > 0.0 ? above : below) += values[bar];
            ends.push_back(above);
            ends.push_back(below);
        }
        const Scale scale(ends);
        const auto up = [&](double value) {
            return kRules.bottom - scale.at(value) * (kRules.bottom - kRules.top);
        };
        axes(
            kRules, scale,
            fmt::format("what rules added to its speed along its wish, m/s2, means of {:.2f} s", bars.width));
        for (std::size_t bar = 0; bar < count; ++bar) {
            double above = 0.0, below = 0.0;
            const double from = bars.from + static_cast<double>(bar) * bars.width;
            const double left = acrossOf(from);
            const double right = acrossOf(std::min(from + bars.width, plot_.account.to));
            for (const std::string& rule : bars.named) {
                const double value = bars.rules.at(rule)[bar];
                double& end = value > 0.0 ? above : below;
                canvas_.use(colourOf(bars, rule));
                cairo_rectangle(pen(), left, up(end + value), right - left, up(end) - up(end + value));
                cairo_fill(pen());
                end += value;
            }
        }
        canvas_.use(kInk);
        line({kRules.left, up(0.0)}, {kRules.right, up(0.0)}, 1.0);
        drawNames(bars);
    }

    void drawNames(const Bars& bars) const {
        const std::size_t shown = std::min(bars.named.size(), kNamedRules);
        for (std::size_t i = 0; i < shown + (bars.named.size() > shown ? 1 : 0); ++i) {
            const std::size_t column = i % 3, line = i / 3;
            const double x = kRules.left + 255.0 * static_cast<double>(column);
            const double y = kRules.bottom + 45.0 + 24.0 * static_cast<double>(line);
            canvas_.use(i < shown ? groupColour(i) : kOthers);
            cairo_rectangle(pen(), x, y - 11, 14, 14);
            cairo_fill(pen());
            canvas_.use(kInk);
            canvas_.text(x + 20, y + 1, 13, i < shown ? bars.named[i] : "all others");
        }
    }

    const FollowPlot& plot_;
    Canvas canvas_;
    Scale time_;
    glm::dvec2 middle_{0.0};  // m
    double scale_ = 1.0;      // px per m
};

}  // namespace

void writeFollowPlot(const std::filesystem::path& path, const FollowPlot& plot) {
    Drawing(plot).draw().write(path);
}

}  // namespace throng::analysis
