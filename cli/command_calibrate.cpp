// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/baking/calibration_file.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"
#include "sim/benchmarks/calibration.h"

namespace throng::cli {
namespace {

std::string describe(const sim::MethodCost& cost) {
    if (cost.method != sim::DiagramMethod::binned) return std::string(authoring::wordFor(cost.method));
    return fmt::format("binned, blocks of {} x {} px, bins of {:g} radii", cost.gather.block_width,
                       cost.gather.block_height, cost.gather.bin_radii);
}

nlohmann::ordered_json costsJson(const sim::CostModel& model, const gl::Device& device) {
    nlohmann::ordered_json costs = nlohmann::ordered_json::array();
    for (const sim::MethodCost& cost : model.costs)
        costs.push_back({{"method", describe(cost)},
                         {"base_ms", cost.base_ms},
                         {"pixel_ns", cost.pixel_ns},
                         {"site_ns", cost.site_ns},
                         {"covered_ns", cost.covered_ns}});
    return {{"device", device.name}, {"output", calibrationPath(device).string()}, {"costs", costs}};
}

struct CalibrateOptions {
    int device = -1;
    int rounds = 7;
    bool as_json = false;
};

void run(const CalibrateOptions& options) {
    const gl::Context context({options.device, false});
    const gl::Timer timer(context.device().software);
    const bool terminal = isatty(STDERR_FILENO) != 0;
    const sim::CostModel model =
        sim::calibrate(gl::ShaderLibrary(), timer, context.device().name, options.rounds, [&](double share) {
            fmt::print(stderr, "{}calibrating {} {:3.0f} %{}", terminal ? "\r" : "", context.device().name,
                       100.0 * share, terminal ? "" : "\n");
        });
    if (terminal) fmt::print(stderr, "\n");
    context.check("calibrating");
    saveCalibration(context.device(), model);
    if (options.as_json) return sayJson(costsJson(model, context.device()));
    fmt::print("{:48} {:>9} {:>9} {:>9} {:>11}\n", "method", "base ms", "ns/pixel", "ns/site", "ns/covered");
    for (const sim::MethodCost& cost : model.costs)
        fmt::print("{:48} {:9.3f} {:9.3f} {:9.2f} {:11.3f}\n", describe(cost), cost.base_ms, cost.pixel_ns,
                   cost.site_ns, cost.covered_ns);
    fmt::print("\nFor a window of 1,024 x 1,024 px, `auto` will take:\n");
    for (const auto& [sites, radius] :
         {std::pair{256.0, 8.0}, std::pair{4096.0, 8.0}, std::pair{16384.0, 8.0}, std::pair{65536.0, 4.0},
          std::pair{262144.0, 2.0}, std::pair{1048576.0, 1.0}}) {
        const sim::DiagramLoad load{sites, radius, 1048576.0};
        const sim::MethodCost& best = model.choose(load);
        fmt::print("  {:9.0f} sites, r {:g}: {} ({:.2f} ms)\n", sites, radius, describe(best),
                   best.milliseconds(load));
    }
    fmt::print("{}\n", calibrationPath(context.device()).string());
}

}  // namespace

void addCalibrate(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "calibrate", "Measure the device, so that `auto` takes its fastest way to build the diagram");
    auto options = std::make_shared<CalibrateOptions>();
    command->add_option("--device", options->device, "This device (`throng devices` lists them)");
    command->add_option("--rounds", options->rounds, "How often everything is timed; medians count")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->footer(
        "Kept in the cache folder ($XDG_CACHE_HOME/throng), one file for each device and driver; without it, "
        "bakes\n"
        "use a built-in table. Bakes have the same bytes either way.\n\nExample:\n  throng calibrate");
    command->add_flag("--json", options->as_json, "Print a JSON document");
    command->callback([options] { run(*options); });
}

}  // namespace throng::cli
