// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "analysis/measure/measure.h"
#include "io/crowd_reader.h"

namespace throng::analysis {

/// A page about one bake: playback from above, plots, the account of everybody. @throws InputError
/// @param missed bars, in words
std::string bakeReport(io::CrowdReader& crowd, const Measurement& measured,
                       const std::vector<std::string>& missed);

/// How a scenario looks at a glance: its walls and the ways of some of its people, in bytes.
/// {"walls": [[x, y, ...]], "ways": [[group, x, y, ...]]}, coordinates from 0 to 255 over the longer side.
nlohmann::ordered_json thumbnailOf(io::CrowdReader& crowd);

}  // namespace throng::analysis
