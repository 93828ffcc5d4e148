// SPDX-License-Identifier: Apache-2.0
#include "analysis/measure/measure.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <glm/geometric.hpp>
#include <numbers>

#include "analysis/between_rows.h"
#include "analysis/measure/head_watch.h"
#include "analysis/measure/histogram.h"
#include "analysis/measure/mean.h"
#include "analysis/measure/nearness.h"
#include "analysis/measure/present.h"
#include "analysis/measure/vehicle_watch.h"
#include "analysis/stuck.h"
#include "base/side_by_side.h"
#include "base/storeys.h"
#include "io/storeys.h"
#include "recording/wall_watch.h"
#include "shaders/shared/walking.h"

namespace throng::analysis {
namespace {

constexpr std::size_t kHistory = 4;   // frames, for the jerk
constexpr double kBesideLinks = 0.3;  // m: railings stand less far from a link's width

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Spread spreadOf(const Histogram& histogram) {
    return {histogram.percentile(0.5), histogram.percentile(0.99), histogram.worst()};
}

/// How everybody moves, frame by frame; each observe...() is one family of figures.
class Measurer {
  public:
    Measurer(io::CrowdReader& crowd, const MeasureOptions& options)
        : crowd_(crowd),
          bake_(crowd.bake()),
          options_(options),
          rows_(crowd.people()),
          walls_(watchOf(bake_)),
          dt_(1.0 / bake_.fps),
          stuck_(crowd),
          present_(crowd),
          way_(rows_.size(), 0.0),
          effort_(rows_.size(), 0.0),
          start_(rows_.size()),
          straight_(rows_.size(), 0.0),
          crossings_(bake_.links.size()) {}

    Measurement run() {
        for (std::uint32_t frame = 0; frame < bake_.frames && !rows_.empty(); ++frame) {
            history_.push_front(crowd_.frame(frame));
            if (history_.size() > kHistory) history_.pop_back();
            present_.gather(now());
            observeEnds(frame);
            observeSteps(frame);
            stuck_.look(now());
        }
        account();
        summarise();
        return std::move(result_);
    }

  private:
    const io::CrowdFrame& now() const { return history_[0]; }
    const io::CrowdFrame& before(std::size_t frames) const { return history_[frames]; }
    bool aliveSince(std::size_t row, std::size_t frames) const {
        if (history_.size() <= frames) return false;
        for (std::size_t i = 0; i <= frames; ++i)
            if (!history_[i].isThere(row)) return false;
        return true;
    }
    glm::dvec2 velocity(std::size_t row, std::size_t frames_ago) const {
        return (before(frames_ago).place(row) - before(frames_ago + 1).place(row)) / dt_;
    }

    void observeEnds(std::uint32_t frame) {
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            if (!start_[row] && now().isThere(row)) start_[row] = now().place(row);
            if (start_[row] && frame == rows_[row].arrival_frame)
                straight_[row] = glm::distance(*start_[row], now().place(row));
        }
    }

    void observeSteps(std::uint32_t frame) {
        std::uint64_t across = 0;
        walls_.look((frame - 1.0) * dt_, frame * dt_);
        for (std::size_t i = 0; i < present_.count(); ++i) {
            const std::uint32_t row = present_.row(i);
            const Capsule& body = present_.body(i);
            const double height = present_.heights()[i];
            const bool is_given = present_.isGiven(i);
            walls_.standAt(height);
            double& deepest = is_given ? given_.deepest_wall_penetration : result_.deepest_wall_penetration;
            if (!walls_.isFar(body.middle, present_.reach(i)))
                deepest = std::max(deepest, walls_.penetration(body));
            if (!vehicles_.empty() && !is_given) vehicles_.look(frame, row, body, height);
            if (!heads_.empty()) heads_.look(now(), aliveSince(row, 1) ? &before(1) : nullptr, row);
            if (!aliveSince(row, 1)) continue;
            const glm::dvec2 from = before(1).place(row);
            const glm::dvec2 to = now().place(row);
            const double step = glm::distance(from, to);
            const double speed = step / dt_;
            if (!walls_.isFar(from, step) && walls_.crosses(from, to))
                ++(is_given ? given_.wall_crossings : result_.wall_crossings);
            if (options_.line) across += crossesLine(from, to) ? 1 : 0;
            countOverLinks(from, to, height, frame);
            speed_.add(speed);
            if (hasArrived(row, frame) || is_given) continue;
            way_[row] += step;
            effort_[row] += (2.23 + 1.26 * speed * speed) * dt_;
            observeMotion(row, speed);
        }
        if (across) {
            crossed_ += across;
            first_across_ = std::min(first_across_, frame);
            last_across_ = frame;
        }
    }

