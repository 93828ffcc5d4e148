// SPDX-License-Identifier: Apache-2.0
// What all parts mean by walking, shared by C++ and GLSL.
#ifndef THRONG_SHARED_WALKING_H
#define THRONG_SHARED_WALKING_H

#include "shaders/shared/both_languages.h"

THRONG_SHARED_BEGIN

const float STANDING_SPEED = 0.1f;  // m/s: slower people stand; slower wishes are to stand

THRONG_SHARED_END

#endif
