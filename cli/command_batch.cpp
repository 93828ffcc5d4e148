// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <sstream>

#include "base/build_name.h"
#include "base/files/output_file.h"
#include "base/stopwatch.h"
#include "base/text/printable.h"
#include "cli/batch/batch_estimate.h"
#include "cli/batch/batch_folder.h"
#include "cli/batch/batch_local.h"
#include "cli/batch/batch_progress.h"
#include "cli/batch/batch_slurm.h"
#include "cli/batch/batch_worker.h"
#include "cli/batch/farm_job.h"
#include "cli/batch/results_database.h"
#include "cli/commands.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace {

struct BatchOptions {
    std::string family;
    std::string output;
    LocalOptions local;
    SlurmOptions slurm;
    std::string executor = "local";
    std::string emit;
    std::string sbatch_options;
    double checkpoint_minutes = 10.0;
    double time_limit_minutes = 0.0;
    std::string shard;
    bool dry_run = false;
    bool again = false;
    bool prune = false;
    bool collect_only = false;
    bool worker = false;
    std::size_t worker_people = 0;
    bool json = false;
    bool quiet = false;
};

/// "2/8": the second of eight parts, counted from 0.
struct Shard {
    std::size_t number = 0, of = 1;
    bool has(std::size_t index) const { return index % of == number; }
};

Shard shardOf(const std::string& text) {
    if (text.empty()) return {};
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto [slash, wrong] = std::from_chars(text.data(), end, shard.number);
    if (wrong == std::errc() && slash != end && *slash == '/') {
        const auto [last, also_wrong] = std::from_chars(slash + 1, end, shard.of);
        if (also_wrong == std::errc() && last == end && shard.number < shard.of) return shard;
    }
    throw CLI::ValidationError("--shard", fmt::format("expects I/N with I from 0 to N - 1, not `{}`", text));
}

/// What of the standing is this process's part.
void keepShard(std::vector<std::size_t>& scenarios, const Shard& shard) {
    std::erase_if(scenarios, [&](std::size_t index) { return !shard.has(index); });
}

std::string plural(std::size_t count, const char* one, const std::string& several) {
    return fmt::format("{} {}", count, count == 1 ? one : several);
}
std::string plural(std::size_t count, const char* word) {
    return plural(count, word, word + std::string("s"));
}

void printStanding(const BatchPlan& plan, const BatchStanding& standing) {
    say(stdout, "{}: {} of `{}`\n", plan.family().name, plural(plan.scenarios().size(), "scenario"),
        plan.family().base_name);
    for (const authoring::Axis& axis : plan.family().axes) {
        std::string values;
        for (const authoring::Json& value : axis.values)
            values += (values.empty() ? "" : ", ") + value.dump();
        if (values.size() > 60) values = values.substr(0, 57) + "...";
        const char* words[] = {"", "uniform", "normal", "log-normal"};
        if (axis.kind == authoring::Axis::Kind::formula)
            values = "a formula";
        else if (axis.kind != authoring::Axis::Kind::values)
            values = fmt::format("{} {:g}, {:g}", words[static_cast<int>(axis.kind)], axis.a, axis.b);
        say(stdout, "  {}: {}\n", axis.name, values);
    }
    if (standing.done) say(stdout, "{} are done\n", standing.done);
    if (standing.failed_before) say(stdout, "{} failed before and are tried again\n", standing.failed_before);
    if (standing.out_of_date)
        say(stdout,
            "{} are out of date (the base layout or what is to be written has changed) and are baked again\n",
            standing.out_of_date);
    if (standing.other_build)
        say(stdout, "{} were made by another build of throng (this is {}) and are baked again\n",
            standing.other_build, buildName());
    if (!standing.damaged.empty())
        say(stdout, "{} damaged and baked again\n", plural(standing.damaged.size(), "bake is", "bakes are"));
    if (!standing.foreign.empty())
        say(stdout, "{} belong to no scenario of the family any more; --prune removes them\n",
            plural(standing.foreign.size(), "result"));
}

void prune(const BatchFolder& folder, const BatchStanding& standing) {
    for (const std::string& id : standing.foreign) {
        std::filesystem::remove_all(folder.bake(id));
        std::filesystem::remove(folder.log(id));
        std::filesystem::remove(folder.result(id));
    }
    if (!standing.foreign.empty()) say(stdout, "removed {}\n", plural(standing.foreign.size(), "result"));
}

