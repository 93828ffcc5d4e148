// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "analysis/measure/measure.h"
#include "base/files/input_file.h"
#include "base/files/output_file.h"
#include "cli/baking/judge.h"
#include "cli/commands.h"
#include "cli/follow.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace {

struct MeasureOptions {
    std::string bake;
    std::string plots;
    std::vector<double> line;
    FollowRequest follow;
    bool json = false;
};

void runMeasure(const MeasureOptions& options) {
    io::CrowdReader crowd(io::loadBake(options.bake));
    if (!options.follow.rows.empty()) {
        FollowRequest follow = options.follow;
        follow.folder = options.plots;
        follow.json = options.json;
        followPeople(crowd, follow);
        return;
    }
    analysis::MeasureOptions measure;
    if (!options.line.empty())
        measure.line = {{options.line[0], options.line[1]}, {options.line[2], options.line[3]}};
    const auto [measured, missed] = judgeBake(crowd, measure);
    if (options.json) {
        nlohmann::ordered_json json = analysis::measurementJson(measured);
        json["missed"] = missed;
        sayJson(json);
    } else {
        fmt::print("{}", analysis::measurementText(measured));
    }
    if (!options.plots.empty()) {
        makeFolder(options.plots);
        analysis::writeMeasurementPlots(options.plots, measured, crowd.bake().name);
    }
    for (const std::string& bar : missed)
        say(stderr, "throng: {}: {}\n", crowd.bake().name, bar);
    if (!missed.empty()) throw Exit(kExpectationMissed);
}

}  // namespace

void addMeasure(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("measure", "Measure how well a bake's people move, from its files alone");
    auto options = std::make_shared<MeasureOptions>();
    command->add_option("bake", options->bake, "A bake's folder, or its bake.json")->required();
    command->add_flag("--json", options->json, "Print a JSON document");
    command->add_option("--plots", options->plots, "Also draw plots (PNG) into this folder");
    command->add_option("--line", options->line, "Count people across a line: X1 Y1 X2 Y2, m in the world")
        ->expected(4);
    FollowRequest& follow = options->follow;
    CLI::Option* rows =
        command
            ->add_option("--follow", follow.rows,
                         "Instead: simulate the bake's layout anew and tell what each rule of "
                         "motion does to this row of agents.csv (repeatable; with --plots, also "
                         "tables and a plot of each)")
            ->take_all()
            ->expected(1);
    command->add_option("--from", follow.from, "With --follow: from so many seconds on")->needs(rows);
    command->add_option("--to", follow.to, "With --follow: until so many seconds")->needs(rows);
    command
        ->add_option("--device", follow.device,
                     "With --follow: simulate on this device (`throng devices` lists them)")
        ->needs(rows);
    command->footer(
        "Exits with 1 when a bar of the layout's `expect` block is missed.\n\n"
        "Example:\n  throng measure bakes/intersection --plots plots\n"
        "  throng measure bakes/intersection --follow 12 --from 20 --to 40 --plots plots");
    command->callback([options] { runMeasure(*options); });
}

}  // namespace throng::cli
