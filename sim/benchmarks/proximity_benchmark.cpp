// SPDX-License-Identifier: Apache-2.0
#include "sim/benchmarks/proximity_benchmark.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "sim/benchmarks/diagram_benchmark.h"
#include "sim/benchmarks/open_crowd.h"
#include "sim/simulation_parts.h"

namespace throng::sim {
namespace {

using Lists = std::vector<std::vector<std::uint32_t>>;

double distanceBetween(const authoring::Scene& scene, std::size_t row, std::uint32_t other) {
    return glm::distance(scene.people[row].spawn_position, scene.people[other].spawn_position);
}

/// Rays also meet some whose tile, but not whose centre, is in view; where such a one is nearer and the list
/// is full, the true neighbour it displaces is not a miss.
double recallOf(const Lists& found, const Lists& exact, const authoring::Scene& scene) {
    std::size_t expected = 0, met = 0;
    for (std::size_t row = 0; row < exact.size(); ++row) {
        const bool full = found[row].size() == static_cast<std::size_t>(scene.settings.neighbours);
        const double farthest =
            full ? distanceBetween(scene, row, found[row].back()) : std::numeric_limits<double>::infinity();
        for (const std::uint32_t other : exact[row]) {
            if (distanceBetween(scene, row, other) > farthest) continue;
            ++expected;
            met += std::count(found[row].begin(), found[row].end(), other) != 0 ? 1 : 0;
        }
    }
    return expected ? static_cast<double>(met) / static_cast<double>(expected) : 1.0;
}

struct Runner {
    std::optional<ProximityTiming>* result;
    std::unique_ptr<Simulation> simulation;
    std::vector<double> search, step;
};

/// A step's mean time, over those from one decision of people to the next.
void timeSteps(Runner& runner, int steps) {
    double search = 0.0, step = 0.0;
    for (const auto& [pass, milliseconds] : runner.simulation->profile(steps)) {
        step += milliseconds;
        if (pass == "diagram" || pass == "sensing") search += milliseconds;
    }
    runner.search.push_back(search);
    runner.step.push_back(step);
}

}  // namespace

Lists senseNow(Simulation& simulation) {
    Simulation::Parts& parts = simulation.parts();
    parts.cells.run();
    parts.lookRound();
    const std::uint32_t capacity = parts.buffers.slotCapacity();
    const auto bodies = parts.buffers.bodies.download<gpu::Body>(parts.rows);
    const auto counts = parts.buffers.neighbour_counts.download<std::uint32_t>(parts.rows);
    const auto keys = parts.buffers.neighbours.download<std::uint32_t>(
        std::size_t{capacity} * static_cast<std::size_t>(parts.settings.neighbours));
    Lists lists(parts.rows);
    const std::uint32_t present = parts.buffers.live_dispatch.download<std::uint32_t>(4)[3];
    for (std::uint32_t slot = 0; slot < present; ++slot)
        for (std::uint32_t i = 0; i < counts[slot]; ++i) {
            const std::uint32_t key = keys[i * capacity + slot];
            lists[bodies[slot].row].push_back(key & gpu::NEIGHBOUR_IS_WALL ? key : bodies[key].row);
        }
    return lists;
}

authoring::Scene ProximityBenchmark::crowd(std::uint32_t people) const {
    authoring::Scene scene = openCrowd(people, spacing, 7);
    scene.settings.tile_radius = tile_radius;
    scene.settings.field_of_view = field_of_view;
    scene.settings.samples_per_ray = samples_per_ray;
    scene.settings.neighbours = neighbours;
    for (gpu::Person& person : scene.people)
        person.radius = body_radius;
    scene.smallest_radius = scene.largest_radius = body_radius;
    return scene;
}

ProximityRow ProximityBenchmark::run(const gl::ShaderLibrary& library, std::uint32_t people) const {
    authoring::Scene scene = crowd(people);
    ProximityRow row;
    row.people = people;
    const std::array ways = {std::pair{authoring::Proximity::grid, &row.grid},
                             std::pair{authoring::Proximity::voronoi, &row.voronoi},
                             std::pair{authoring::Proximity::brute, &row.brute}};
    constexpr std::uint32_t kMostForBrute = 16'384;  // four times the people, sixteen times the pairs
    std::vector<Runner> runners;
    Lists exact;
    for (const auto& [way, result] : ways) {
        if (way == authoring::Proximity::brute && people > kMostForBrute) continue;
        scene.settings.proximity = way;
        runners.push_back({result, std::make_unique<Simulation>(scene, library), {}, {}});
        const Lists found = senseNow(*runners.back().simulation);
        if (exact.empty()) exact = found;  // the grid's
        result->emplace();
        (*result)->recall = recallOf(found, exact, scene);
    }
    for (Runner& runner : runners)
        for (int i = 0; i < 2 * scene.settings.stepsPerDecision(); ++i)
            runner.simulation->step();
    for (int round = 0; round < rounds; ++round)
        for (Runner& runner : runners)
            if (round < 3 || runner.step.front() < 2000.0)
                timeSteps(runner, scene.settings.stepsPerDecision());
    for (Runner& runner : runners) {
        ProximityTiming& timing = **runner.result;
        timing.search_ms = median(runner.search);
        timing.step_ms = median(runner.step);
        timing.rounds = static_cast<int>(runner.step.size());
    }
    return row;
}

}  // namespace throng::sim
