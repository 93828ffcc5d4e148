// SPDX-License-Identifier: Apache-2.0
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <cstdlib>
#include <glm/geometric.hpp>

#include "analysis/compare/trajectories.h"
#include "base/numbers.h"

namespace throng::analysis {
namespace {

constexpr std::int64_t kLastFrame = 1'000'000'000;
constexpr double kFurthestStored = 1.0e7;  // of the unit of length

double rateIn(SQLite::Database& database, const std::filesystem::path& path) {
    SQLite::Statement query(database, "SELECT value FROM metadata WHERE key = 'fps'");
    const std::optional<double> rate =
        query.executeStep() ? finiteNumber(query.getColumn(0).getString()) : std::nullopt;
    if (!rate || *rate <= 0.0)
        throw InputError(path,
                         "does not say how many frames a second has: expected `fps` in its table metadata");
    return *rate;
}

}  // namespace

/// As JuPedSim writes them: the tables trajectory_data (frame, id, pos_x, pos_y) and metadata (key, value).
Trajectories readTrajectoryDatabase(const std::filesystem::path& path, const TrajectoryOptions& options) try {
    SQLite::Database database(path.string(), SQLite::OPEN_READONLY);
    Trajectories result;
    result.rate = options.rate ? *options.rate : rateIn(database, path);
    std::vector<Sighting> rows;
    SQLite::Statement query(database, "SELECT id, frame, pos_x, pos_y FROM trajectory_data");
    while (query.executeStep()) {
        Sighting row;
        row.person = query.getColumn(0).getInt64();
        row.frame = query.getColumn(1).getInt64();
        row.place = {query.getColumn(2).getDouble(), query.getColumn(3).getDouble()};
        if (std::abs(row.frame) > kLastFrame)
            throw InputError(path, fmt::format("frame {}: expected at most {}", row.frame, kLastFrame));
        if (!(glm::length(row.place) < kFurthestStored))
            throw InputError(path, fmt::format("person {} is nowhere in frame {}", row.person, row.frame));
        row.place *= options.metres.value_or(1.0);
        rows.push_back(row);
    }
    result.tracks = tracksOf(path, std::move(rows), result.people);
    return result;
} catch (const SQLite::Exception& error) {
    throw InputError(path, fmt::format("is no database of trajectories: {}", error.what()));
}

}  // namespace throng::analysis
