// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "authoring/family/formula.h"
#include "authoring/family/generators.h"
#include "authoring/layout.h"
#include "base/stream_formats.h"
#include "base/streams.h"

/// A family of scenarios: a layout, and what varies from one scenario to the next (docs/batch.md).
namespace throng::authoring {

using Json = nlohmann::ordered_json;

/// One thing that varies.
struct Axis {
    enum class Kind { values, uniform, normal, log_normal, formula };
    /// What one of several cases sets: JSON pointers and values.
    using Settings = std::vector<std::pair<std::string, Json>>;
    std::string name;                   ///< unique in the family
    std::vector<std::string> pointers;  ///< JSON pointers into the layout; none: a parameter of the generator
    std::string parameter;
    Kind kind = Kind::values;
    std::vector<Json> values;
    std::vector<Settings> cases;  ///< one per value, which is its name; or none
    Formula formula;              ///< of axes that are none, and of formulas before it
    std::vector<double> weights;  ///< one per value, or none: all are alike
    double a = 0.0, b = 0.0;      ///< least and most, or mean and deviation (of the logarithm for log_normal)
    double minimum, maximum;      ///< tails beyond are cut off
    bool whole = false;           ///< rounded to whole numbers
    SourcePosition where, formula_where;
    /// Where a letter of the formula stands in the file.
    SourcePosition formulaPlace(std::size_t letter) const;
};

/// A family that has no plan.
struct PlanError : std::invalid_argument {
    PlanError(const std::string& what, SourcePosition place)
        : std::invalid_argument(what), where(std::move(place)) {}
    SourcePosition where;
};

enum class Sampling {
    grid,    ///< every combination of all values
    random,  ///< each axis drawn for itself
    latin,   ///< Latin hypercube: each axis's range is covered evenly (McKay, Beckman and Conover 1979)
};

struct Family {
    std::string name;
    std::string base_name;  ///< the layout's file, or the generator's name
    Json base;              ///< the layout; null where a generator makes it
    std::string folder;     ///< absolute: where the paths of files start from that axes set
    const Generator* generator = nullptr;
    std::vector<std::pair<std::string, double>> generator_values;
    std::vector<Axis> axes;
    Sampling sampling = Sampling::grid;
    std::uint64_t count = 0;  ///< scenarios drawn, of random and latin
    std::uint64_t seed = 1;   ///< of the drawing
    struct Bake {
        bool gltf = false;
        bool keep = true;        ///< the bakes themselves, not only what was measured
        StreamChoice streams{};  ///< asked for
        StreamFormats formats = StreamFormats::standard();  ///< in which they are written
        std::uint64_t diagrams = 0;                         ///< frames between diagram images, 0 for none
    } bake;
    SourcePosition where, generator_where;
};

/// One scenario of a family.
struct Scenario {
    std::vector<std::pair<std::string, Json>> parameters;  ///< by axis, in the family's order
};

/// All scenarios, each once: whoever draws from short lists may draw the same twice.
/// @throws PlanError where a formula has no value
std::vector<Scenario> planFamily(const Family& family);

/// How many planFamily() would give before it drops what is there twice; HUGE for grids beyond counting.
double countOf(const Family& family);

/// The layout of one scenario.
/// @throws std::invalid_argument where a value does not fit: "/flows/3/rate: there is no flow 3"
Json composeLayout(const Family& family, const Scenario& scenario);

/// "rate 2, seed 7"
std::string describe(const Scenario& scenario);

}  // namespace throng::authoring