nlohmann::ordered_json summaryOf(const BatchPlan& plan, const BatchFolder& folder,
                                 const BatchStanding& before, const LocalOutcome& outcome, double seconds) {
    return {{"name", plan.family().name}, {"scenarios", plan.scenarios().size()},
            {"done_before", before.done}, {"done", outcome.done},
            {"failed", outcome.failed},   {"left", before.open.size() - outcome.done - outcome.failed},
            {"seconds", seconds},         {"database", folder.database().string()}};
}

SlurmOptions slurmOptions(const BatchOptions& options) {
    SlurmOptions slurm = options.slurm;
    slurm.time_limit_minutes = options.time_limit_minutes;
    slurm.checkpoint_minutes = options.checkpoint_minutes;
    std::istringstream words(options.sbatch_options);
    for (std::string word; words >> word;)
        slurm.extra.push_back(word);
    return slurm;
}

/// Workers take a complete bake for theirs: what is to be made anew has to go first.
void forget(const BatchPlan& plan, const BatchFolder& folder, const std::vector<std::size_t>& scenarios) {
    for (const std::size_t index : scenarios) {
        const std::string& id = plan.scenarios()[index].id;
        std::filesystem::remove(folder.result(id));
        std::filesystem::remove_all(folder.bake(id));
    }
}

void bakeAll(const BatchOptions& options, const BatchPlan& plan, const BatchFolder& folder) {
    const InterruptGuard interrupt;
    folder.begin(plan);
    const Shard shard = shardOf(options.shard);
    BatchStanding standing =
        standingOf(plan, folder, options.again, [&](std::size_t i) { return shard.has(i); });
    if (!options.quiet && !options.json && shard.of == 1) printStanding(plan, standing);
    if (options.prune) prune(folder, standing);
    const std::size_t all_open = standing.open.size();
    keepShard(standing.open, shard);
    if (!options.collect_only) forget(plan, folder, options.again ? standing.open : standing.damaged);

    LocalOptions local = options.local;
    local.checkpoint_seconds = 60.0 * options.checkpoint_minutes;
    local.seconds_left = 60.0 * options.time_limit_minutes;
    const Clock::time_point start = Clock::now();
    LocalOutcome outcome;
    if (!options.collect_only && !standing.open.empty()) {
        const auto style = progressStyle(options.quiet, options.json);
        const std::size_t mine = shard.of == 1 ? standing.done : 0;
        BatchProgress progress(style, standing.open.size() + mine, mine);
        const auto advance = [&](std::size_t done, std::size_t failed) { progress.update(done, failed); };
        outcome = options.executor == "slurm"
                      ? runOnSlurm(plan, folder, standing, slurmOptions(options), interrupt, advance)
                      : runLocally(plan, folder, standing.open, local, interrupt, advance);
    }
    const double seconds = secondsSince(start);
    // Parts of a batch leave gathering to whoever runs the whole.
    if (shard.of == 1) collectResults(plan, folder);
    if (options.json)
        sayJson(summaryOf(plan, folder, standing, outcome, seconds));
    else if (!options.quiet)
        say(stdout, "{}: {} baked in {:.1f} s, {} failed, {} left{}\n", folder.root().string(), outcome.done,
            seconds, outcome.failed, standing.open.size() - outcome.done - outcome.failed,
            outcome.failed
                ? fmt::format(" (`throng batch query {} --failed` tells why)", folder.root().string())
                : "");
    if (outcome.signal) throw Exit(128 + outcome.signal);
    if (outcome.out_of_time) {
        say(stderr, "throng: the time is over; the same command goes on\n");
        throw Exit(kCheckpointed);
    }
    if (outcome.failed) say(stderr, "throng: {} failed\n", plural(outcome.failed, "scenario"));
    if (options.collect_only && all_open)
        say(stderr, "throng: {} not baked, or out of date\n",
            plural(all_open, "scenario is", "scenarios are"));
    if (outcome.failed || (options.collect_only && all_open)) throw Exit(kExpectationMissed);
}

