// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <thread>

#include "base/files/output_file.h"
#include "cli/baking/calibration_file.h"
#include "cli/baking/load_layout.h"
#include "cli/bench_report.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"
#include "sim/benchmarks/launch_benchmark.h"
#include "sim/gl/context.h"
#include "sim/gl/timer.h"

namespace throng::cli {
namespace {

struct BenchOptions {
    std::string output = "bench";
    int device = -1;
    int rounds = 15;
    std::uint32_t most = 0;
    bool json = false;
};

BenchMachine machineOf(const gl::Device& device, const gl::Timer& timer) {
    return {device, std::thread::hardware_concurrency(), timer.name()};
}

std::vector<sim::DiagramContestant> allContestants(std::size_t& yardstick) {
    std::vector<sim::DiagramContestant> contestants;
    for (const authoring::DiagramMethodEntry& entry : authoring::kDiagramMethods) {
        std::string name(entry.word);
        if (entry.method == sim::DiagramMethod::cones) name += ", 16 sides";
        contestants.push_back({name, entry.method, 16, {}, false});
    }
    yardstick = contestants.size();
    contestants.push_back({"gradient1, drawing alone", sim::DiagramMethod::gradient1, 16, {}, true});
    contestants.push_back({"auto", sim::DiagramMethod::binned, 16, {}, false});
    return contestants;
}

nlohmann::ordered_json timingsJson(const DiagramReport& report) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < report.cases.size(); ++i)
        for (std::size_t j = 0; j < report.contestants.size(); ++j)
            if (const auto& timing = report.timings[i][j])
                list.push_back({{"method", report.contestants[j].name},
                                {"sites", report.cases[i].sites},
                                {"radius", report.cases[i].radius},
                                {"median_ms", timing->median_ms},
                                {"ratio", timing->ratio},
                                {"wrong_share", timing->wrong_share}});
    return list;
}

nlohmann::ordered_json timingsJson(const ProximityReport& report) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const sim::ProximityRow& row : report.rows)
        for (const auto& [name, timing] : {std::pair{"voronoi", &row.voronoi}, std::pair{"grid", &row.grid},
                                           std::pair{"brute", &row.brute}})
            if (*timing)
                list.push_back({{"way", name},
                                {"people", row.people},
                                {"search_ms", (*timing)->search_ms},
                                {"step_ms", (*timing)->step_ms},
                                {"recall", (*timing)->recall}});
    return list;
}

void runDiagrams(const BenchOptions& options) {
    makeFolder(options.output);
    const gl::Context context({options.device, false});
    const gl::Timer timer(context.device().software);
    const gl::ShaderLibrary shaders;
    const sim::CostModel costs = costsFor(context.device());
    DiagramReport report;
    report.machine = machineOf(context.device(), timer);
    report.contestants = allContestants(report.yardstick);
    for (const sim::DiagramCase& setup :
         {sim::DiagramCase{256, 8}, sim::DiagramCase{4096, 8}, sim::DiagramCase{16384, 8},
          sim::DiagramCase{65536, 4}, sim::DiagramCase{262144, 2}, sim::DiagramCase{1048576, 1}})
        if (options.most == 0 || setup.sites <= options.most) report.cases.push_back(setup);
    sim::DiagramBenchmark benchmark;
    benchmark.rounds = options.rounds;
    benchmark.reference = report.yardstick;
    for (const sim::DiagramCase& setup : report.cases) {
        say(stderr, "{} sites of radius {} px\n", setup.sites, setup.radius);
        std::vector<sim::DiagramContestant> contestants = report.contestants;
        const sim::MethodCost& best = costs.choose(
            {static_cast<double>(setup.sites), setup.radius, static_cast<double>(setup.side) * setup.side});
        contestants.back().method = best.method;
        contestants.back().gather = best.gather;
        report.automatic.push_back(best.method == sim::DiagramMethod::binned
                                       ? fmt::format("binned ({} x {} px blocks, bins of {:g} radii)",
                                                     best.gather.block_width, best.gather.block_height,
                                                     best.gather.bin_radii)
                                       : std::string(authoring::wordFor(best.method)));
        report.timings.push_back(benchmark.run(shaders, timer, setup, contestants));
        for (std::size_t i = 0; i < contestants.size() && !options.json; ++i)
            if (const auto& timing = report.timings.back()[i])
                fmt::print("  {:26} {:9.2f} ms  ratio {:6.2f}  wrong {:.4f} %\n", contestants[i].name,
                           timing->median_ms, timing->ratio, 100.0 * timing->wrong_share);
    }
    context.check("timing diagrams");
    writeDiagramReport(options.output, report);
    if (options.json)
        sayJson(timingsJson(report));
    else
        fmt::print("{}/diagrams.md, .csv\n", options.output);
}

