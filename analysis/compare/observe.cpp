// SPDX-License-Identifier: Apache-2.0
#include "analysis/compare/observe.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "analysis/measure/voronoi_density.h"
#include "base/plane_grid.h"
#include "shaders/shared/walking.h"

namespace throng::analysis {
namespace {

constexpr double kLook = 1.0 / kLooks;  // s
constexpr std::size_t kAcross = 2;      // looks to both sides, for velocities: the sway of a step evens out
constexpr std::size_t kStep = 6;        // looks to both sides: two steps, whose mean is the way without sway
constexpr std::int64_t kBetweenCrowds = 10;  // looks from one look at neighbours to the next
constexpr double kFurthestNeighbour = 5.0;   // m; likewise walls
constexpr double kDensityBin = 0.25;         // persons/m^2
constexpr std::uint64_t kFewest = 20;        // samples of a bin that is told

/// What is seen of one person.
class Watched {
  public:
    explicit Watched(const Track& track) : places_(track.places) {}
    std::size_t looks() const { return places_.size(); }
    glm::dvec2 place(std::size_t i) const { return places_[i]; }
    bool hasVelocity(std::size_t i) const { return i >= kAcross && i + kAcross < places_.size(); }
    glm::dvec2 velocity(std::size_t i) const {
        return (places_[i + kAcross] - places_[i - kAcross]) / (2.0 * kAcross * kLook);
    }
    bool hasAcceleration(std::size_t i) const { return i >= 2 * kAcross && i + 2 * kAcross < places_.size(); }
    glm::dvec2 acceleration(std::size_t i) const {
        return (velocity(i + kAcross) - velocity(i - kAcross)) / (2.0 * kAcross * kLook);
    }
    /// deg/s, of the way that it moves; nothing where it stands.
    std::optional<double> turning(std::size_t i) const {
        const glm::dvec2 a = velocity(i - kAcross), b = velocity(i + kAcross);
        if (std::min(glm::length(a), glm::length(b)) < gpu::STANDING_SPEED) return std::nullopt;
        const double angle = std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
        return std::abs(angle) * 180.0 / std::numbers::pi / (2.0 * kAcross * kLook);
    }
    /// m aside of the mean over two steps; nothing where it stands.
    std::optional<double> sway(std::size_t i) const {
        if (i < kStep || i + kStep >= places_.size()) return std::nullopt;
        const glm::dvec2 way = places_[i + kStep] - places_[i - kStep];
        if (glm::length(way) < 2.0 * kStep * kLook * gpu::STANDING_SPEED) return std::nullopt;
        glm::dvec2 mean(0.0);
        for (std::size_t j = i - kStep; j <= i + kStep; ++j)
            mean += places_[j] / (2.0 * kStep + 1.0);
        const glm::dvec2 off = places_[i] - mean;
        return std::abs(way.x * off.y - way.y * off.x) / glm::length(way);
    }

  private:
    const std::vector<glm::dvec2>& places_;
};

class Observer {
  public:
    Observer(const Trajectories& trajectories, const ObserveOptions& options, recording::WallWatch& walls,
             glm::dvec2 walls_origin)
        : trajectories_(trajectories), options_(options), walls_(walls), walls_origin_(walls_origin) {}

    Observed run() {
        for (const Track& track : trajectories_.tracks) {
            observeMotion(Watched(track));
            if (options_.line) observeCrossings(track);
        }
        observeCrowd();
        summarise();
        return std::move(seen_);
    }

  private:
    void observeMotion(const Watched& person) {
        for (std::size_t i = 0; i < person.looks(); ++i) {
            if (!options_.area.holds(person.place(i))) continue;
            if (person.hasVelocity(i)) seen_.speed.add(glm::length(person.velocity(i)));
            if (person.hasAcceleration(i)) {
                seen_.acceleration.add(glm::length(person.acceleration(i)));
                if (const auto turning = person.turning(i)) seen_.turning.add(*turning);
            }
            if (const auto sway = person.sway(i)) seen_.sway.add(*sway);
        }
    }

    void observeCrossings(const Track& track) {
        const auto [a, b] = *options_.line;
        const glm::dvec2 axis = b - a;
        const auto side = [&](glm::dvec2 p) { return axis.x * (p.y - a.y) - axis.y * (p.x - a.x); };
        for (std::size_t i = 1; i < track.places.size(); ++i) {
            const glm::dvec2 from = track.places[i - 1], to = track.places[i];
            const double before = side(from), after = side(to);
            if ((before < 0.0) == (after < 0.0)) continue;
            const double share = before / (before - after);
            const double along = glm::dot(from + (to - from) * share - a, axis) / glm::dot(axis, axis);
            if (along < 0.0 || along > 1.0) continue;
            crossings_.push_back((static_cast<double>(track.first) + static_cast<double>(i) - 1.0 + share) *
                                 kLook);
        }
    }

