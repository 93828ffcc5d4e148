// SPDX-License-Identifier: Apache-2.0
// Which slots this dispatch is for: all, or with BANDED those of one band (shaders/diagram/bands.comp).
#ifdef BANDED
layout(std430) readonly buffer Bands { Band bands[]; };
uniform uint band;
#else
layout(std430) readonly buffer LiveDispatch { uint live_groups[3]; uint live_count; };
#endif

/// @returns false where this invocation has none
bool findSlot(out uint slot) {
    slot = gl_GlobalInvocationID.x;
#ifdef BANDED
    slot += bands[band].first_slot;
    return slot < bands[band].end_slot;
#else
    return slot < live_count;
#endif
}
