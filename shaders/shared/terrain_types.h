// SPDX-License-Identifier: Apache-2.0
// Ground that is not flat, shared by C++ and GLSL (std430).
#ifndef THRONG_SHARED_TERRAIN_TYPES_H
#define THRONG_SHARED_TERRAIN_TYPES_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

const float STEEPEST_GROUND = 1.0f;  // rise over run: 45 degrees; nobody walks on steeper ground

/// The ground without its steps, on a lattice.
struct TerrainNode {
    float height;  // m
    float steps;   // 1 = the slope here is that of stairs, 0 = of a ramp
};

THRONG_SHARED_END

#endif
