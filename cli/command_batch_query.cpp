// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <string_view>
#include <utility>

#include "authoring/layout/words.h"
#include "base/files/output_file.h"
#include "base/text/printable.h"
#include "cli/batch/results_database.h"
#include "cli/batch/results_query.h"
#include "cli/commands.h"

namespace throng::cli {
namespace {

struct BatchQueryOptions {
    std::string batch;
    std::string columns, where, sort, sql, output;
    std::size_t limit = 0;
    bool descending = false;
    bool failed = false;
    bool json = false;
    bool csv = false;
};

/// What fits a terminal: the parameters and the figures that one looks at first.
std::string usualColumns(const std::filesystem::path& database) {
    // Beside what they are asked for, `results` has the figures' names first and the parameters' after them.
    const auto namesOf = [&](const char* table) {
        return queryResults(database, fmt::format("SELECT * FROM {} LIMIT 0", table)).columns;
    };
    std::string columns = "number, id, status";
    const std::vector<std::string> all = namesOf("results");
    for (std::size_t i = namesOf("scenarios").size(); i < all.size(); ++i)
        columns += ", " + quotedName(all[i]);
    return columns + ", agents, arrived, stuck, deepest_overlap_percent, mean_speed, total_seconds";
}

/// What is wrong with a piece, in the words of whoever wrote it.
std::string explained(const SqlMistake& mistake, const std::string& sql, std::size_t begin,
                      const std::filesystem::path& database) {
    constexpr std::string_view kNoColumn = "no such column: ";
    if (mistake.message.starts_with(kNoColumn)) {
        const std::string name = mistake.message.substr(kNoColumn.size());
        return fmt::format(
            "in `{}`: there is no column `{}`; {}{}", sql, name,
            authoring::hintFor(name, queryResults(database, "SELECT * FROM results LIMIT 0").columns),
            name.find_first_of(". ") == std::string::npos ? fmt::format(", or the text '{}'?", name) : "");
    }
    const bool ends_early = mistake.message == "incomplete input" ||
                            (mistake.at != SqlMistake::kWhole && mistake.at >= begin + sql.size());
    if (ends_early) return fmt::format("`{}` ends where something is missing", sql);
    return fmt::format("in `{}`: {}", sql, mistake.message);
}

/// Pieces of SQL from the command line end with a line of their own, so that a comment in one ends with it.
/// @param around what asks for nothing but the piece, which comes between the two
std::string piece(const char* option, const std::string& sql, const std::filesystem::path& database,
                  std::pair<std::string, std::string> around) {
    if (!isWholePiece(sql))
        throw CLI::ValidationError(option,
                                   fmt::format("in `{}`, a bracket, quote or comment has no other end", sql));
    if (const auto mistake = mistakeIn(database, around.first + sql + "\n" + around.second))
        throw CLI::ValidationError(option, explained(*mistake, sql, around.first.size(), database));
    return sql + "\n";
}

std::string sqlOf(const BatchQueryOptions& options, const std::filesystem::path& database) {
    if (!options.sql.empty()) return options.sql;
    const auto given = [&](const char* option, const std::string& sql, const char* before,
                           const char* after) {
        return piece(option, sql, database, {before, after});
    };
    std::string columns = options.columns.empty()
                              ? usualColumns(database)
                              : given("--columns", options.columns, "SELECT ", "FROM results");
    std::string from = "results";
    std::string where =
        options.where.empty()
            ? ""
            : "(" + given("--where", options.where, "SELECT NULL FROM results WHERE (", ")") + ")";
    if (options.failed) {
        columns = "number, id, reason, log";
        from = "scenarios";
        where += (where.empty() ? "" : " AND ") + std::string("status = 'failed'");
    }
    std::string sql = fmt::format("SELECT {} FROM {}", columns, from);
    if (!where.empty()) sql += " WHERE " + where;
    sql += " ORDER BY " +
           (options.sort.empty() ? "number"
                                 : given("--sort", options.sort, "SELECT * FROM results ORDER BY ", "")) +
           (options.descending ? " DESC" : "");
    return options.limit ? sql + fmt::format(" LIMIT {}", options.limit) : sql;
}

void runBatchQuery(const BatchQueryOptions& options) {
    const std::filesystem::path given(options.batch);
    const std::filesystem::path database =
        std::filesystem::is_directory(given) ? given / "results.sqlite" : given;
    const QueryResult result = queryResults(database, sqlOf(options, database));
    const bool as_csv = options.csv || options.output.ends_with(".csv");
    const std::string text = options.json ? jsonOf(result) : as_csv ? csvOf(result) : tableOf(result);
    if (options.output.empty())
        fmt::print("{}", text);
    else
        replaceFile(options.output, text);
}

}  // namespace

void addBatchQuery(CLI::App& batch) {
    CLI::App* command = batch.add_subcommand("query", "Ask a batch's database");
    auto options = std::make_shared<BatchQueryOptions>();
    command->add_option("batch", options->batch, "The batch's folder, or its results.sqlite")->required();
    command->add_option("--where", options->where, "Only scenarios for which this holds, in SQL");
    command->add_option("--columns", options->columns,
                        "What to tell, e.g. \"id, rate, arrived * 1.0 / agents\"; * for all");
    command->add_option("--sort", options->sort, "By this column");
    command->add_flag("--descending", options->descending, "Largest first");
    command->add_option("--limit", options->limit, "At most so many");
    command->add_flag("--failed", options->failed, "What failed and why");
    command->add_option("--sql", options->sql, "A whole statement instead (docs/batch.md has the tables)");
    command->add_flag("--json", options->json, "As JSON");
    command->add_flag("--csv", options->csv, "As CSV");
    command->add_option("-o,--output", options->output, "Into this file; .csv means CSV");
    command->footer(
        "Example:\n  throng batch query crossings --where \"arrived < agents\" --sort rate --csv");
    command->callback([options] { runBatchQuery(*options); });
}

}  // namespace throng::cli
