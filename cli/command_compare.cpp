// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <numbers>

#include "analysis/compare/compare.h"
#include "base/files/output_file.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace {

struct CompareOptions {
    std::string bake, trajectories, plots;
    std::vector<double> line, area, move{0.0, 0.0};
    double rate = 0.0, turn = 0.0;
    std::string unit;
    bool json = false;
};

analysis::Trajectories peopleOf(const CompareOptions& options) {
    analysis::TrajectoryOptions reading;
    if (options.rate > 0.0) reading.rate = options.rate;
    if (!options.unit.empty()) reading.metres = options.unit == "cm" ? 0.01 : 1.0;
    reading.move = {options.move[0], options.move[1]};
    reading.turn = options.turn * std::numbers::pi / 180.0;
    return analysis::readTrajectories(options.trajectories, reading);
}

void runCompare(const CompareOptions& options) {
    io::CrowdReader crowd(io::loadBake(options.bake));
    analysis::CompareOptions comparing;
    if (!options.area.empty())
        comparing.area = analysis::Box2d{
            {std::min(options.area[0], options.area[2]), std::min(options.area[1], options.area[3])},
            {std::max(options.area[0], options.area[2]), std::max(options.area[1], options.area[3])}};
    if (!options.line.empty())
        comparing.line = {{options.line[0], options.line[1]}, {options.line[2], options.line[3]}};
    const analysis::Comparison comparison = compareWith(crowd, peopleOf(options), comparing);
    if (options.json)
        sayJson(comparisonJson(comparison));
    else
        say(stdout, "{}", comparisonText(comparison));
    if (options.plots.empty()) return;
    makeFolder(options.plots);
    writeComparisonPlots(options.plots, comparison);
}

}  // namespace

void addCompare(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("compare", "Put a bake beside trajectories of people, or another bake");
    auto options = std::make_shared<CompareOptions>();
    command->add_option("bake", options->bake, "A bake's folder, or its bake.json")->required();
    command
        ->add_option(
            "trajectories", options->trajectories,
            "Text (person, frame, x, y in each line), CSV with names of columns, JuPedSim's database, or a "
            "bake")
        ->required();
    command->add_flag("--json", options->json, "Print a JSON document");
    command->add_option("--plots", options->plots, "Also draw plots (PNG) into this folder");
    command->add_option("--line", options->line, "Count people across a line: X1 Y1 X2 Y2, m in the world")
        ->expected(4);
    command
        ->add_option(
            "--area", options->area,
            "Look at people in this box only: X1 Y1 X2 Y2, m; unless told, a metre inside of where the "
            "trajectories are")
        ->expected(4);
    command
        ->add_option("--fps", options->rate, "Frames a second of the trajectories, where they do not say it")
        ->check(CLI::Range(0.1, 10000.0));
    command
        ->add_option("--unit", options->unit, "Of the trajectories, where they do not say it; m unless told")
        ->check(CLI::IsMember({"m", "cm"}));
    command->add_option("--turn", options->turn,
                        "Turn the trajectories round their origin, deg counterclockwise");
    command->add_option("--move", options->move, "Then move them: X Y, m")->expected(2);
    command->footer(
        "Both are looked at ten times a second, from places alone.\n\n"
        "Example:\n  throng compare bakes/bottleneck experiment.txt --line -0.6 0 0.6 0 --plots plots");
    command->callback([options] { runCompare(*options); });
}

}  // namespace throng::cli
