// SPDX-License-Identifier: Apache-2.0
// The file that `throng calibrate` leaves, and what is chosen by it.
#include <cstdlib>

#include "cli/baking/calibration_file.h"
#include "support/custom_json.h"

using namespace throng;

THRONG_FUZZ_JSON(R"({"throng-calibration": 1, "version": "0.1.0", "device": "any / 1",
        "words": ["costs", "method", "gradient1", "gradient2", "per-site", "per-pixel", "binned",
        "flood", "cones", "auto",
        "base_ms", "pixel_ns", "site_ns", "covered_ns", "gather", "block_width", "block_height", "bin_radii"],
        "numbers": [1, 2, 4, 8, 0.25]})")

void fuzz::readOne(std::string_view input) {
    static const gl::Device device = [] {
        ::setenv("XDG_CACHE_HOME", folder().c_str(), 1);
        gl::Device made;
        made.name = "any";
        made.version = "1";
        return made;
    }();
    put("throng/" + cli::calibrationPath(device).filename().string(), input);
    const auto model = cli::loadCalibration(device);
    if (!model) return;
    for (const sim::DiagramLoad& load : {sim::DiagramLoad{}, sim::DiagramLoad{1000.0, 8.0, 1.0e6, 100.0}}) {
        const auto plan = model->plan(load, 20.0);
        if (!plan.cost) finding("no method is chosen");
        static_cast<void>(model->choose(load, plan.cost));
    }
}
