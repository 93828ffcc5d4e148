// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/results_query.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <stdexcept>

#include "base/files/csv.h"
#include "base/files/input_file.h"
#include "base/numbers.h"
#include "base/stopwatch.h"
#include "base/text/printable.h"

namespace throng::cli {
namespace fs = std::filesystem;
namespace {

using nlohmann::ordered_json;

constexpr int kLongestValue = 16 << 20;           // bytes of one value, and of what makes it
constexpr std::uint64_t kLeastBytes = 48u << 20;  // of what comes out, whatever the database's size
constexpr std::int64_t kMostHeap = 128ll << 20;   // bytes that SQLite itself may hold
constexpr double kLeastSeconds = 8.0, kBytesPerSecond = 4.0e6;
constexpr int kOperations = 10'000;  // of SQLite's machine, between two looks at the clock

int allowOnlyReading(void*, int action, const char*, const char* second, const char*, const char*) {
    const bool reads = action == SQLITE_SELECT || action == SQLITE_READ || action == SQLITE_RECURSIVE;
    const bool calls =
        action == SQLITE_FUNCTION && std::string_view(second ? second : "") != "load_extension";
    return reads || calls ? SQLITE_OK : SQLITE_DENY;
}

struct Deadline {
    Clock::time_point begun = Clock::now();
    double seconds;
    bool is_over = false;
    static int look(void* context) {
        auto& deadline = *static_cast<Deadline*>(context);
        deadline.is_over = secondsSince(deadline.begun) > deadline.seconds;
        return deadline.is_over;
    }
};

/// A database that may come from anywhere, and what one may ask it.
void confine(sqlite3* handle, Deadline& deadline) {
    sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kLongestValue);
    sqlite3_limit(handle, SQLITE_LIMIT_SQL_LENGTH, 1 << 20);
    sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 0);  // VACUUM INTO attaches what it writes
    sqlite3_limit(handle, SQLITE_LIMIT_EXPR_DEPTH, 200);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_hard_heap_limit64(kMostHeap);
    sqlite3_progress_handler(handle, kOperations, Deadline::look, &deadline);
    sqlite3_set_authorizer(handle, allowOnlyReading, nullptr);
}

ordered_json valueOf(const SQLite::Column& column) {
    if (column.isNull()) return nullptr;
    if (column.isInteger()) return column.getInt64();
    if (column.isFloat()) return column.getDouble();
    return column.getString();
}

QueryResult fetch(SQLite::Statement& statement, const fs::path& path, std::uint64_t most_bytes) {
    QueryResult result;
    for (int column = 0; column < statement.getColumnCount(); ++column)
        result.columns.emplace_back(statement.getColumnName(column));
    std::uint64_t bytes = 0;
    while (statement.executeStep()) {
        std::vector<ordered_json>& row = result.rows.emplace_back();
        row.reserve(result.columns.size());
        for (int column = 0; column < statement.getColumnCount(); ++column) {
            const SQLite::Column value = statement.getColumn(column);
            bytes += sizeof(ordered_json) + static_cast<std::uint64_t>(value.getBytes());
            if (bytes > most_bytes)
                throw InputError(
                    path, fmt::format("the answer is larger than {}: ask for less (--limit, --columns)",
                                      readableBytes(most_bytes)));
            row.push_back(valueOf(value));
        }
    }
    return result;
}

std::string plainText(const ordered_json& value) {
    if (value.is_null()) return "";
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string textOf(const ordered_json& value) {
    return value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump();
}

/// A value in a table's cell.
std::string cellOf(const std::string& text) {
    constexpr std::size_t kWidest = 60;
    if (text.size() <= kWidest) return printable(text);
    std::size_t end = kWidest - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u)
        --end;  // no character is cut in two
    return printable(text.substr(0, end)) + "...";
}

}  // namespace

std::size_t QueryResult::column(std::string_view name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) throw std::out_of_range(fmt::format("there is no column `{}`", name));
    return static_cast<std::size_t>(found - columns.begin());
}

