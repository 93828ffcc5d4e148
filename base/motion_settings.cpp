// SPDX-License-Identifier: Apache-2.0
#include "base/motion_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace throng {
namespace {

std::string inCapitals(std::string word) {
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    return word;
}

/// Exactly this number, as GLSL writes a float.
std::string literal(double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return value < 0.0 ? "(" + text + ")" : text;
}

}  // namespace

void MotionSettings::set(std::size_t row, double value) {
    told_.reserve(motionParameters().size());
    if (told_.empty())
        for (const MotionParameter& parameter : motionParameters())
            told_.push_back(parameter.value);
    told_.at(row) = value;
}

double MotionSettings::number(std::string_view rule, std::string_view name) const {
    const auto rows = motionParameters();
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const MotionParameter& parameter) {
        return parameter.rule == rule && parameter.name == name;
    });
    if (found == rows.end()) throw std::logic_error(fmt::format("there is no motion.{}.{}", rule, name));
    return number(static_cast<std::size_t>(found - rows.begin()));
}

std::vector<std::pair<std::string, std::string>> MotionSettings::definitions() const {
    std::vector<std::pair<std::string, std::string>> all;
    const auto rows = motionParameters();
    all.reserve(rows.size());
    for (std::size_t row = 0; row < rows.size(); ++row) {
        const double value = number(row);
        all.emplace_back(inCapitals(fmt::format("{}_{}", rows[row].rule, rows[row].name)),
                         !rows[row].is_switch ? literal(value)
                         : value != 0.0       ? "true"
                                              : "false");
    }
    return all;
}

}  // namespace throng
