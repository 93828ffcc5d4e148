// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "authoring/family/family.h"

namespace throng::cli {

/// One scenario of a batch.
struct PlannedScenario {
    std::string id;  ///< XXH3 of its parameters, 16 hexadecimal digits: also the name of its files
    authoring::Scenario scenario;
};

/// Whether a text has the form of such an id: only such names are ever removed or written for one.
bool isScenarioId(std::string_view text);

/// What a batch costs, as far as can be known before.
struct BatchLoad {
    double steps = 0.0;         ///< of all together
    double people_steps = 0.0;  ///< sum over scenarios of steps x people, all counted from the first step
    double bytes = 0.0;         ///< of the bakes
    double largest_people = 0.0;
};

/// A family and its scenarios.
class BatchPlan {
  public:
    /// Reads a family and its base layout.
    /// @throws Exit with kInvalidInput when something is wrong, which has been printed then
    explicit BatchPlan(const std::string& path);
    /// Tries every scenario's layout (up to some thousands, evenly chosen: the others' mistakes become
    /// failures of their own) and adds up the load. Takes seconds for large layouts: no work for a worker.
    /// @returns how many were tried
    /// @throws Exit as above
    std::size_t tryLayouts();

    const authoring::Family& family() const { return family_; }
    const std::vector<PlannedScenario>& scenarios() const { return scenarios_; }
    /// As far as tryLayouts() has found it.
    const BatchLoad& load() const { return load_; }
    /// The family as a file that needs no other.
    const std::string& selfContained() const { return self_contained_; }

    /// The layout of a scenario. @throws std::invalid_argument as authoring::composeLayout
    std::string layoutText(std::size_t index) const;
    /// What a result has to have been made from to be this scenario's.
    std::string inputHash(const std::string& layout_text) const;

  private:
    void addLoad(const authoring::Layout& layout, double share);
    std::string filesOf(const std::string& layout_text) const;

    std::string path_;
    authoring::Family family_;
    std::vector<PlannedScenario> scenarios_;
    BatchLoad load_;
    mutable std::map<std::string, std::string> files_;  ///< hashes of those that layouts name, by path
    std::string self_contained_;
};

}  // namespace throng::cli