QueryResult queryResults(const fs::path& database_path, const std::string& sql) {
    const std::uint64_t size = InputFile(database_path).size();  // and a regular file
    Deadline deadline{.seconds = kLeastSeconds + static_cast<double>(size) / kBytesPerSecond};
    try {
        SQLite::Database database(database_path, SQLite::OPEN_READONLY);
        confine(database.getHandle(), deadline);
        SQLite::Statement statement(database, sql);
        return fetch(statement, database_path, kLeastBytes + 2 * size);
    } catch (const SQLite::Exception& error) {
        if (deadline.is_over)
            throw InputError(database_path,
                             fmt::format("the question takes more than {:.0f} s", deadline.seconds));
        if (error.getErrorCode() == SQLITE_AUTH)
            throw InputError(database_path,
                             "a query only reads: nothing else can be asked of a batch's database");
        throw InputError(database_path, error.what());
    }
}

std::optional<SqlMistake> mistakeIn(const fs::path& database_path, const std::string& sql) {
    Deadline deadline{.seconds = kLeastSeconds};
    static_cast<void>(InputFile(database_path));  // a regular file
    std::optional<SQLite::Database> database;
    try {
        database.emplace(database_path, SQLite::OPEN_READONLY);
        confine(database->getHandle(), deadline);
        const SQLite::Statement statement(*database, sql);
    } catch (const SQLite::Exception& error) {
        if (!database || (error.getErrorCode() != SQLITE_ERROR && error.getErrorCode() != SQLITE_AUTH))
            throw InputError(database_path, error.what());
        if (error.getErrorCode() == SQLITE_AUTH) return std::nullopt;
        const int at = sqlite3_error_offset(database->getHandle());
        return SqlMistake{error.what(), at < 0 ? SqlMistake::kWhole : static_cast<std::size_t>(at)};
    }
    return std::nullopt;
}

bool isWholePiece(std::string_view sql) {
    int open = 0;
    for (std::size_t i = 0; i < sql.size(); ++i) {
        const char c = sql[i];
        const std::string_view two = sql.substr(i, 2);
        if (c == '\'' || c == '"' || c == '`' || c == '[') {
            i = sql.find(c == '[' ? ']' : c, i + 1);  // a doubled quote ends one text and begins the next
            if (i == std::string_view::npos) return false;
        } else if (two == "--") {
            i = std::min(sql.find('\n', i), sql.size());
        } else if (two == "/*") {
            i = sql.find("*/", i + 2);
            if (i == std::string_view::npos) return false;
            ++i;
        } else if (c == '(') {
            ++open;
        } else if (c == ';' || (c == ')' && --open < 0)) {
            return false;
        }
    }
    return open == 0;
}

std::string csvOf(const QueryResult& result) {
    std::string text;
    for (std::size_t column = 0; column < result.columns.size(); ++column)
        text += (column ? "," : "") + csvField(result.columns[column]);
    text += "\n";
    for (const auto& row : result.rows) {
        for (std::size_t column = 0; column < row.size(); ++column)
            text += (column ? "," : "") + csvField(textOf(row[column]));
        text += "\n";
    }
    return text;
}

std::string tableOf(const QueryResult& result) {
    std::vector<std::vector<std::string>> lines(1);
    for (const std::string& name : result.columns)
        lines.back().push_back(cellOf(name));
    for (const auto& row : result.rows) {
        lines.emplace_back();
        for (const ordered_json& value : row)
            lines.back().push_back(cellOf(plainText(value)));
    }
    std::vector<std::size_t> widths(result.columns.size());
    for (const auto& line : lines)
        for (std::size_t column = 0; column < line.size(); ++column)
            widths[column] = std::max(widths[column], line[column].size());
    std::string text;
    for (const auto& line : lines) {
        std::string row;
        for (std::size_t column = 0; column < line.size(); ++column)
            row += fmt::format("{:<{}}  ", line[column], widths[column]);
        row.erase(row.find_last_not_of(' ') + 1);
        text += row + "\n";
    }
    return text;
}

std::string jsonOf(const QueryResult& result) {
    ordered_json list = ordered_json::array();
    for (const auto& row : result.rows) {
        ordered_json object = ordered_json::object();
        for (std::size_t column = 0; column < row.size(); ++column)
            object[result.columns[column]] = row[column];
        list.push_back(std::move(object));
    }
    return list.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace throng::cli
