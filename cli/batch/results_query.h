// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace throng::cli {

/// What a query gives.
struct QueryResult {
    std::vector<std::string> columns;
    /// One value per column: null, whole number, number or text.
    std::vector<std::vector<nlohmann::ordered_json>> rows;

    /// Where a column is. @throws std::out_of_range when there is none
    std::size_t column(std::string_view name) const;
};

/// Runs one statement on a batch's database. It can read that file and nothing else, change nothing, and has
/// an end: in time, and in what it may hold in memory.
/// @throws InputError with what SQLite says
QueryResult queryResults(const std::filesystem::path& database, const std::string& sql);

/// What SQLite cannot understand in a statement.
struct SqlMistake {
    std::string message;      ///< as SQLite says it
    std::size_t at = kWhole;  ///< bytes from the statement's begin to what it means
    static constexpr std::size_t kWhole = ~std::size_t{0};
};

/// Looks whether a statement can be understood, without running it; nothing for one that only is not allowed.
/// @throws InputError for what is no database
std::optional<SqlMistake> mistakeIn(const std::filesystem::path& database, const std::string& sql);

/// Whether a piece of SQL is whole in itself: it does not close a bracket that it has not opened, and leaves
/// neither a bracket nor a quote nor a comment open.
bool isWholePiece(std::string_view sql);

std::string csvOf(const QueryResult& result);
/// For a terminal.
std::string tableOf(const QueryResult& result);
std::string jsonOf(const QueryResult& result);

}  // namespace throng::cli
