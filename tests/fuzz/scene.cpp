// SPDX-License-Identifier: Apache-2.0
// Layouts, and the scenes of those that are valid: ground, routes, people's places.
#include "authoring/layout/layout_reader.h"
#include "support/custom_json.h"
#include "support/small_scene.h"

using namespace throng;

THRONG_FUZZ_JSON(authoring::layoutSchema())

void fuzz::readOne(std::string_view input) {
    authoring::Diagnostics diagnostics;
    const auto layout = authoring::readLayout(input, {}, diagnostics);
    if (layout) buildIfSmall(*layout, diagnostics);
    tell(diagnostics, input);
}
