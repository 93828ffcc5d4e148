// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "analysis/measure/measure.h"
#include "analysis/report/packed_ways.h"
#include "io/crowd_reader.h"

namespace throng::analysis {

/// What a page shows of a bake's frames.
struct FramesOfReport {
    PackedWays ways;
    nlohmann::ordered_json series;    ///< what is plotted over time, second by second
    nlohmann::ordered_json overlaps;  ///< the deepest pairs, each in its worst moment
    std::size_t overlap_pairs = 0;    ///< of which those are the deepest
    nlohmann::ordered_json stuck;     ///< who is at the end, and since when
};
/// Goes through all of them. It needs nothing of what is measured: both may be done at once, each with its
/// own reader. @throws InputError
FramesOfReport framesOfReport(io::CrowdReader& crowd);

/// A page about one bake: playback from above, plots, the account of everybody. @throws InputError
/// @param missed bars, in words
std::string bakeReport(io::CrowdReader& crowd, const FramesOfReport& frames, const Measurement& measured,
                       const std::vector<std::string>& missed);

/// How a scenario looks at a glance: its walls and the ways of some of its people, in bytes.
/// {"walls": [[x, y, ...]], "ways": [[group, x, y, ...]]}, coordinates from 0 to 255 over the longer side.
nlohmann::ordered_json thumbnailOf(io::CrowdReader& crowd);

}  // namespace throng::analysis