/// Without -o, the name that a file gives is the name of a folder here, and leads nowhere else.
std::string folderOf(const BatchOptions& options, const std::string& name) {
    if (!options.output.empty()) return options.output;
    if (isFileName(name)) return name;
    throw InputError(options.family,
                     fmt::format("its `name`, `{}`, is no name for a folder: change it, or give one with -o",
                                 printable(name)));
}

void runBatch(const BatchOptions& options) {
    if (options.family.empty()) throw CLI::RequiredError("family");
    BatchPlan plan(options.family);
    const BatchFolder folder(folderOf(options, plan.family().name));
    if (options.worker)
        return runWorker(plan, folder,
                         {options.local.device, 60.0 * options.checkpoint_minutes, options.worker_people});
    plan.tryLayouts();
    if (!options.emit.empty()) {
        const std::size_t parts =
            options.slurm.tasks ? options.slurm.tasks : partsFor(plan.scenarios().size());
        fmt::print("{}", farmJob(options.emit, plan, options.family, folder, parts));
        return;
    }
    if (!options.dry_run) return bakeAll(options, plan, folder);
    const auto all = [](std::size_t) { return true; };
    const BatchStanding standing = standingOf(plan, folder, options.again, all);
    printStanding(plan, standing);
    printEstimate(plan, folder, standing, options.local);
}

}  // namespace

void addBatch(CLI::App& app) {
    CLI::App* command = app.add_subcommand("batch", "Bake and measure a whole family of scenarios");
    auto options = std::make_shared<BatchOptions>();
    command->add_option("family", options->family, "The family file");
    command->add_option("-o,--output", options->output, "The batch's folder; by default the family's name");
    command->add_flag("--dry-run", options->dry_run,
                      "Tell what would be done, and what it costs in time and space");
    command->add_option("--workers", options->local.workers,
                        "Processes that bake; by default as many as cores, GPUs and memory suggest");
    command->add_option("--device", options->local.device,
                        "Run on this device only (`throng devices` lists them)");
    command->add_flag("--again", options->again, "Bake everything anew, also what is done");
    command->add_flag("--prune", options->prune,
                      "Remove results of scenarios that the family does not have any more");
    command->add_flag("--collect", options->collect_only,
                      "Bake nothing, only gather what there is into the database");
    command->add_option("--shard", options->shard,
                        "I/N: only every N-th scenario, beginning with number I (from 0)");
    command
        ->add_option("--time-limit", options->time_limit_minutes,
                     "Minutes: begin nothing that would not end in time; exits with 85 if something is left")
        ->check(CLI::NonNegativeNumber);
    command
        ->add_option("--checkpoint", options->checkpoint_minutes,
                     "Minutes between checkpoints of long bakes; 0: none")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_option("--executor", options->executor, "Where to bake: local, or slurm (a job array)")
        ->check(CLI::IsMember({"local", "slurm"}))
        ->capture_default_str();
    command->add_option("--tasks", options->slurm.tasks,
                        "slurm, --emit: tasks to cut the batch into; by default one for 50 scenarios");
    command->add_option("--retries", options->slurm.retries, "slurm: submit what is left so many times more")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_option("--sbatch", options->sbatch_options,
                        "slurm: more options for sbatch, e.g. \"--partition=gpu --gpus=1\"");
    command->add_flag("!--no-wait", options->slurm.wait,
                      "slurm: submit and return; the same command later waits, mends and gathers");
    command->add_option("--emit", options->emit, "Print a job for another farm manager: openjd or flamenco")
        ->check(CLI::IsMember({"openjd", "flamenco"}));
    command->add_flag("--worker", options->worker)->group("");
    command->add_option("--people", options->worker_people)->group("");
    command->add_flag("--json", options->json,
                      "Progress as JSON lines on stderr, a summary as JSON on stdout");
    command->add_flag("-q,--quiet", options->quiet, "No progress");
    command->footer(
        "Run the same command again and only what is missing, failed or out of date is baked. Ctrl-C stops "
        "within\n"
        "seconds; each bake is complete or not there.\n\n"
        "Example:\n  throng batch examples/family-crossing.json -o crossings\n"
        "  throng batch query crossings --where \"stuck > 0\" --sort deepest_overlap_percent");
    addBatchQuery(*command);
    command->require_subcommand(0, 1);
    command->callback([options, command] {
        if (command->get_subcommands().empty()) runBatch(*options);
    });
}

}  // namespace throng::cli
