// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "cli/watch/live_log.h"

namespace throng::cli {

/// Shows a bake as far as it has come, and whatever is written of it from here on, until it is told to stop.
/// A bake that is begun anew is shown anew.
/// @param per_second moments kept of a second
/// @throws InputError where there is no such bake
void followBake(const std::filesystem::path& path, double per_second, LiveLog& log,
                const std::function<bool()>& stop);

}  // namespace throng::cli
