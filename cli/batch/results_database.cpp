// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/results_database.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <strings.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>

#include "base/build_name.h"
#include "base/files/csv.h"
#include "base/files/errors.h"
#include "base/files/output_file.h"
#include "base/outcomes.h"

namespace throng::cli {
namespace fs = std::filesystem;
namespace {

using nlohmann::ordered_json;

void put(SQLite::Statement& statement, int place, const ordered_json& value) {
    if (value.is_null())
        statement.bind(place);
    else if (value.is_boolean())
        statement.bind(place, value.get<bool>() ? 1 : 0);
    else if (value.is_number_integer())
        statement.bind(place, value.get<std::int64_t>());
    else if (value.is_number())
        statement.bind(place, value.get<double>());
    else
        statement.bind(place, value.is_string() ? value.get<std::string>() : value.dump());
}

void insert(SQLite::Statement& statement) {
    statement.exec();
    statement.reset();
}

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
    {wordFor(Fate::arrived).data(), "INTEGER", "/metrics/arrived"},
    {wordFor(Fate::walking).data(), "INTEGER", "/metrics/walking"},
    {wordFor(Fate::refused).data(), "INTEGER", "/metrics/refused"},
    {wordFor(Fate::stuck).data(), "INTEGER", "/metrics/stuck"},
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
    {"head_rate_p99", "REAL", "/metrics/head_rate/p99"},
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
    {"build", "TEXT", "/build"},
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
    return ::strcasecmp(name.c_str(), "id") == 0 || ::strcasecmp(name.c_str(), "number") == 0 ||
           std::any_of(std::begin(kColumns), std::end(kColumns),
                       [&](const Column& column) { return ::strcasecmp(column.name, name.c_str()) == 0; });
}

/// Names of columns differ in more than in case, and `id` is there already.
std::string parameterColumn(const std::string& axis) {
    return ::strcasecmp(axis.c_str(), "id") == 0 ? "parameter " + axis : axis;
}

/// The columns of `results`: a parameter of the name of a figure stays apart from it.
std::string createView(const authoring::Family& family) {
    std::string sql = "CREATE VIEW results AS SELECT scenarios.*";
    for (const authoring::Axis& axis : family.axes)
        sql += fmt::format(", parameters.{} AS {}", quotedName(parameterColumn(axis.name)),
                           quotedName(isColumn(axis.name) ? "parameter " + axis.name : axis.name));
    return sql + " FROM scenarios JOIN parameters USING (id)";
}

std::string questionMarks(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text += i ? ", ?" : "?";
    return text;
}

void fill(SQLite::Database& database, const BatchPlan& plan, const BatchFolder& folder) {
    const std::vector<authoring::Axis>& axes = plan.family().axes;
    std::string parameters = "CREATE TABLE parameters (id TEXT PRIMARY KEY";
    for (const authoring::Axis& axis : axes)
        parameters += ", " + quotedName(parameterColumn(axis.name));
    database.exec(createScenarios());
    database.exec(parameters + ") WITHOUT ROWID");
    database.exec(createView(plan.family()));
    database.exec("CREATE TABLE batch (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID");
    SQLite::Statement about(database, "INSERT INTO batch VALUES (?, ?)");
    for (const auto& [key, value] :
         {std::pair{"name", plan.family().name}, std::pair{"base", plan.family().base_name},
          std::pair{"version", std::string(THRONG_VERSION)}, std::pair{"build", std::string(buildName())},
          std::pair{"family", plan.selfContained()}}) {
        put(about, 1, key);
        put(about, 2, value);
        insert(about);
    }
    SQLite::Statement row(
        database, fmt::format("INSERT INTO scenarios VALUES ({})", questionMarks(2 + std::size(kColumns))));
    SQLite::Statement values(
        database, fmt::format("INSERT INTO parameters VALUES ({})", questionMarks(1 + axes.size())));
    for (std::size_t i = 0; i < plan.scenarios().size(); ++i) {
        const PlannedScenario& planned = plan.scenarios()[i];
        const ordered_json result =
            folder.readResult(planned.id).value_or(ordered_json{{"status", "missing"}});
        put(row, 1, planned.id);
        put(row, 2, i + 1);
        for (std::size_t column = 0; column < std::size(kColumns); ++column) {
            const ordered_json::json_pointer pointer(kColumns[column].pointer);
            put(row, static_cast<int>(column) + 3,
                result.contains(pointer) ? result.at(pointer) : ordered_json());
        }
        insert(row);
        put(values, 1, planned.id);
        for (std::size_t axis = 0; axis < axes.size(); ++axis)
            put(values, static_cast<int>(axis) + 2, planned.scenario.parameters[axis].second);
        insert(values);
    }
}

void write(const fs::path& file, const BatchPlan& plan, const BatchFolder& folder) try {
    SQLite::Database database(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    database.exec("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF");  // nobody sees it yet
    SQLite::Transaction transaction(database);
    fill(database, plan, folder);
    transaction.commit();
} catch (const SQLite::Exception& error) {
    throw InputError(file, error.what());
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
        write(fresh, plan, folder);
        syncFile(fresh);
    } catch (const InputError& error) {
        fs::remove(fresh, ignored);
        throw OutputError(folder.database(), std::string("cannot be written: ") + error.what());
    }
    if (std::rename(fresh.c_str(), folder.database().c_str()) != 0)
        throw OutputError(folder.database(), "replace", errno);
}

}  // namespace throng::cli
