// SPDX-License-Identifier: Apache-2.0
// Layouts: what is said of them, whatever they are.
#include "authoring/layout/layout_reader.h"
#include "support/custom_json.h"
#include "support/small_scene.h"

using namespace throng;

THRONG_FUZZ_JSON(authoring::layoutSchema())

void fuzz::readOne(std::string_view input) {
    authoring::Diagnostics diagnostics;
    static_cast<void>(authoring::readLayout(input, {}, diagnostics));
    tell(diagnostics, input);
}