void runProximity(const BenchOptions& options) {
    makeFolder(options.output);
    const gl::Context context({options.device, false});
    const gl::Timer timer(true);  // passes are timed one by one, around waits
    ProximityReport report;
    report.machine = machineOf(context.device(), timer);
    report.settings.rounds = options.rounds;
    for (const std::uint32_t people : {256u, 4096u, 16384u, 65536u, 262144u}) {
        if (options.most != 0 && people > options.most) continue;
        say(stderr, "{} people\n", people);
        report.rows.push_back(report.settings.run(gl::ShaderLibrary(), people));
        const sim::ProximityRow& row = report.rows.back();
        if (options.json) continue;
        for (const auto& [name, result] : {std::pair{"voronoi", &row.voronoi}, std::pair{"grid", &row.grid},
                                           std::pair{"brute", &row.brute}})
            if (*result)
                fmt::print("  {:8} {:9.2f} ms to find neighbours, {:9.2f} ms a step, recall {:.3f} %\n", name,
                           (*result)->search_ms, (*result)->step_ms, 100.0 * (*result)->recall);
    }
    context.check("timing sensing");
    writeProximityReport(options.output, report);
    if (options.json)
        sayJson(timingsJson(report));
    else
        fmt::print("{}/proximity.md, .csv\n", options.output);
}

/// A crowd whose steps are timed, and where.
struct CrowdOptions {
    std::uint32_t people = 4096;
    std::string proximity = "voronoi";
    int device = -1;
    bool bodies = false;  ///< as deep as chests
};

struct StepOptions {
    CrowdOptions crowd;
    std::string table;  ///< of the crowd
};

void addCrowd(CLI::App& command, CrowdOptions& options) {
    command.add_option("--people", options.people, "One per 4 m^2, on their way to random goals")
        ->check(CLI::Range(1, 4'000'000))
        ->capture_default_str();
    command.add_option("--proximity", options.proximity, "What finds neighbours")
        ->check(CLI::IsMember({"voronoi", "grid"}))
        ->capture_default_str();
    command.add_flag("--bodies", options.bodies,
                     "People have bodies that are as deep as chests, instead of discs");
}

void addDevice(CLI::App& command, int& device) {
    command.add_option("--device", device, "Run on this device (`throng devices` lists them)");
}

authoring::Scene crowdOf(const CrowdOptions& options) {
    authoring::Scene scene = sim::ProximityBenchmark{}.crowd(options.people);
    scene.settings.proximity =
        options.proximity == "grid" ? authoring::Proximity::grid : authoring::Proximity::voronoi;
    constexpr float kDepthOverBreadth = 0.25f / 0.47f;  // of adults: `body` in the layout's schema
    if (options.bodies)
        for (gpu::Person& person : scene.people)
            person.half_axis = person.radius * (1.0f - kDepthOverBreadth);
    return scene;
}

/// One row per person: where it is, where it goes, how fast and how large it is.
void writeCrowd(const std::string& path, const authoring::Scene& scene) {
    std::string table = "x,y,goal_x,goal_y,speed,radius\n";
    for (std::size_t row = 0; row < scene.people.size(); ++row) {
        const gpu::Person& person = scene.people[row];
        fmt::format_to(std::back_inserter(table), "{},{},{},{},{},{}\n", person.spawn_position.x,
                       person.spawn_position.y, scene.goals[row].x, scene.goals[row].y,
                       person.preferred_speed, person.radius);
    }
    writeFile(path, table);
}

/// Steps when told to, so that another program can be timed in turn: for a line of the standard input, as
/// many as there are from one decision of people to the next.
void runStep(const StepOptions& options) {
    const gl::Context context({options.crowd.device, false});
    std::optional<authoring::Scene> scene = crowdOf(options.crowd);
    if (!options.table.empty()) writeCrowd(options.table, *scene);
    sim::Simulation simulation(*scene, gl::ShaderLibrary(), costsFor(context.device()));
    const int steps = scene->settings.stepsPerDecision();
    scene.reset();  // the device has it all
    for (int step = 0; step < steps; ++step)
        simulation.step();
    simulation.wait();
    fmt::print("{}\n", context.device().name);
    std::fflush(stdout);
    for (std::string line; std::getline(std::cin, line);) {
        const auto start = std::chrono::steady_clock::now();
        for (int step = 0; step < steps; ++step)
            simulation.step();
        simulation.wait();
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        fmt::print("{:.4f}\n", time.count() / steps);
        std::fflush(stdout);
    }
}

void addStep(CLI::App& bench) {
    CLI::App* command = bench.add_subcommand("step",
                                             "Whole steps, those of a frame for each line of the standard "
                                             "input: their mean time in ms, a line each");
    auto options = std::make_shared<StepOptions>();
    addCrowd(*command, options->crowd);
    command->add_option("--crowd", options->table, "Write where everybody is and goes into this file (CSV)");
    addDevice(*command, options->crowd.device);
    command->callback([options] { runStep(*options); });
}

struct LaunchOptions {
    CrowdOptions crowd{.people = 16384};
    std::string layout;   ///< instead of a crowd, if not empty
    double after = 10.0;  ///< s from its beginning
    int steps = 48;
    bool json = false;
};

