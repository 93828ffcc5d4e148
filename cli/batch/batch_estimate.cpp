// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/batch_estimate.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/stopwatch.h"
#include "cli/baking/baker.h"
#include "sim/benchmarks/open_crowd.h"
#include "sim/simulation.h"

namespace throng::cli {
namespace {

/// s a step takes with this many people about.
double secondsPerStep(Baker& baker, std::uint32_t people) {
    constexpr float kSpacing = 1.5f;  // m
    constexpr int kSteps = 40;
    sim::Simulation simulation = baker.simulate(sim::openCrowd(people, kSpacing, 1));
    for (int i = 0; i < 5; ++i)
        simulation.step();
    simulation.wait();
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < kSteps; ++i)
        simulation.step();
    simulation.wait();
    return secondsSince(start) / kSteps;
}

/// Mean s of the scenarios that are done; 0 where none is.
double meanSeconds(const BatchPlan& plan, const BatchFolder& folder) {
    double sum = 0.0;
    double count = 0.0;
    for (const PlannedScenario& scenario : plan.scenarios()) {
        const auto result = folder.readResult(scenario.id);
        const nlohmann::ordered_json::json_pointer total("/seconds/total");
        if (!result || !result->contains(total)) continue;
        sum += result->at(total).get<double>();
        ++count;
    }
    return count > 0.0 ? sum / count : 0.0;
}

std::string bytesText(double bytes) {
    const char* units[] = {"B", "KB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    for (; bytes >= 1000.0 && unit + 1 < std::size(units); ++unit)
        bytes /= 1000.0;
    return fmt::format("{:.3g} {}", bytes, units[unit]);
}

}  // namespace

void printEstimate(const BatchPlan& plan, const BatchFolder& folder, const BatchStanding& standing,
                   const LocalOptions& options) {
    constexpr double kOverhead = 0.06;  // s a scenario, beyond the simulation
    const double open = static_cast<double>(standing.open.size());
    const double share = open / std::max(1.0, static_cast<double>(plan.scenarios().size()));
    const std::size_t workers = workersFor(plan, options, standing.open.size());
    fmt::print("to bake: {} with {} worker{}\n", standing.open.size(), workers, workers == 1 ? "" : "s");
    fmt::print("space: at most {}\n", bytesText(share * plan.load().bytes));
    if (const double mean = meanSeconds(plan, folder); mean > 0.0) {
        fmt::print("time: about {} ({:.3g} s a scenario, as those done took)\n",
                   timeText(open * mean / static_cast<double>(workers)), mean);
        return;
    }
    constexpr std::uint32_t kFew = 200, kMany = 2000;
    Baker baker(options.device, "", static_cast<std::size_t>(plan.load().largest_people));
    const double few = secondsPerStep(baker, kFew);
    const double many = secondsPerStep(baker, kMany);
    const double per_person = std::max(0.0, (many - few) / (kMany - kFew));
    const double per_step = std::max(0.0, few - per_person * kFew);
    const double seconds =
        share * (per_step * plan.load().steps + per_person * plan.load().people_steps) + open * kOverhead;
    fmt::print("time: at most about {} (measured just now on {}, everybody counted from the first step)\n",
               timeText(seconds / static_cast<double>(workers)), baker.device().name);
}

}  // namespace throng::cli
