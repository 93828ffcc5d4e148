// SPDX-License-Identifier: Apache-2.0
#include "authoring/cli/judge.h"

#include "authoring/layout/layout_reader.h"
#include "io/files/input_file.h"

namespace throng::cli {

Judgement judgeBake(const io::Bake& bake, io::MeasureOptions options) {
    authoring::Diagnostics diagnostics;
    const auto layout = authoring::readLayout(io::readFile(bake.folder / "layout.json"), {}, diagnostics);
    if (layout && layout->flow_line && !options.line)
        options.line = {layout->flow_line->a, layout->flow_line->b};
    Judgement judgement{io::measureBake(bake, options), {}};
    if (layout) judgement.missed = io::missedExpectations(judgement.measured, layout->expectations);
    return judgement;
}

}  // namespace throng::cli
