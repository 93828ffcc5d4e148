// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace throng::authoring {

/// What is wrong with a formula, and at which of its letters, from 0.
struct FormulaError : std::invalid_argument {
    FormulaError(const std::string& what, std::size_t at_letter)
        : std::invalid_argument(what), at(at_letter) {}
    std::size_t at;
};

/// A number made from others: numbers, names, + - * / ( ), min(a, b, ...), max(a, b, ...), with the usual
/// precedence. Names are letters, digits, `_` and `.`, beginning with a letter or `_`.
class Formula {
  public:
    Formula() = default;
    /// @throws FormulaError
    explicit Formula(std::string_view text);

    struct Name {
        std::string name;
        std::size_t at;  ///< the letter where it is used first
    };
    /// What has to be known, each once.
    const std::vector<Name>& names() const { return names_; }

    /// @param value_of a name's value
    /// @throws FormulaError where something is divided by zero, or grows beyond all bounds
    double evaluate(const std::function<double(const std::string&)>& value_of) const;

  private:
    friend class FormulaParser;
    enum class Kind { number, name, negate, add, subtract, multiply, divide, least, most };
    /// In the order in which a stack of numbers wants them.
    struct Step {
        Kind kind;
        std::size_t at;
        double number = 0.0;
        std::size_t count = 0;  ///< least, most: of how many; name: which
    };
    std::vector<Step> steps_;
    std::vector<Name> names_;
};

}  // namespace throng::authoring
