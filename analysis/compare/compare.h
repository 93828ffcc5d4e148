// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/compare/observe.h"

namespace throng::analysis {

struct CompareOptions {
    std::optional<Box2d> area;  ///< unless given: round the trajectories, a metre inside
    std::optional<std::pair<glm::dvec2, glm::dvec2>> line;
};

/// A crowd, and what was seen of it.
struct Side {
    std::string name;
    std::size_t people = 0;
    double seconds = 0.0;  ///< from the first look to the last
    Observed seen;
};

/// A bake beside trajectories of people.
struct Comparison {
    Box2d area;
    bool has_line = false;
    Side bake, people;
};

/// Throws InputError where they are nowhere near each other.
Comparison compareWith(io::CrowdReader& crowd, const Trajectories& people, const CompareOptions& options);

nlohmann::ordered_json comparisonJson(const Comparison& comparison);
std::string comparisonText(const Comparison& comparison);
/// A PNG for each quantity, passed.png and speed_by_density.png. Throws OutputError.
void writeComparisonPlots(const std::filesystem::path& folder, const Comparison& comparison);

}  // namespace throng::analysis
