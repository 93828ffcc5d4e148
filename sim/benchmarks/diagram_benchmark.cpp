// SPDX-License-Identifier: Apache-2.0
#include "sim/benchmarks/diagram_benchmark.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "sim/diagram/methods.h"

namespace throng::sim {
namespace {

/// The inputs of a case on the device.
struct CaseBuffers {
    explicit CaseBuffers(const std::vector<gpu::DiagramSite>& host_sites)
        : sites(gl::makeBuffer("sites", host_sites)),
          dispatch(gl::makeBuffer("dispatch", dispatchOf(host_sites.size()))) {
        std::vector<std::uint32_t> order(host_sites.size());
        for (std::uint32_t i = 0; i < order.size(); ++i)
            order[i] = i;
        slots = gl::makeBuffer("slots", order);
    }
    gl::Buffer sites, dispatch, slots;
};

/// Pairs of a site and a pixel that comparing everything with everything would take, in ms on a slow machine.
double forecastMilliseconds(const DiagramContestant& contestant, const DiagramCase& setup) {
    if (contestant.method != DiagramMethod::per_pixel) return 0.0;
    const double pairs = static_cast<double>(setup.sites) * setup.side * setup.side;
    return pairs / 1.0e6;
}

double wrongShare(Diagram& diagram, const std::vector<std::uint32_t>& expected) {
    const auto owners = diagram.owners().download<std::uint32_t>(expected.size());
    std::size_t wrong = 0;
    for (std::size_t pixel = 0; pixel < owners.size(); ++pixel)
        wrong += owners[pixel] != expected[pixel];
    return static_cast<double>(wrong) / static_cast<double>(owners.size());
}

}  // namespace

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    const auto index = std::lround(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + index, values.end());
    return values[static_cast<std::size_t>(index)];
}

double median(std::vector<double> values) {
    return percentile(std::move(values), 0.5);
}

std::vector<gpu::DiagramSite> sitesOf(const DiagramCase& setup) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> anywhere(0.0f, static_cast<float>(setup.side));
    std::vector<gpu::DiagramSite> sites(setup.sites);
    for (std::uint32_t id = 0; id < setup.sites; ++id)
        sites[id] = {{anywhere(random), anywhere(random)}, setup.radius, id};
    return sites;
}

std::vector<std::uint32_t> referenceOwners(const DiagramCase& setup,
                                           const std::vector<gpu::DiagramSite>& sites) {
    const std::size_t pixels = std::size_t{setup.side} * setup.side;
    std::vector<std::uint32_t> owners(pixels, gpu::NO_INDEX);
    std::vector<float> nearest(pixels, HUGE_VALF);
    const int side = static_cast<int>(setup.side);
    for (const gpu::DiagramSite& site : sites) {  // by ascending id, so ties stay with the smallest
        const float limit = site.radius * site.radius;
        const auto first = [&](float at) { return std::max(0, static_cast<int>(at - site.radius) - 1); };
        const auto last = [&](float at) { return std::min(side, static_cast<int>(at + site.radius) + 2); };
        for (int y = first(site.position.y); y < last(site.position.y); ++y)
            for (int x = first(site.position.x); x < last(site.position.x); ++x) {
                const float dx = site.position.x - (static_cast<float>(x) + 0.5f);
                const float dy = site.position.y - (static_cast<float>(y) + 0.5f);
                const float squared = dx * dx + dy * dy;
                const std::size_t pixel =
                    static_cast<std::size_t>(y) * setup.side + static_cast<std::size_t>(x);
                if (squared > limit || squared >= nearest[pixel]) continue;
                nearest[pixel] = squared;
                owners[pixel] = site.id;
            }
    }
    return owners;
}

std::vector<std::optional<DiagramTiming>> DiagramBenchmark::run(
    const gl::ShaderLibrary& library, const gl::Timer& timer, const DiagramCase& setup,
    const std::vector<DiagramContestant>& contestants) const {
    const std::vector<gpu::DiagramSite> sites = sitesOf(setup);
    const std::vector<std::uint32_t> expected = referenceOwners(setup, sites);
    const CaseBuffers buffers(sites);

    struct Runner {
        std::unique_ptr<Diagram> diagram;
        std::unique_ptr<gl::Buffer> owners;
        std::unique_ptr<GradientDiagram> yardstick;  // instead of a diagram
        std::unique_ptr<LongWork> long_work = std::make_unique<LongWork>();
        std::vector<double> times;
        DiagramTiming timing;
        bool once = false;

        bool present() const { return diagram || yardstick; }
        void build() {
            if (diagram)
                diagram->build();
            else
                yardstick->draw();
        }
    };
    std::vector<Runner> runners(contestants.size());
    for (std::size_t i = 0; i < contestants.size(); ++i) {
        const DiagramContestant& contestant = contestants[i];
        if (forecastMilliseconds(contestant, setup) > 10.0 * patience_ms) continue;
        DiagramOptions options;
        options.method = contestant.method;
        options.width = options.height = setup.side;
        options.largest_radius = setup.radius;
        options.live_capacity = setup.sites;
        options.cone_sides = contestant.cone_sides;
        options.gather = contestant.gather;
        Runner& runner = runners[i];
        const DiagramInput input{&buffers.sites, &buffers.dispatch, &buffers.slots};
        if (contestant.draw_only) {
            runner.owners = std::make_unique<gl::Buffer>("owners", std::size_t{4} * setup.side * setup.side);
            runner.yardstick = std::make_unique<GradientDiagram>(DiagramSetup{
                library, options, std::span<const gpu::DiagramSite>(), *runner.owners, *runner.long_work});
            runner.yardstick->connect(input);
        } else {
            runner.diagram = std::make_unique<Diagram>(library, options, std::span<const gpu::DiagramSite>());
            runner.diagram->connect(input);
        }
        const double first = timer.milliseconds([&] { runner.build(); });
        runner.once = first > patience_ms;
        if (runner.once) runner.times.push_back(first);
        if (runner.diagram) runner.timing.wrong_share = wrongShare(*runner.diagram, expected);
    }
    gl::Buffer elsewhere("benchmark, other memory", std::size_t{64} << 20);
    std::vector<std::vector<double>> ratios(contestants.size());
    for (int round = 0; round < rounds; ++round) {
        for (Runner& runner : runners)
            if (runner.present() && !runner.once) {
                elsewhere.fill(static_cast<std::uint32_t>(round));
                runner.times.push_back(timer.milliseconds([&] { runner.build(); }));
            }
        const Runner& yardstick = runners.at(reference);
        for (std::size_t i = 0; i < runners.size(); ++i)
            if (!runners[i].once && !runners[i].times.empty() && !yardstick.times.empty())
                ratios[i].push_back(runners[i].times.back() / yardstick.times.back());
    }
    std::vector<std::optional<DiagramTiming>> results(contestants.size());
    for (std::size_t i = 0; i < contestants.size(); ++i) {
        if (runners[i].times.empty()) continue;
        DiagramTiming timing = runners[i].timing;
        timing.median_ms = median(runners[i].times);
        timing.low_ms = percentile(runners[i].times, 0.1);
        timing.high_ms = percentile(runners[i].times, 0.9);
        timing.rounds = static_cast<int>(runners[i].times.size());
        timing.ratio = median(ratios[i]);
        if (ratios[i].empty() && !runners.at(reference).times.empty())
            timing.ratio = timing.median_ms / median(runners.at(reference).times);
        results[i] = timing;
    }
    return results;
}

}  // namespace throng::sim
