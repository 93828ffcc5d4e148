// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/numbers.h"
#include "cli/batch/batch_plan.h"
#include "cli/batch/results_query.h"
#include "cli/commands.h"
#include "cli/terminal/exit_codes.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/say.h"
#include "io/verify_bake.h"

namespace throng::cli {
namespace fs = std::filesystem;
namespace {

using nlohmann::ordered_json;

struct VerifyOptions {
    std::string input;
    bool json = false;
    bool quiet = false;
};

enum class Outcome { whole, no_checksums, damaged };

const char* nameOf(Outcome outcome) {
    return outcome == Outcome::whole ? "whole" : outcome == Outcome::damaged ? "damaged" : "no checksums";
}

Outcome outcomeOf(const io::Verification& found) {
    return found.isWhole() ? Outcome::whole : found.has_checksums ? Outcome::damaged : Outcome::no_checksums;
}

/// Tells how far the reading is, through all bakes of a batch.
class VerifyLine {
  public:
    VerifyLine(ProgressStyle style, std::size_t bakes) : line_(style), bakes_(bakes) {}

    io::VerifyProgress ofBake(std::size_t index) {
        return [this, index](std::uint64_t read, std::uint64_t of) {
            const double part = of ? static_cast<double>(read) / static_cast<double>(of) : 1.0;
            const double percent = 100.0 * (static_cast<double>(index) + part) / static_cast<double>(bakes_);
            // What is over in a moment needs no line.
            if (line_.style() == ProgressStyle::plain && line_.elapsed() < 5.0) return;
            if (!line_.isDue(percent)) return;
            const double left = line_.elapsed() * (100.0 - percent) / std::max(percent, 1.0e-3);
            line_.write(
                fmt::format("\"progress\": {:.1f}, \"bake\": {}, \"bakes\": {}, \"eta_seconds\": {:.1f}",
                            percent, index + 1, bakes_, left),
                fmt::format("{:3.0f} %  bake {} of {}  {} left", percent, index + 1, bakes_, timeText(left)));
        };
    }

  private:
    StatusLine line_;
    std::size_t bakes_;
};

ordered_json problemsJson(const io::Verification& found) {
    ordered_json list = ordered_json::array();
    for (const io::BakeProblem& problem : found.problems)
        list.push_back(
            {{"path", problem.path}, {"kind", io::nameOf(problem.kind)}, {"message", problem.message}});
    return list;
}

ordered_json jsonOf(const fs::path& bake, const io::Verification& found) {
    return {{"path", bake.string()},
            {"outcome", nameOf(outcomeOf(found))},
            {"files", found.files},
            {"bytes", found.bytes},
            {"problems", problemsJson(found)}};
}

constexpr const char* kNoChecksums =
    "bake.json lists no checksums, as bakes of an early version: nothing can be said of its files";

/// A line for each thing that is wrong.
void tellProblems(const fs::path& bake, const io::Verification& found) {
    if (!found.has_checksums) say(stderr, "{}: {}\n", bake.string(), kNoChecksums);
    for (const io::BakeProblem& problem : found.problems)
        say(stderr, "{}: {}\n", (bake / problem.path).string(), problem.message);
}

Outcome verifyOne(const VerifyOptions& options, ProgressStyle style) {
    const fs::path given(options.input);
    const fs::path bake = given.filename() == "bake.json"
                              ? (given.has_parent_path() ? given.parent_path() : fs::path("."))
                              : given;
    if (!fs::is_directory(bake)) throw InputError(bake, "is no bake's folder, and no batch's");
    const io::Verification found = [&] {
        VerifyLine line(style, 1);
        return io::verifyBake(bake, line.ofBake(0));
    }();
    if (options.json) {
        sayJson(jsonOf(bake, found));
    } else {
        tellProblems(bake, found);
        if (found.isWhole())
            say(stdout, "{}: all {} files ({}) are as they were written\n", bake.string(), found.files,
                readableBytes(found.bytes));
    }
    return outcomeOf(found);
}

/// The bakes that a batch's database says are there, and how many scenarios have none.
struct BatchList {
    std::vector<std::string> ids;
    std::size_t not_baked = 0;
};

BatchList bakesOf(const fs::path& database) {
    BatchList list;
    for (const auto& row :
         queryResults(database, "SELECT id, status, bake FROM scenarios ORDER BY number").rows) {
        if (row[2].is_null()) {
            list.not_baked += row[1] != "ok";
        } else {
            if (!row[0].is_string() || !isScenarioId(row[0].get<std::string>()))
                throw InputError(database, "holds a scenario whose `id` is not one that a batch makes");
            list.ids.push_back(row[0].get<std::string>());
        }
    }
    return list;
}

/// What came of all bakes of a batch.
struct BatchTotals {
    std::size_t whole = 0, damaged = 0, no_checksums = 0, missing = 0, files = 0;
    std::uint64_t bytes = 0;

