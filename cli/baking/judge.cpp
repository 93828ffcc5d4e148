// SPDX-License-Identifier: Apache-2.0
#include "cli/baking/judge.h"

#include "authoring/layout/layout_reader.h"
#include "base/files/input_file.h"

namespace throng::cli {

Judgement judgeBake(io::CrowdReader& crowd, analysis::MeasureOptions options) {
    authoring::Diagnostics diagnostics;
    const auto layout = authoring::readLayout(readFile(crowd.bake().folder / "layout.json"), {}, diagnostics);
    if (layout && layout->flow_line && !options.line)
        options.line = {layout->flow_line->a, layout->flow_line->b};
    Judgement judgement{analysis::measureBake(crowd, options), {}};
    if (layout) judgement.missed = analysis::missedExpectations(judgement.measured, layout->expectations);
    return judgement;
}

}  // namespace throng::cli
