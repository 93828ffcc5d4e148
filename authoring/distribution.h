// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace throng::authoring {

/// A per-person quantity. Every draw is clamped to [minimum, maximum].
struct Distribution {
    enum class Kind { constant, uniform, normal, log_normal };
    Kind kind = Kind::constant;
    double mean =
        0.0;  ///< the value (constant), the mean (normal) or that of its logarithm; unused by uniform
    double standard_deviation = 0.0;  ///< normal; of the logarithm for log_normal
    double minimum = 0.0;
    double maximum = 0.0;
    bool operator==(const Distribution&) const = default;
};

}  // namespace throng::authoring