    /// Once a second, all who are there at once.
    void observeCrowd() {
        std::map<std::int64_t, std::vector<std::uint32_t>> there;  // indices of tracks, by moment
        for (std::uint32_t t = 0; t < trajectories_.tracks.size(); ++t) {
            const Track& track = trajectories_.tracks[t];
            const auto end = track.first + static_cast<std::int64_t>(track.places.size());
            for (std::int64_t moment = track.first; moment < end; ++moment)
                if (moment % kBetweenCrowds == 0) there[moment].push_back(t);
        }
        const Box2d bounds = boundsOf(trajectories_);
        PlaneGrid grid(bounds.minimum, bounds.maximum, 1.0, cellsFor(trajectories_.people));
        std::vector<glm::dvec2> places;
        for (const auto& [moment, tracks] : there) {
            const auto lookOf = [&, at = moment](const Track& track) {
                return static_cast<std::size_t>(at - track.first);
            };
            places.clear();
            for (const std::uint32_t t : tracks)
                places.push_back(trajectories_.tracks[t].places[lookOf(trajectories_.tracks[t])]);
            grid.sort(places);
            const double seconds = static_cast<double>(moment) * kLook;
            walls_.look(seconds, seconds);
            for (std::uint32_t p = 0; p < places.size(); ++p) {
                const Track& track = trajectories_.tracks[tracks[p]];
                observeAmong(grid, places, p, track, lookOf(track));
            }
        }
    }

    void observeAmong(const PlaneGrid& grid, const std::vector<glm::dvec2>& places, std::uint32_t self,
                      const Track& track, std::size_t look) {
        const glm::dvec2 place = places[self];
        if (!options_.area.holds(place)) return;
        double nearest = kFurthestNeighbour;
        grid.near(place, kFurthestNeighbour, [&](std::uint32_t other) {
            if (other != self) nearest = std::min(nearest, glm::distance(places[other], place));
        });
        if (nearest < kFurthestNeighbour) seen_.neighbour.add(nearest);
        const double in_wall =
            walls_.empty() ? 0.0 : walls_.penetration(place - walls_origin_, kFurthestNeighbour);
        if (in_wall > 0.0) seen_.wall.add(kFurthestNeighbour - in_wall);
        const double density = voronoiDensity(grid, places, self);
        seen_.density.add(density);
        const Watched person(track);
        if (!person.hasVelocity(look)) return;
        auto& [sum, count] = speeds_[static_cast<int>(density / kDensityBin)];
        sum += glm::length(person.velocity(look));
        ++count;
    }

    void summarise() {
        for (const auto& [bin, entry] : speeds_)
            if (entry.second >= kFewest)
                seen_.speed_by_density.emplace_back((bin + 0.5) * kDensityBin,
                                                    entry.first / static_cast<double>(entry.second));
        std::sort(crossings_.begin(), crossings_.end());
        for (std::size_t i = 0; i < crossings_.size(); ++i) {
            seen_.passed.emplace_back(crossings_[i] - crossings_[0], static_cast<double>(i + 1));
            if (i > 0) seen_.time_gap.add(crossings_[i] - crossings_[i - 1]);
        }
        if (crossings_.size() > 1 && crossings_.back() > crossings_.front())
            seen_.flow =
                static_cast<double>(crossings_.size() - 1) / (crossings_.back() - crossings_.front());
    }

    const Trajectories& trajectories_;
    const ObserveOptions& options_;
    recording::WallWatch& walls_;
    glm::dvec2 walls_origin_;
    std::vector<double> crossings_;  // s
    std::map<int, std::pair<double, std::uint64_t>> speeds_;
    Observed seen_;
};

}  // namespace

Box2d boundsOf(const Trajectories& trajectories) {
    Box2d box{trajectories.tracks.front().places.front(), trajectories.tracks.front().places.front()};
    for (const Track& track : trajectories.tracks)
        for (const glm::dvec2 place : track.places)
            box = {glm::min(box.minimum, place), glm::max(box.maximum, place)};
    return box;
}

Observed observe(const Trajectories& trajectories, const ObserveOptions& options, recording::WallWatch& walls,
                 glm::dvec2 walls_origin) {
    return Observer(trajectories, options, walls, walls_origin).run();
}

}  // namespace throng::analysis
