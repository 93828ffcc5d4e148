// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "cli/baking/baker.h"
#include "cli/watch/live_log.h"

namespace throng::cli {

/// How a crowd that is looked at came to its end.
enum class LiveEnd { complete, stopped, full };

/// Simulates a layout from its beginning, as fast as it goes, for whoever looks at the log: as a bake of it
/// would be, but that nothing is written and few moments are kept.
/// @param per_second moments kept of a second; @param stop is asked after each step
LiveEnd simulateLive(const Baker& baker, const LoadedLayout& loaded, double per_second, LiveLog& log,
                     const std::function<bool()>& stop);

}  // namespace throng::cli