    bool hasArrived(std::size_t row, std::uint32_t frame) const { return frame >= rows_[row].arrival_frame; }

    void observeMotion(std::size_t row, double speed) {
        if (speed < gpu::STANDING_SPEED) return;
        ++walked_frames_;
        const glm::dvec2 v = velocity(row, 0);
        if (glm::dot(v, now().facing(row)) < -0.05) ++backward_frames_;
        const glm::dvec2 a = now().facing(row);
        const glm::dvec2 b = before(1).facing(row);
        const double turn = std::abs(std::atan2(b.x * a.y - b.y * a.x, glm::dot(a, b)));
        heading_rate_.add(turn * 180.0 / std::numbers::pi / dt_);
        if (!aliveSince(row, 2)) return;
        const glm::dvec2 acceleration = (v - velocity(row, 1)) / dt_;
        acceleration_.add(glm::length(acceleration));
        if (!aliveSince(row, 3)) return;
        const glm::dvec2 earlier = (velocity(row, 1) - velocity(row, 2)) / dt_;
        jerk_.add(glm::length(acceleration - earlier) / dt_);
    }

    /// Who passes the middle of a link at about its height.
    void countOverLinks(glm::dvec2 from, glm::dvec2 to, double height, std::uint32_t frame) {
        for (std::size_t i = 0; i < bake_.links.size(); ++i) {
            const double middle = 0.5 * storeys_.lengthOf(i);
            const glm::dvec2 was = storeys_.onLink(i, from), is = storeys_.onLink(i, to);
            const bool forward = was.x < middle && is.x >= middle, back = was.x >= middle && is.x < middle;
            if ((!forward && !back) || std::abs(is.y) > 0.5 * bake_.links[i].width + kBesideLinks ||
                !areOnOneGround(storeys_.heightOf(i, middle), height))
                continue;
            Crossings& crossings = crossings_[i];
            (forward ? crossings.forward : crossings.back) += 1;
            crossings.first = std::min(crossings.first, frame);
            crossings.last = frame;
        }
    }

    void summariseLinks() {
        for (std::size_t i = 0; i < bake_.links.size(); ++i) {
            const Crossings& crossings = crossings_[i];
            LinkFlow flow{bake_.links[i].id, bake_.links[i].width, crossings.forward, crossings.back, {}, {}};
            const std::uint64_t all = flow.forward + flow.back;
            if (all > 1 && crossings.last > crossings.first)
                flow.flow = static_cast<double>(all - 1) / ((crossings.last - crossings.first) * dt_);
            if (flow.flow && flow.width > 0.0) flow.specific_flow = *flow.flow / flow.width;
            result_.links.push_back(std::move(flow));
        }
    }

    bool crossesLine(glm::dvec2 from, glm::dvec2 to) const {
        const glm::dvec2 a = options_.line->first - bake_.origin;
        const glm::dvec2 axis = options_.line->second - options_.line->first;
        const auto side = [&](glm::dvec2 p) { return axis.x * (p.y - a.y) - axis.y * (p.x - a.x); };
        const double before_side = side(from), after_side = side(to);
        if ((before_side < 0.0) == (after_side < 0.0)) return false;
        const glm::dvec2 at = from + (to - from) * (before_side / (before_side - after_side));
        const double along = glm::dot(at - a, axis) / glm::dot(axis, axis);
        return along >= 0.0 && along <= 1.0;
    }

    void account() {
        given_.people = static_cast<std::uint32_t>(std::ranges::count_if(rows_, &io::AgentRow::is_given));
        result_.agents = static_cast<std::uint32_t>(rows_.size()) - given_.people;
        result_.duration = bake_.frames * dt_;
        std::vector<double> time_ratios, detours, efforts;
        std::vector<std::uint32_t> arrival_frames;
        std::uint32_t last = 0;
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            const io::AgentRow& agent = rows_[row];
            if (agent.is_given) continue;
            result_.arrived += agent.outcome == wordFor(Fate::arrived) ? 1 : 0;
            result_.walking += agent.outcome == wordFor(Fate::walking) ? 1 : 0;
            result_.refused += agent.outcome == wordFor(Fate::refused) ? 1 : 0;
            if (way_[row] > 1.0) efforts.push_back(effort_[row] / way_[row]);
            result_.stuck += stuck_.isStuck(row) ? 1 : 0;
            result_.seated += hasSeat(now().activity(row)) ? 1 : 0;
            if (agent.outcome != wordFor(Fate::arrived)) continue;
            arrival_frames.push_back(agent.arrival_frame);
            last = std::max(last, agent.arrival_frame);
            // The bake's own shortest way is one to the goal; who was content with less went straight at
            // best.
            const double shortest = std::max(straight_[row], agent.shortest_way);
            if (shortest < 1.0) continue;
            time_ratios.push_back((agent.arrival_frame - agent.spawn_frame) * dt_ /
                                  (shortest / agent.preferred_speed));
            detours.push_back(way_[row] / shortest);
        }
        result_.seconds = result_.arrived == result_.agents ? last * dt_ : result_.duration;
        result_.time_ratio = median(time_ratios);
        result_.detour_ratio = median(detours);
        result_.effort = median(efforts);
        std::sort(arrival_frames.begin(), arrival_frames.end());
        for (std::size_t i = 0; i < arrival_frames.size(); ++i)
            result_.arrivals.emplace_back(arrival_frames[i] * dt_, static_cast<double>(i + 1));
    }

