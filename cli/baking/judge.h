// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "analysis/measure/measure.h"

namespace throng::cli {

/// What a bake measures, and which bars of its own layout it misses.
struct Judgement {
    analysis::Measurement measured;
    std::vector<std::string> missed;  ///< in words
};

/// Counts people across `options.line`, or else across the line that the layout's bars name.
Judgement judgeBake(io::CrowdReader& crowd, analysis::MeasureOptions options);

}  // namespace throng::cli
