// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/batch/batch_folder.h"

namespace throng::cli {

/// Gathers the results of a batch into `results.sqlite` (docs/batch.md has its tables), which is replaced in
/// one step: whoever reads sees the old one or the new one. Safe to run at any time, as often as one likes.
/// @throws OutputError
void collectResults(const BatchPlan& plan, const BatchFolder& folder);

/// What a query gives.
struct QueryResult {
    std::vector<std::string> columns;
    /// One value per column: null, whole number, number or text.
    std::vector<std::vector<nlohmann::ordered_json>> rows;
};

/// Runs one statement on a batch's database, which it cannot change.
/// @throws InputError with what SQLite says
QueryResult queryResults(const std::filesystem::path& database, const std::string& sql);

std::string csvOf(const QueryResult& result);
std::string tableOf(const QueryResult& result);
nlohmann::ordered_json jsonOf(const QueryResult& result);

/// A name as SQL takes it, whatever is in it.
std::string quotedName(const std::string& name);

}  // namespace throng::cli
