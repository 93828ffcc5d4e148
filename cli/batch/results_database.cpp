// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/results_database.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>

#include "base/files/csv.h"
#include "base/files/errors.h"
#include "base/files/output_file.h"

namespace throng::cli {
namespace fs = std::filesystem;
namespace {

using nlohmann::ordered_json;

/// A connection; errors come out as exceptions with what SQLite says.
class Connection {
  public:
    Connection(fs::path path, int flags) : path_(std::move(path)) {
        if (sqlite3_open_v2(path_.c_str(), &handle_, flags, nullptr) != SQLITE_OK) {
            const std::string reason = sqlite3_errmsg(handle_);
            sqlite3_close(handle_);
            throw InputError(path_, reason);
        }
    }
    ~Connection() { sqlite3_close(handle_); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void execute(const std::string& sql) {
        if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
    }
    [[noreturn]] void fail() const { throw InputError(path_, sqlite3_errmsg(handle_)); }
    sqlite3* handle() const { return handle_; }

  private:
    fs::path path_;
    sqlite3* handle_ = nullptr;
};

class Statement {
  public:
    Statement(Connection& connection, const std::string& sql) : connection_(connection) {
        if (sqlite3_prepare_v2(connection.handle(), sql.c_str(), -1, &handle_, nullptr) != SQLITE_OK)
            connection.fail();
    }
    ~Statement() { sqlite3_finalize(handle_); }
    Statement(const Statement&) = delete;
    Statement& operator=(const Statement&) = delete;

    void bind(int place, const ordered_json& value) {
        int status = SQLITE_OK;
        if (value.is_null())
            status = sqlite3_bind_null(handle_, place);
        else if (value.is_boolean())
            status = sqlite3_bind_int(handle_, place, value.get<bool>() ? 1 : 0);
        else if (value.is_number_integer())
            status = sqlite3_bind_int64(handle_, place, value.get<std::int64_t>());
        else if (value.is_number())
            status = sqlite3_bind_double(handle_, place, value.get<double>());
        else {
            const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
            status = sqlite3_bind_text(handle_, place, text.data(), static_cast<int>(text.size()),
                                       SQLITE_TRANSIENT);
        }
        if (status != SQLITE_OK) connection_.fail();
    }
    bool step() {
        const int status = sqlite3_step(handle_);
        if (status != SQLITE_ROW && status != SQLITE_DONE) connection_.fail();
        return status == SQLITE_ROW;
    }
    void reset() { sqlite3_reset(handle_); }
    sqlite3_stmt* handle() const { return handle_; }

