// SPDX-License-Identifier: Apache-2.0
// The folder of a bake, as `throng measure`, `report` and `preview` read it.
#include "analysis/measure/measure.h"
#include "analysis/preview/preview.h"
#include "analysis/report/bake_report.h"
#include "cli/baking/judge.h"
#include "support/bake_input.h"

using namespace throng;

THRONG_FUZZ_BAKE()

void fuzz::readOne(std::string_view input) {
    const std::filesystem::path bake = putBake(input);
    io::CrowdReader crowd(io::loadBake(bake));
    const auto [measured, missed] = cli::judgeBake(crowd, {});
    static_cast<void>(analysis::measurementJson(measured).dump());
    static_cast<void>(analysis::measurementText(measured));
    static_cast<void>(analysis::bakeReport(crowd, analysis::framesOfReport(crowd), measured, missed));
    static_cast<void>(analysis::thumbnailOf(crowd));
    analysis::PreviewOptions options;
    options.width = 200;
    static_cast<void>(analysis::drawPreview(bake, folder() / "preview.png", options));
}
