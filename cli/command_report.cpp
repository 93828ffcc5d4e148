// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <future>
#include <memory>
#include <stdexcept>

#include "analysis/report/bake_report.h"
#include "analysis/report/page.h"
#include "base/files/output_file.h"
#include "base/numbers.h"
#include "base/palette.h"
#include "base/side_by_side.h"
#include "cli/baking/judge.h"
#include "cli/batch/batch_plan.h"
#include "cli/batch/results_query.h"
#include "cli/commands.h"
#include "cli/terminal/say.h"

namespace throng::cli {
namespace fs = std::filesystem;
namespace {

using nlohmann::ordered_json;

struct ReportOptions {
    std::string input;
    std::string output;
    bool each = false;
    bool json = false;
};

std::string pageOf(const fs::path& folder) {
    io::CrowdReader crowd(io::loadBake(folder)), played(crowd.bake());
    auto frames = std::async(kInAThread, [&] { return analysis::framesOfReport(played); });
    const auto [measured, missed] = judgeBake(crowd, {});
    return analysis::bakeReport(crowd, frames.get(), measured, missed);
}

std::string keyed(const QueryResult& about, const std::string& key) {
    for (const auto& row : about.rows)
        if (row[0] == key && row[1].is_string()) return row[1].get<std::string>();
    return {};
}

/// The results of a batch, whose database may come from anywhere.
struct Results {
    fs::path database;
    QueryResult table, about;
    std::size_t figures = 0;  ///< columns of the table before the parameters

    explicit Results(const fs::path& folder)
        : database(folder / "results.sqlite"),
          table(queryResults(database, "SELECT * FROM results ORDER BY number")),
          about(queryResults(database, "SELECT key, value FROM batch")),
          figures(queryResults(database, "SELECT * FROM scenarios LIMIT 0").columns.size()) {
        if (figures > table.columns.size())
            throw InputError(database, "is no batch's: `results` has fewer columns than `scenarios`");
    }
    std::size_t column(const char* name) const try {
        return table.column(name);
    } catch (const std::out_of_range& error) {
        throw InputError(database, error.what());
    }
    /// The scenario of a row. Pages and bakes have its name: no other than ours makes one.
    std::string id(const std::vector<ordered_json>& row) const {
        const ordered_json& value = row[column("id")];
        if (!value.is_string() || !isScenarioId(value.get<std::string>()))
            throw InputError(database, "holds a scenario whose `id` is not one that a batch makes");
        return value.get<std::string>();
    }
};

/// Bakes that are damaged have no picture; the page is about the others, too.
ordered_json thumbnailOrNull(const fs::path& bake) try {
    io::CrowdReader crowd(io::loadBake(bake));
    return analysis::thumbnailOf(crowd);
} catch (const InputError&) {
    return nullptr;
}

void reportBatch(const fs::path& folder, const fs::path& output, bool each) {
    const Results results(folder);
    const QueryResult& table = results.table;
    const std::size_t bake = results.column("bake");
    ordered_json data;
    for (const char* key : {"name", "base", "version"})
        data[key] = keyed(results.about, key);
    data["columns"] = table.columns;
    data["parameters"] = std::vector<std::string>(
        table.columns.begin() + static_cast<std::ptrdiff_t>(results.figures), table.columns.end());
    data["rows"] = table.rows;
    data["colours"] = ordered_json::array();
    for (const Colour& colour : kGroupColours)
        data["colours"].push_back(fmt::format("rgb({:.0f} {:.0f} {:.0f})", 255 * colour.red,
                                              255 * colour.green, 255 * colour.blue));
    const fs::path beside = fs::absolute(output).parent_path();
    const auto relative = [&](const fs::path& path) {
        return fs::relative(path, beside).generic_string() + "/";
    };
    data["folder"] = relative(folder);
    const fs::path pages = folder / "reports";
    if (each) {
        makeFolder(pages);
        data["pages"] = relative(pages);
    }
    data["thumbnails"] = ordered_json::object();
    for (const auto& row : table.rows) {
        const std::string name = results.id(row);
        if (row[bake].is_null()) continue;
        const fs::path path = folder / "bakes" / name;
        data["thumbnails"][name] = thumbnailOrNull(path);
        if (each) replaceFile(pages / (name + ".html"), pageOf(path));
    }
    replaceFile(output, analysis::makePage("batch", keyed(results.about, "name"), data));
}

void runReport(const ReportOptions& options) {
    const fs::path input = fs::path(options.input).filename() == "bake.json"
                               ? fs::path(options.input).parent_path()
                               : fs::path(options.input);
    const bool is_batch = fs::exists(input / "results.sqlite");
    const fs::path whole = fs::absolute(input).lexically_normal();
    const std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
    const fs::path output = !options.output.empty() ? fs::path(options.output)
                            : is_batch              ? input / "report.html"
                                                    : fs::path(name + ".html");
    if (is_batch)
        reportBatch(input, output, options.each);
    else
        replaceFile(output, pageOf(input));
    if (options.json)
        sayJson({{"output", output.string()},
                 {"of", is_batch ? "batch" : "bake"},
                 {"bytes", fs::file_size(output)}});
    else
        say(stdout, "{}: {}\n", output.string(), readableBytes(fs::file_size(output)));
}

}  // namespace

void addReport(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("report", "Write a page to look at a bake or a batch in a browser");
    auto options = std::make_shared<ReportOptions>();
    command->add_option("input", options->input, "A bake's folder, or a batch's")->required();
    command->add_option("-o,--output", options->output,
                        "The page; by default NAME.html, or report.html in a batch's folder");
    command->add_flag("--each", options->each,
                      "Of a batch: also a page for every bake, linked from the table");
    command->add_flag("--json", options->json, "Print a JSON document");
    command->footer(
        "One file that needs no network: send it, keep it, print it.\n\n"
        "Example:\n  throng report bakes/intersection -o intersection.html");
    command->callback([options] { runReport(*options); });
}

}  // namespace throng::cli
