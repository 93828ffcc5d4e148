// SPDX-License-Identifier: Apache-2.0
#include "shaders/shared/walker.glsl"

/// Neither stands somewhere nor waits in a line.
bool isUnderWay(Walker walker) {
    return walker.status == STATUS_WALKING && walker.leave_step == 0u && ticketOf(walker) == NO_INDEX;
}