  private:
    Connection& connection_;
    sqlite3_stmt* handle_ = nullptr;
};

/// A column of the table `scenarios` and where its value is in a result.
struct Column {
    const char* name;
    const char* type;
    const char* pointer;
};

constexpr Column kColumns[] = {
    {"status", "TEXT", "/status"},
    {"reason", "TEXT", "/reason"},
    {"missed", "TEXT", "/missed"},
    {"agents", "INTEGER", "/metrics/agents"},
    {"arrived", "INTEGER", "/metrics/arrived"},
    {"walking", "INTEGER", "/metrics/walking"},
    {"refused", "INTEGER", "/metrics/refused"},
    {"stuck", "INTEGER", "/metrics/stuck"},
    {"seconds", "REAL", "/metrics/seconds"},
    {"duration", "REAL", "/metrics/duration"},
    {"overlapping_percent", "REAL", "/metrics/overlapping_percent"},
    {"worst_overlapping_percent", "REAL", "/metrics/worst_overlapping_percent"},
    {"deepest_overlap_percent", "REAL", "/metrics/deepest_overlap_percent"},
    {"wall_crossings", "INTEGER", "/metrics/wall_crossings"},
    {"deepest_wall_penetration", "REAL", "/metrics/deepest_wall_penetration"},
    {"time_ratio", "REAL", "/metrics/time_ratio"},
    {"detour_ratio", "REAL", "/metrics/detour_ratio"},
    {"heading_rate_p99", "REAL", "/metrics/heading_rate/p99"},
    {"acceleration_p99", "REAL", "/metrics/acceleration/p99"},
    {"jerk_p99", "REAL", "/metrics/jerk/p99"},
    {"backward_percent", "REAL", "/metrics/backward_percent"},
    {"effort", "REAL", "/metrics/effort"},
    {"lane_order", "REAL", "/metrics/lane_order"},
    {"mean_density", "REAL", "/metrics/mean_density"},
    {"high_density", "REAL", "/metrics/high_density"},
    {"mean_speed", "REAL", "/metrics/mean_speed"},
    {"flow", "REAL", "/metrics/flow"},
    {"specific_flow", "REAL", "/metrics/specific_flow"},
    {"frames", "INTEGER", "/frames"},
    {"steps", "INTEGER", "/steps"},
    {"load_seconds", "REAL", "/seconds/load"},
    {"setup_seconds", "REAL", "/seconds/setup"},
    {"simulate_seconds", "REAL", "/seconds/simulate"},
    {"bake_seconds", "REAL", "/seconds/bake"},
    {"measure_seconds", "REAL", "/seconds/measure"},
    {"total_seconds", "REAL", "/seconds/total"},
    {"peak_memory_mib", "REAL", "/peak_memory_mib"},
    {"version", "TEXT", "/version"},
    {"device", "TEXT", "/device"},
    {"driver", "TEXT", "/driver"},
    {"host", "TEXT", "/host"},
    {"ended", "TEXT", "/ended"},
    {"bake", "TEXT", "/bake"},
    {"log", "TEXT", "/log"},
};

std::string createScenarios() {
    std::string sql = "CREATE TABLE scenarios (id TEXT PRIMARY KEY, number INTEGER NOT NULL";
    for (const Column& column : kColumns)
        sql += fmt::format(", {} {}", column.name, column.type);
    return sql + ") WITHOUT ROWID";
}

bool isColumn(const std::string& name) {
    return name == "id" || name == "number" ||
           std::any_of(std::begin(kColumns), std::end(kColumns),
                       [&](const Column& column) { return sqlite3_stricmp(column.name, name.c_str()) == 0; });
}

/// The columns of `results`: a parameter of the name of a figure stays apart from it.
std::string createView(const authoring::Family& family) {
    std::string sql = "CREATE VIEW results AS SELECT scenarios.*";
    for (const authoring::Axis& axis : family.axes)
        sql += fmt::format(", parameters.{} AS {}", quotedName(axis.name),
                           quotedName(isColumn(axis.name) ? "parameter " + axis.name : axis.name));
    return sql + " FROM scenarios JOIN parameters USING (id)";
}

std::string questionMarks(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text += i ? ", ?" : "?";
    return text;
}

void fill(Connection& database, const BatchPlan& plan, const BatchFolder& folder) {
    const std::vector<authoring::Axis>& axes = plan.family().axes;
    std::string parameters = "CREATE TABLE parameters (id TEXT PRIMARY KEY";
    for (const authoring::Axis& axis : axes)
        parameters += ", " + quotedName(axis.name);
    database.execute(createScenarios());
    database.execute(parameters + ") WITHOUT ROWID");
    database.execute(createView(plan.family()));
    database.execute("CREATE TABLE batch (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID");
    Statement about(database, "INSERT INTO batch VALUES (?, ?)");
    for (const auto& [key, value] :
         {std::pair{"name", plan.family().name}, std::pair{"base", plan.family().base_name},
          std::pair{"version", std::string(THRONG_VERSION)}, std::pair{"family", plan.selfContained()}}) {
        about.bind(1, key);
        about.bind(2, value);
        about.step();
        about.reset();
    }
    Statement row(database,
                  fmt::format("INSERT INTO scenarios VALUES ({})", questionMarks(2 + std::size(kColumns))));
    Statement values(database,
                     fmt::format("INSERT INTO parameters VALUES ({})", questionMarks(1 + axes.size())));
    for (std::size_t i = 0; i < plan.scenarios().size(); ++i) {
        const PlannedScenario& planned = plan.scenarios()[i];
        const ordered_json result =
            folder.readResult(planned.id).value_or(ordered_json{{"status", "missing"}});
        row.bind(1, planned.id);
        row.bind(2, i + 1);
        for (std::size_t column = 0; column < std::size(kColumns); ++column) {
            const ordered_json::json_pointer pointer(kColumns[column].pointer);
            row.bind(static_cast<int>(column) + 3,
                     result.contains(pointer) ? result.at(pointer) : ordered_json());
        }
        row.step();
        row.reset();
        values.bind(1, planned.id);
        for (std::size_t axis = 0; axis < axes.size(); ++axis)
            values.bind(static_cast<int>(axis) + 2, planned.scenario.parameters[axis].second);
        values.step();
        values.reset();
    }
}

ordered_json valueAt(sqlite3_stmt* statement, int column) {
    switch (sqlite3_column_type(statement, column)) {
        case SQLITE_INTEGER:
            return static_cast<std::int64_t>(sqlite3_column_int64(statement, column));
        case SQLITE_FLOAT:
            return sqlite3_column_double(statement, column);
        case SQLITE_NULL:
            return nullptr;
        default: {
            const auto* text = reinterpret_cast<const char*>(sqlite3_column_blob(statement, column));
            return std::string(text ? text : "",
                               static_cast<std::size_t>(sqlite3_column_bytes(statement, column)));
        }
    }
}

std::string plainText(const ordered_json& value) {
    if (value.is_null()) return "";
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string textOf(const ordered_json& value) {
    return value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

std::string quotedName(const std::string& name) {
    return inQuotes(name);
}

void collectResults(const BatchPlan& plan, const BatchFolder& folder) {
    const fs::path fresh = folder.database().string() + fmt::format(".new-{}", ::getpid());
    std::error_code ignored;
    fs::remove(fresh, ignored);
    try {
        Connection database(fresh, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
        database.execute("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; BEGIN");  // nobody sees it yet
        fill(database, plan, folder);
        database.execute("COMMIT");
    } catch (const InputError& error) {
        fs::remove(fresh, ignored);
        throw OutputError(folder.database(), std::string("cannot be written: ") + error.what());
    }
    if (std::rename(fresh.c_str(), folder.database().c_str()) != 0)
        throw OutputError(folder.database(), "replace", errno);
}

QueryResult queryResults(const fs::path& database_path, const std::string& sql) {
    Connection database(database_path, SQLITE_OPEN_READONLY);
    Statement statement(database, sql);
    QueryResult result;
    const int columns = sqlite3_column_count(statement.handle());
    for (int column = 0; column < columns; ++column)
        result.columns.emplace_back(sqlite3_column_name(statement.handle(), column));
    while (statement.step()) {
        result.rows.emplace_back();
        for (int column = 0; column < columns; ++column)
            result.rows.back().push_back(valueAt(statement.handle(), column));
    }
    return result;
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
    constexpr std::size_t kWidest = 60;
    std::vector<std::vector<std::string>> lines = {result.columns};
    for (const auto& row : result.rows) {
        lines.emplace_back();
        for (const ordered_json& value : row) {
            std::string text = plainText(value);
            if (text.size() > kWidest) text = text.substr(0, kWidest - 3) + "...";
            std::replace(text.begin(), text.end(), '\n', ' ');
            lines.back().push_back(text);
        }
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

ordered_json jsonOf(const QueryResult& result) {
    ordered_json list = ordered_json::array();
    for (const auto& row : result.rows) {
        ordered_json object = ordered_json::object();
        for (std::size_t column = 0; column < row.size(); ++column)
            object[result.columns[column]] = row[column];
        list.push_back(object);
    }
    return list;
}

}  // namespace throng::cli
