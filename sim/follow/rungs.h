// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/motion_settings.h"
#include "sim/gl/shader_source.h"

namespace throng::sim {

/// One rung of a ladder of rules: everything below it, and one rule more.
struct Rung {
    std::string rule;
    MotionSettings rules;
};

/// `told` without those of its rules that can be switched off and that `shader` knows: that is the first rung
/// and named `base`. Each of the others has one more of them, in the table's order. The last is `told`, as
/// far as the shader knows.
/// @param besides rules that count as known to it
std::vector<Rung> rungsOf(const gl::ShaderLibrary& library, const std::string& shader,
                          const MotionSettings& told, const std::string& base,
                          const std::vector<std::string>& besides = {});

}  // namespace throng::sim