    Outcome outcome() const {
        return damaged + missing ? Outcome::damaged : no_checksums ? Outcome::no_checksums : Outcome::whole;
    }
};

void count(BatchTotals& totals, const io::Verification& found) {
    const Outcome outcome = outcomeOf(found);
    ++(outcome == Outcome::whole     ? totals.whole
       : outcome == Outcome::damaged ? totals.damaged
                                     : totals.no_checksums);
    totals.files += found.files;
    totals.bytes += found.bytes;
}

ordered_json totalsJson(const BatchTotals& totals, const BatchList& list) {
    return {{"outcome", nameOf(totals.outcome())},
            {"whole", totals.whole},
            {"damaged", totals.damaged},
            {"no_checksums", totals.no_checksums},
            {"missing", totals.missing},
            {"not_baked", list.not_baked},
            {"files", totals.files},
            {"bytes", totals.bytes}};
}

std::string totalsText(const BatchTotals& totals, const BatchList& list) {
    std::string text = fmt::format("{} of {} bakes are whole ({} files, {})", totals.whole, list.ids.size(),
                                   totals.files, readableBytes(totals.bytes));
    for (const auto& [number, words] : {std::pair{totals.damaged, "damaged"},
                                        {totals.missing, "missing"},
                                        {totals.no_checksums, "without checksums"}})
        if (number) text += fmt::format(", {} {}", number, words);
    if (list.not_baked) text += fmt::format("; scenarios without a bake: {}", list.not_baked);
    return text;
}

Outcome verifyBatch(const VerifyOptions& options, ProgressStyle style) {
    const fs::path root(options.input);
    const BatchList list = bakesOf(root / "results.sqlite");
    BatchTotals totals;
    ordered_json bakes = ordered_json::array();
    {
        VerifyLine line(style, std::max<std::size_t>(list.ids.size(), 1));
        for (std::size_t i = 0; i < list.ids.size(); ++i) {
            const fs::path bake = root / "bakes" / list.ids[i];
            std::error_code unknown;
            if (!fs::is_directory(bake, unknown)) {
                ++totals.missing;
                bakes.push_back({{"path", bake.string()}, {"outcome", "missing"}});
                if (!options.json) say(stderr, "{}: missing\n", bake.string());
                continue;
            }
            const io::Verification found = io::verifyBake(bake, line.ofBake(i));
            count(totals, found);
            bakes.push_back(jsonOf(bake, found));
            if (!options.json) tellProblems(bake, found);
        }
    }
    if (options.json) {
        ordered_json document = totalsJson(totals, list);
        document["bakes"] = std::move(bakes);
        sayJson(document);
    } else {
        say(stdout, "{}: {}\n", root.string(), totalsText(totals, list));
    }
    return totals.outcome();
}

void runVerify(const VerifyOptions& options) {
    const ProgressStyle style = progressStyle(options.quiet, options.json);
    const bool is_batch = fs::exists(fs::path(options.input) / "results.sqlite");
    const Outcome outcome = is_batch ? verifyBatch(options, style) : verifyOne(options, style);
    if (outcome == Outcome::damaged) throw Exit(kInvalidInput);
    if (outcome == Outcome::no_checksums) throw Exit(kExpectationMissed);
}

}  // namespace

void addVerify(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "verify", "Compare every file of a bake, or of a batch's bakes, with its checksum");
    auto options = std::make_shared<VerifyOptions>();
    command->add_option("input", options->input, "A bake's folder or its bake.json, or a batch's folder")
        ->required();
    command->add_flag("--json", options->json,
                      "Progress as JSON lines on stderr, the result as a JSON document on stdout");
    command->add_flag("-q,--quiet", options->quiet, "No progress");
    command->footer(
        "Exits with 0 when every file is there and as it was written and no other file is in the folder, "
        "with 3\n"
        "when something is wrong, and with 1 when the bake is of a version that listed no checksums.\n\n"
        "Example:\n  throng verify bakes/intersection");
    command->callback([options] { runVerify(*options); });
}

}  // namespace throng::cli
