// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace throng {

/// One number of one rule of motion: a row of the table that the layout's schema holds as its property
/// `motion`, which also says what it does, its unit and its source. A rule is a file of shaders/motion.
struct MotionParameter {
    std::string_view rule;
    std::string_view name;
    bool is_switch = false;  ///< on or off: 1 or 0
    double value = 0.0;      ///< unless a layout says otherwise
    double least = 0.0;
    double most = 1.0;
};

/// All of them, those of one rule together.
std::span<const MotionParameter> motionParameters();

/// What the rules of motion work with: the table's values, or others that a layout gives.
class MotionSettings {
  public:
    /// @param row of motionParameters()
    void set(std::size_t row, double value);
    double number(std::size_t row) const {
        return told_.empty() ? motionParameters()[row].value : told_.at(row);
    }
    /// @throws std::logic_error for what is not in the table
    double number(std::string_view rule, std::string_view name) const;
    bool isOn(std::string_view rule, std::string_view name = "enabled") const {
        return number(rule, name) != 0.0;
    }

    /// What the shaders know all rows by, and their values in GLSL: {"DRIVE_RELAXATION", "0.5"},
    /// {"CUSHION_ENABLED", "true"}.
    std::vector<std::pair<std::string, std::string>> definitions() const;

  private:
    std::vector<double> told_;  // one per row; none while all are the table's
};

}  // namespace throng