    void summarise() {
        result_.vehicle_clearance = vehicles_.clearance();
        result_.run_over = vehicles_.runOver();
        result_.vehicles = bake_.vehicles.size();
        result_.calls = callsIn(bake_);
        if (given_.people > 0) result_.given = given_;
        result_.heading_rate = spreadOf(heading_rate_);
        if (heads_.hasRates()) result_.head_rate = spreadOf(heads_.rates());
        result_.looks_at = heads_.shares();
        result_.acceleration = spreadOf(acceleration_);
        result_.jerk = spreadOf(jerk_);
        summariseLinks();
        if (walked_frames_ > 0)
            result_.backward_percent =
                100.0 * static_cast<double>(backward_frames_) / static_cast<double>(walked_frames_);
        result_.mean_speed = speed_.value();
        if (options_.line && crossed_ > 1 && last_across_ > first_across_)
            result_.flow = static_cast<double>(crossed_ - 1) / ((last_across_ - first_across_) * dt_);
        else if (options_.line)
            result_.flow = 0.0;
        if (result_.flow)
            result_.specific_flow =
                *result_.flow / glm::distance(options_.line->first, options_.line->second);
    }

    io::CrowdReader& crowd_;
    const io::Bake& bake_;
    const MeasureOptions& options_;
    const std::vector<io::AgentRow>& rows_;
    recording::WallWatch walls_;
    double dt_;
    std::deque<io::CrowdFrame> history_;  // newest first
    StuckWatch stuck_;
    Present present_;
    std::vector<double> way_, effort_;
    std::vector<std::optional<glm::dvec2>> start_;  // where somebody was first seen
    std::vector<double> straight_;                  // m, from there to where it arrived
    Histogram heading_rate_{3600.0, 7200}, acceleration_{100.0, 10000}, jerk_{5000.0, 10000};
    GivenFigures given_;
    Mean speed_;
    std::uint64_t walked_frames_ = 0, backward_frames_ = 0;
    std::uint64_t crossed_ = 0;
    std::uint32_t first_across_ = ~0u, last_across_ = 0;
    struct Crossings {
        std::uint64_t forward = 0, back = 0;
        std::uint32_t first = ~0u, last = 0;
    };
    io::Storeys storeys_{bake_};
    VehicleWatch vehicles_{bake_};
    HeadWatch heads_{crowd_};
    std::vector<Crossings> crossings_;  // of each link
    Measurement result_;
};

void add(const Nearness& near, Measurement& to) {
    to.overlapping_percent = near.overlapping_percent;
    to.worst_overlapping_percent = near.worst_overlapping_percent;
    to.deepest_overlap_percent = near.deepest_overlap_percent;
    if (to.given) {
        to.given->overlapping_percent = near.given_overlapping_percent;
        to.given->deepest_overlap_percent = near.given_deepest_overlap_percent;
    }
    to.lane_order = near.lane_order;
    to.mean_density = near.mean_density;
    to.high_density = near.high_density;
    to.speed_by_density = near.speed_by_density;
    to.overlaps = near.overlaps;
}

}  // namespace

Measurement measureBake(io::CrowdReader& crowd, const MeasureOptions& options) {
    if (crowd.frames() == 0)
        throw InputError(crowd.bake().folder, "has no frames: there is nothing to measure");
    io::CrowdReader second(crowd.bake());
    auto nearness = std::async(kInAThread, [&] { return measureNearness(second); });
    Measurement result = Measurer(crowd, options).run();
    add(nearness.get(), result);
    return result;
}

}  // namespace throng::analysis
