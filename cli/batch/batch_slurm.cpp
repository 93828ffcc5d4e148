// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/batch_slurm.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "base/files/errors.h"
#include "base/files/input_file.h"
#include "base/files/output_file.h"
#include "base/process.h"
#include "base/text/printable.h"
#include "cli/batch/farm_job.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace fs = std::filesystem;
namespace {

/// A word as the shell takes it, whatever is in it.
std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char letter : word)
        text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return text + "'";
}

std::string thisProgram() {
    return fs::read_symlink("/proc/self/exe").string();
}

ProgramRun runSlurm(const std::vector<std::string>& words) try {
    return runProgram(words);
} catch (const std::system_error& error) {
    if (error.code() != std::errc::no_such_file_or_directory) throw;
    throw InputError(words.front(), "is not there: --executor slurm needs Slurm's commands on this machine");
}

class Array {
  public:
    Array(const BatchPlan& plan, const BatchFolder& folder, const SlurmOptions& options)
        : plan_(plan), root_(fs::absolute(folder.root())), options_(options), folder_(root_ / "slurm") {
        makeFolder(folder_);
    }

    /// The array of an earlier run, if it is still in the queue.
    bool findEarlier() {
        const fs::path file = folder_ / "job";
        if (!fs::exists(file)) return false;
        job_ = readFile(file);
        return isInQueue();
    }

    void submit(std::size_t scenarios) {
        const std::size_t tasks =
            std::clamp<std::size_t>(options_.tasks ? options_.tasks : partsFor(scenarios), 1, scenarios);
        const fs::path script = folder_ / "job.sh";
        replaceFile(script, scriptText(tasks));
        std::vector<std::string> words = {"sbatch", "--parsable"};
        words.insert(words.end(), options_.extra.begin(), options_.extra.end());
        words.push_back(script.string());
        const ProgramRun answer = runSlurm(words);
        if (!answer.end.isGood())
            throw InputError("sbatch", answer.errors.empty() ? "failed" : answer.errors);
        job_ = answer.output.substr(0, answer.output.find_first_of(";\n"));
        replaceFile(folder_ / "job", job_);
    }

    bool isInQueue() const {
        const ProgramRun answer = runSlurm({"squeue", "-h", "-j", job_, "-o", "%T"});
        // A controller that is away for a moment is no reason to submit everything again.
        if (!answer.end.isGood()) return answer.errors.find("Invalid job id") == std::string::npos;
        return !answer.output.empty();
    }

    void cancel() const { runSlurm({"scancel", job_}); }
    const std::string& job() const { return job_; }

  private:
    std::string scriptText(std::size_t tasks) const {
        if (printable(root_.string()) != root_.string())  // a line of the script would end in it
            throw OutputError(root_, "a job script cannot name a folder with control characters");
        std::string text = fmt::format(
            "#!/bin/sh\n"
            "#SBATCH --job-name={}\n"
            "#SBATCH --array=0-{}\n"
            "#SBATCH --output={}\n"
            "#SBATCH --open-mode=append\n"
            "#SBATCH --requeue\n",
            quoted(jobName(plan_.family().name)), tasks - 1, quoted((folder_ / "%A_%a.log").string()));
        std::string limit;
        if (options_.time_limit_minutes > 0.0) {
            // Slurm ends tasks at their limit; ours begin nothing that would not be over before.
            constexpr double kReserve = 0.5;  // min, to write a checkpoint in
            text += fmt::format("#SBATCH --time={}\n#SBATCH --signal=B:TERM@20\n",
                                static_cast<long>(std::ceil(options_.time_limit_minutes)));
            limit =
                fmt::format(" --time-limit {:.3f}", std::max(0.1, options_.time_limit_minutes - kReserve));
        }
        // exec: signals for the task reach the program itself.
        return text + fmt::format(
                          "exec {} batch {} -o {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --workers 1 "
                          "--checkpoint {:.3f}{} -q\n",
                          quoted(thisProgram()), quoted((root_ / "family.json").string()),
                          quoted(root_.string()), tasks, options_.checkpoint_minutes, limit);
    }

    const BatchPlan& plan_;
    fs::path root_;
    const SlurmOptions& options_;
    fs::path folder_;
    std::string job_;
};

/// Counts the scenarios that have got a result since, and takes them out of those that are waited for.
void countResults(const BatchPlan& plan, const BatchFolder& folder, std::vector<std::size_t>& waiting,
                  LocalOutcome& outcome) {
    std::erase_if(waiting, [&](std::size_t index) {
        const auto result = folder.readResult(plan.scenarios()[index].id);
        if (result) ++(result->at("status") == "ok" ? outcome.done : outcome.failed);
        return result.has_value();
    });
}

}  // namespace

LocalOutcome runOnSlurm(const BatchPlan& plan, const BatchFolder& folder, const BatchStanding& standing,
                        const SlurmOptions& options, const InterruptGuard& interrupt,
                        const std::function<void(std::size_t, std::size_t)>& advance) {
    Array array(plan, folder, options);
    const bool joins = array.findEarlier();
    if (!joins)  // whatever is there of the open ones is of no worth: only what comes counts
        for (const std::size_t index : standing.open)
            fs::remove(folder.result(plan.scenarios()[index].id));
    LocalOutcome outcome;
    std::vector<std::size_t> waiting = standing.open;
    for (int attempt = 0; attempt <= options.retries; ++attempt) {
        if (waiting.empty()) break;
        if (attempt > 0 || !joins) array.submit(waiting.size());
        say(stderr, "slurm: job {} {}\n", array.job(),
            attempt == 0 && joins ? "is under way"
                                  : fmt::format("submitted for {} scenarios", waiting.size()));
        if (!options.wait) break;
        bool in_queue = true;
        while (in_queue && !interrupt.signal()) {
            for (int i = 0; i < 20 && !interrupt.signal(); ++i)
                std::this_thread::sleep_for(std::chrono::milliseconds(100));
            in_queue = array.isInQueue();
            countResults(plan, folder, waiting, outcome);
            advance(outcome.done, outcome.failed);
        }
        if (!interrupt.signal()) continue;
        array.cancel();
        outcome.signal = interrupt.signal();
        break;
    }
    outcome.out_of_time = !outcome.signal && !waiting.empty();
    return outcome;
}

}  // namespace throng::cli
