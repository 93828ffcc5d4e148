// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/batch/batch_plan.h"

namespace throng::cli {

/// What a batch leaves on the disk (docs/batch.md): `family.json`, and for each scenario a result, a bake if
/// it is to be kept, and a log if it failed. A result appears whole or not at all, and after its bake.
class BatchFolder {
  public:
    explicit BatchFolder(std::filesystem::path root) : root_(std::move(root)) {}

    const std::filesystem::path& root() const { return root_; }
    std::filesystem::path familyFile() const { return root_ / "family.json"; }
    std::filesystem::path database() const { return root_ / "results.sqlite"; }
    std::filesystem::path bake(const std::string& id) const { return root_ / "bakes" / id; }
    std::filesystem::path result(const std::string& id) const { return root_ / "results" / (id + ".json"); }
    std::filesystem::path log(const std::string& id) const { return root_ / "logs" / (id + ".log"); }

    /// Makes the folders and leaves the family in them. An error when the folder holds something else.
    void begin(const BatchPlan& plan) const;

    /// Nothing where there is none, or one that cannot be understood.
    std::optional<nlohmann::ordered_json> readResult(const std::string& id) const;
    void writeResult(const std::string& id, const nlohmann::ordered_json& result) const;
    void writeLog(const std::string& id, const std::string& text) const;

  private:
    std::filesystem::path root_;
};

/// How far a batch is.
struct BatchStanding {
    std::vector<std::size_t> open;  ///< to be baked: never were, failed, or out of date
    std::size_t done = 0;
    std::size_t failed_before = 0;     ///< among the open ones
    std::size_t out_of_date = 0;       ///< among the open ones: made from another layout or other options
    std::size_t other_build = 0;       ///< among the open ones: not out of date, but made by another program
    std::vector<std::size_t> damaged;  ///< among the open ones: their bakes are not as they were written
    std::vector<std::string> foreign;  ///< ids of results that belong to no scenario of the family
};

/// Reads the bakes that are there: one that is not as it was written counts for nothing.
/// @param again everything is to be baked anew; @param mine whose bakes are looked at
BatchStanding standingOf(const BatchPlan& plan, const BatchFolder& folder, bool again,
                         const std::function<bool(std::size_t)>& mine);

}  // namespace throng::cli
