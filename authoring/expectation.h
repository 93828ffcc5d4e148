// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace throng::authoring {

/// A bar that a layout sets itself: what `throng measure` finds has to lie within. The schema has the
/// figures.
struct Expectation {
    std::string figure;
    std::optional<double> minimum;
    std::optional<double> maximum;
};

}  // namespace throng::authoring
