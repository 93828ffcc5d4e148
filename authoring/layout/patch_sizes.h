// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/layout.h"

namespace throng::authoring {

/// What ground makes of bodies, times their own size: no less than `least`, which is at most 1, and no more
/// than `most`, which is at least 1.
struct SizeBounds {
    float least = 1.0f, most = 1.0f;
};

SizeBounds sizeBounds(const std::vector<Patch>& patches);

}  // namespace throng::authoring
