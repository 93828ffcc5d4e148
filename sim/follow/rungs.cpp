// SPDX-License-Identifier: Apache-2.0
#include "sim/follow/rungs.h"

#include <algorithm>

namespace throng::sim {

std::vector<Rung> rungsOf(const gl::ShaderLibrary& library, const std::string& shader,
                          const MotionSettings& told, const std::string& base,
                          const std::vector<std::string>& besides) {
    std::vector<std::string> files;
    const std::string text = library.load(shader, {}, files);
    const auto rows = motionParameters();
    const auto names = told.definitions();
    const auto is_known = [&](std::size_t row) {
        return text.find(names[row].first) != std::string::npos ||
               std::ranges::find(besides, rows[row].rule) != besides.end();
    };
    std::vector<Rung> rungs = {{base, told}};
    std::vector<std::size_t> switches;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        if (!rows[row].is_switch || told.number(row) == 0.0 || !is_known(row)) continue;
        switches.push_back(row);
        rungs.front().rules.set(row, 0.0);
    }
    for (const std::size_t row : switches) {
        rungs.push_back({std::string(rows[row].rule), rungs.back().rules});
        rungs.back().rules.set(row, told.number(row));
    }
    return rungs;
}

}  // namespace throng::sim
