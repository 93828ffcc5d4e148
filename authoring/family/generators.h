// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Layouts made from a few numbers: for families of scenarios, and to begin with. Whatever the numbers,
/// within their ranges, the layout is valid: nobody stands in a wall and every goal can be reached.
namespace throng::authoring {

/// A number that a generator takes.
struct GeneratorParameter {
    std::string_view name;
    double standard;  ///< what it is where nobody says
    double least, most;
    bool whole;  ///< no fractions
    std::string_view meaning;
};

/// The numbers that a layout is made from, one per parameter, in the generator's order.
class GeneratorValues {
  public:
    explicit GeneratorValues(std::span<const GeneratorParameter> parameters);
    std::span<const GeneratorParameter> parameters() const { return parameters_; }
    double operator[](std::string_view name) const;
    std::uint64_t whole(std::string_view name) const;
    /// @throws std::invalid_argument for what the generator does not know or take, saying what it would
    void set(std::string_view name, double value);

  private:
    std::size_t indexOf(std::string_view name) const;
    std::span<const GeneratorParameter> parameters_;
    std::vector<double> values_;
};

struct Generator {
    std::string_view name;
    std::string_view meaning;
    std::span<const GeneratorParameter> parameters;
    nlohmann::ordered_json (*make)(const GeneratorValues&);
};

std::span<const Generator> generators();
/// Null where there is none of this name.
const Generator* generatorNamed(std::string_view name);

}  // namespace throng::authoring
