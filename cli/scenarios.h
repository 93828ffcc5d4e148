// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace throng::cli {

/// A layout with bars of its own, from the folder scenarios/.
struct Scenario {
    std::string_view name;
    std::string_view layout;  ///< the file's text
    bool large;               ///< takes long: run only where it is asked for by name
};

/// All of them, put into the binary by the build.
std::span<const Scenario> scenarios();

}  // namespace throng::cli
