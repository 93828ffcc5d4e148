// SPDX-License-Identifier: Apache-2.0
#include "recording/keep_apart.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/storeys.h"

namespace throng::recording {
namespace {

constexpr double kSlack = 0.004;      // of the sum of radii: overlaps this deep stay
constexpr double kMoved = 1.0e-3;     // m: who moved less is where the simulation had it
constexpr double kMargin = 0.05;      // m: pairs this far apart may be pushed together by others
constexpr double kDeep = 0.005;       // of the sum of radii, beyond kSlack: not to be left
constexpr double kRounding = 1.0e-6;  // m^2: far above rounding
constexpr int kRounds = 8, kAttempts = 3, kHalvings = 12;

/// From the first to the second, where they are nearest to each other: for discs, between their middles.
glm::dvec2 between(const MovedBody& a, const MovedBody& b) {
    return segmentsGap(b.place - a.place, b.axis, a.axis);
}

/// m: how long that is where they touch.
double reachOf(const MovedBody& a, const MovedBody& b) {
    return a.radius - glm::length(a.axis) + b.radius - glm::length(b.axis);
}

}  // namespace

KeepApart::KeepApart(std::vector<authoring::Wall> walls, glm::dvec2 minimum, glm::dvec2 maximum,
                     std::vector<glm::dvec2> ground)
    : walls_(std::move(walls), minimum, maximum, std::move(ground)), grid_(minimum, maximum, 1.0) {}

void KeepApart::settle(std::vector<MovedBody>& bodies, double before, double now) {
    findPairs(bodies);
    if (!walls_.empty()) walls_.look(before, now);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        for (int round = 0; round < kRounds && !pairs_.empty(); ++round)
            separate(bodies);
        clearWalls(bodies);
    }
    for (int halving = 0; halving < kHalvings && takeBack(bodies); ++halving)
        clearWalls(bodies);
}

/// Takes those who are still deep in somebody half of the way back.
/// @returns whether there were any
bool KeepApart::takeBack(std::vector<MovedBody>& bodies) const {
    bool any = false;
    for (const Pair& pair : pairs_) {
        MovedBody& a = bodies[pair.first];
        MovedBody& b = bodies[pair.second];
        if (glm::length(between(a, b)) >= pair.reach * (1.0 - kDeep)) continue;
        any = true;
        for (MovedBody* body : {&a, &b})
            body->place = glm::mix(body->simulated, body->place, 0.5);
    }
    return any;
}

/// Pairs that may overlap and of which one has moved.
void KeepApart::findPairs(const std::vector<MovedBody>& bodies) {
    pairs_.clear();
    places_.clear();
    double largest = 0.0;
    for (const MovedBody& body : bodies) {
        places_.push_back(body.place);
        largest = std::max(largest, body.radius);
    }
    grid_.sort(places_);
    const auto moved = [&](std::uint32_t i) {
        return glm::distance(bodies[i].simulated, bodies[i].place) > kMoved;
    };
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
        if (!moved(i)) continue;
        grid_.near(places_[i], bodies[i].radius + largest + kMargin, [&](std::uint32_t j) {
            // Most of those whom the grid finds are too far away whatever their bodies are.
            const glm::dvec2 apart = places_[j] - places_[i];
            const double most = bodies[i].radius + bodies[j].radius + kMargin;
            if (glm::dot(apart, apart) > most * most + kRounding) return;
            if (j == i || (j < i && moved(j)) || !areOnOneGround(bodies[i].height, bodies[j].height)) return;
            const double reach = reachOf(bodies[i], bodies[j]);
            if (glm::length(between(bodies[i], bodies[j])) < reach + kMargin)
                pairs_.push_back({i, j, reach * (1.0 - kSlack)});
        });
    }
}

void KeepApart::separate(std::vector<MovedBody>& bodies) const {
    for (const Pair& pair : pairs_) {
        MovedBody &a = bodies[pair.first], &b = bodies[pair.second];
        const glm::dvec2 gap = between(bodies[pair.first], bodies[pair.second]);
        const double apart = glm::length(gap);
        if (apart >= pair.reach) continue;
        // Two in the same place go the way they are apart in the simulation.
        const glm::dvec2 way = apart > 1.0e-9
                                   ? gap / apart
                                   : glm::normalize(bodies[pair.second].simulated -
                                                    bodies[pair.first].simulated + glm::dvec2(1.0e-12, 0.0));
        const glm::dvec2 push = 0.5 * (pair.reach - apart) * way;
        if (!a.stays) a.place -= b.stays ? 2.0 * push : push;
        if (!b.stays) b.place += a.stays ? 2.0 * push : push;
    }
}

void KeepApart::clearWalls(std::vector<MovedBody>& bodies) {
    if (walls_.empty()) return;
    for (MovedBody& body : bodies)
        if (glm::distance(body.simulated, body.place) > kMoved) clearWalls(body);
}

/// As near to its average place as walls let it be, on the straight way from where the simulation had it.
void KeepApart::clearWalls(MovedBody& body) {
    if (walls_.isFar(body.simulated, glm::distance(body.simulated, body.place) + body.radius)) return;
    walls_.standAt(body.height);
    constexpr double kTouches = 1.0e-4;  // m
    const double allowed = std::max(kTouches, walls_.penetration(body.shapeAt(body.simulated)));
    const auto clear = [&](glm::dvec2 place) {
        return walls_.penetration(body.shapeAt(place)) <= allowed && !walls_.crosses(body.simulated, place);
    };
    if (clear(body.place)) return;
    double free = 0.0, blocked = 1.0;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (free + blocked);
        (clear(glm::mix(body.simulated, body.place, middle)) ? free : blocked) = middle;
    }
    body.place = glm::mix(body.simulated, body.place, free);
}

}  // namespace throng::recording