nlohmann::ordered_json toJson(const sim::LaunchTimes& times, const LaunchOptions& options,
                              const gl::Device& device) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const sim::LaunchTime& row : times.rows)
        rows.push_back({{"pass", row.pass},
                        {"what", row.what},
                        {"launches", row.launches},
                        {"step_ms", row.step_ms},
                        {"bytes_per_person", row.bytes}});
    return {
        {"device", device.name},    {"people", options.crowd.people}, {"proximity", options.crowd.proximity},
        {"step_ms", times.step_ms}, {"asking_ms", times.asking_ms},   {"launches", rows}};
}

void print(const sim::LaunchTimes& times, const LaunchOptions& options, const gl::Device& device) {
    fmt::print("{} people, {}: {:.4f} ms a step ({:.0f} steps/s), of which asking for it takes {:.4f}\n",
               options.crowd.people, device.name, times.step_ms, 1000.0 / times.step_ms, times.asking_ms);
    fmt::print("{:<10} {:<48} {:>8} {:>9} {:>9} {:>8}\n", "pass", "program or transfer", "launches",
               "us each", "us a step", "GB/s");
    double launches = 0.0, sum = 0.0;
    for (const sim::LaunchTime& row : times.rows) {
        const double each_us = 1000.0 * row.step_ms / row.launches;
        const double rate = static_cast<double>(row.bytes) * options.crowd.people / each_us * 1.0e-3;
        fmt::print("{:<10} {:<48} {:>8.3f} {:>9.2f} {:>9.2f} {:>8.1f}\n", row.pass, row.what, row.launches,
                   each_us, 1000.0 * row.step_ms, rate);
        launches += row.launches;
        sum += 1000.0 * row.step_ms;
    }
    fmt::print("{:<10} {:<48} {:>8.3f} {:>9} {:>9.2f}\n", "a step", "", launches, "", sum);
}

/// Goes on to a time of the scene as a bake would.
void stepUntil(sim::Simulation& simulation, const authoring::SimulationSettings& settings, double seconds) {
    const auto steps = static_cast<std::uint32_t>(std::lround(seconds * settings.fps * settings.substeps));
    while (simulation.stepsDone() < steps)
        simulation.step();
    simulation.wait();
}

void runLaunches(LaunchOptions options) {
    const gl::Context context({options.crowd.device, false});
    const authoring::Scene scene =
        options.layout.empty() ? crowdOf(options.crowd) : loadLayout(options.layout, {}).scene;
    sim::Simulation simulation(scene, gl::ShaderLibrary(), costsFor(context.device()));
    if (!options.layout.empty()) {
        stepUntil(simulation, scene.settings, options.after);
        options.crowd.people = static_cast<std::uint32_t>(scene.people.size());
    }
    const sim::LaunchTimes times = sim::timeLaunches(simulation, context.device().software, options.steps);
    context.check("timing launches");
    if (options.json)
        sayJson(toJson(times, options, context.device()));
    else
        print(times, options, context.device());
}

void addLaunches(CLI::App& bench) {
    CLI::App* command = bench.add_subcommand(
        "launches", "Where the time of a step goes: every program and transfer on the device's own clock");
    auto options = std::make_shared<LaunchOptions>();
    addCrowd(*command, options->crowd);
    CLI::Option* layout =
        command->add_option("--layout", options->layout, "Of this layout instead of such a crowd")
            ->excludes("--people")
            ->excludes("--proximity")
            ->excludes("--bodies");
    command->add_option("--after", options->after, "Seconds of the layout that go before")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str()
        ->needs(layout);
    command->add_option("--steps", options->steps, "How many steps are timed")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    addDevice(*command, options->crowd.device);
    command->add_flag("--json", options->json, "Print a JSON document");
    command->callback([options] { runLaunches(*options); });
}

CLI::App* addKind(CLI::App& bench, const char* name, const char* what, void (*run)(const BenchOptions&)) {
    CLI::App* command = bench.add_subcommand(name, what);
    auto options = std::make_shared<BenchOptions>();
    command->add_option("-o,--output", options->output, "The folder to write the report into")
        ->capture_default_str();
    addDevice(*command, options->device);
    command->add_option("--rounds", options->rounds, "How often everything is timed")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->add_option("--most", options->most, "Leave out cases with more sites or people than this");
    command->add_flag("--json", options->json, "Print a JSON document");
    command->callback([options, run] { run(*options); });
    return command;
}

}  // namespace

void addBench(CLI::App& app) {
    CLI::App* bench = app.add_subcommand("bench", "Time this device: Markdown and CSV");
    bench->require_subcommand(1);
    addKind(*bench, "diagrams", "Every way to build the diagram, beside the paper's Table 1", runDiagrams);
    addKind(*bench, "proximity", "Finding neighbours by the diagram, by a grid, and by comparing everybody",
            runProximity);
    addStep(*bench);
    addLaunches(*bench);
    bench->footer("Example:\n  throng bench diagrams -o bench");
}

}  // namespace throng::cli
