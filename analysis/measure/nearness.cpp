// SPDX-License-Identifier: Apache-2.0
#include "analysis/measure/nearness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <utility>

#include "analysis/measure/histogram.h"
#include "analysis/measure/mean.h"
#include "analysis/measure/present.h"
#include "analysis/measure/voronoi_density.h"
#include "base/plane_grid.h"
#include "base/storeys.h"
#include "shaders/shared/walking.h"

namespace throng::analysis {
namespace {

constexpr double kOverlap = 0.01;  // share of the sum of radii from which a pair counts

/// Goes through a bake frame by frame; each observe...() is one family of figures.
class NearnessMeter {
  public:
    explicit NearnessMeter(io::CrowdReader& crowd)
        : crowd_(crowd),
          dt_(1.0 / crowd.bake().fps),
          present_(crowd),
          grid_(crowd.bake().minimum, crowd.bake().maximum, 1.0, cellsFor(crowd.people().size())) {
        for (const io::AgentRow& row : crowd.people())
            largest_radius_ = std::max(largest_radius_, crowd.mostSize() * row.reach());
    }

    Nearness run() {
        const auto second = static_cast<std::uint32_t>(std::max(1.0, std::round(crowd_.bake().fps)));
        for (std::uint32_t frame = 0; frame < crowd_.frames() && crowd_.rows() > 0; ++frame) {
            const io::CrowdFrame now = crowd_.frame(frame);
            present_.gather(now);
            grid_.sort(present_.places());
            observeOverlaps(frame);
            if (frame % second == 0) {
                gatherVelocities(now);
                observeLanes(now);
                observeDensity();
            }
            before_ = now;
        }
        return summary();
    }

  private:
    void observeOverlaps(std::uint32_t frame) {
        std::uint64_t pairs = 0, given_pairs = 0;
        std::size_t given = 0;
        for (std::uint32_t i = 0; i < present_.count(); ++i) {
            given += present_.isGiven(i) ? 1 : 0;
            grid_.near(present_.places()[i], present_.reach(i) + largest_radius_, [&](std::uint32_t j) {
                if (j <= i || !canTouch(i, j)) return;
                const double depth = overlapOf(present_.body(i), present_.body(j));
                const bool theirs = present_.isGiven(i) || present_.isGiven(j);
                double& deepest =
                    theirs ? result_.given_deepest_overlap_percent : result_.deepest_overlap_percent;
                deepest = std::max(deepest, 100.0 * depth);
                (theirs ? given_pairs : pairs) += depth > kOverlap ? 1 : 0;
            });
        }
        result_.overlaps.emplace_back(frame * dt_, static_cast<double>(pairs));
        const auto percent = [](std::uint64_t count, std::size_t people) {
            return 100.0 * static_cast<double>(count) / static_cast<double>(people);
        };
        if (given > 0) given_overlapping_.add(percent(given_pairs, given));
        const std::size_t others = present_.count() - given;
        if (others == 0) return;
        overlapping_.add(percent(pairs, others));
        result_.worst_overlapping_percent =
            std::max(result_.worst_overlapping_percent, percent(pairs, others));
    }

    bool canTouch(std::size_t i, std::size_t j) const {
        const glm::dvec2 offset = present_.places()[j] - present_.places()[i];
        const double reach = present_.reach(i) + present_.reach(j);
        return glm::dot(offset, offset) < reach * reach && areOnOneGround(i, j);
    }
    bool areOnOneGround(std::size_t i, std::size_t j) const {
        return throng::areOnOneGround(present_.heights()[i], present_.heights()[j]);
    }

    /// Of those present who were there in the frame before, too.
    void gatherVelocities(const io::CrowdFrame& now) {
        velocities_.assign(present_.count(), std::nullopt);
        for (std::size_t i = 0; before_ && i < present_.count(); ++i)
            if (const std::uint32_t row = present_.row(i); before_->isThere(row))
                velocities_[i] = (now.place(row) - before_->place(row)) / dt_;
    }

    /// Rex and Loewen 2007, equation (4): for each walker the square of (same - opposite) / (same + opposite)
    /// over those in its lane, here half a metre to both sides and ten metres along its own direction.
    void observeLanes(const io::CrowdFrame& now) {
        constexpr double kHalfLane = 0.5, kAlong = 10.0;
        Mean order;
        for (std::uint32_t i = 0; i < present_.count(); ++i) {
            if (!velocities_[i] || glm::length(*velocities_[i]) < gpu::STANDING_SPEED) continue;
            const glm::dvec2 at = present_.places()[i], way = now.facing(present_.row(i)), end = kAlong * way;
            int same = 0, opposite = 0;
            grid_.nearSegment(at - end, at + end, kHalfLane, [&](std::uint32_t j) {
                const glm::dvec2 offset = present_.places()[j] - at;
                if (j == i || std::abs(way.x * offset.y - way.y * offset.x) > kHalfLane ||
                    std::abs(glm::dot(way, offset)) > kAlong || !areOnOneGround(i, j))
                    return;
                const double agreement = glm::dot(way, now.facing(present_.row(j)));
                same += agreement > 0.5 ? 1 : 0;
                opposite += agreement < -0.5 ? 1 : 0;
            });
            if (same + opposite == 0) continue;
            const double pure = static_cast<double>(same - opposite) / (same + opposite);
            order.add(pure * pure);
        }
        if (order.count() > 0) lane_order_.add(order.value());
    }

    void observeDensity() {
        for (std::uint32_t i = 0; i < present_.count(); ++i) {
            const double density = voronoiDensity(grid_, present_.places(), i, present_.heights());
            density_.add(density);
            mean_density_.add(density);
            if (velocities_[i])
                speeds_[static_cast<int>(density / kDensityStep)].add(glm::length(*velocities_[i]));
        }
    }

    Nearness summary() {
        constexpr std::uint64_t kEnough = 20;
        result_.overlapping_percent = overlapping_.value();
        result_.given_overlapping_percent = given_overlapping_.value();
        result_.lane_order = lane_order_.value();
        result_.mean_density = mean_density_.value();
        result_.high_density = density_.percentile(0.99);
        for (const auto& [bin, speed] : speeds_)
            if (speed.count() >= kEnough)
                result_.speed_by_density.emplace_back((bin + 0.5) * kDensityStep, speed.value());
        return std::move(result_);
    }

    static constexpr double kDensityStep = 0.25;  // persons/m^2

    io::CrowdReader& crowd_;
    double dt_;
    Present present_;
    PlaneGrid grid_;
    double largest_radius_ = 0.0;
    std::optional<io::CrowdFrame> before_;
    std::vector<std::optional<glm::dvec2>> velocities_;  // m/s
    Mean overlapping_, given_overlapping_, lane_order_, mean_density_;
    Histogram density_{20.0, 2000};
    std::map<int, Mean> speeds_;  // m/s, by steps of density
    Nearness result_;
};

}  // namespace

Nearness measureNearness(io::CrowdReader& crowd) {
    return NearnessMeter(crowd).run();
}

}  // namespace throng::analysis
