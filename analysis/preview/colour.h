// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include "base/palette.h"

namespace throng::analysis {

/// What is drawn next has this colour; `alpha` 0 to 1.
inline void setColour(cairo_t* context, Colour colour, double alpha = 1.0) {
    cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, alpha);
}

}  // namespace throng::analysis
