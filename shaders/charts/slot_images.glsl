// SPDX-License-Identifier: Apache-2.0
// Which slots hold images, for programs that do not read walkers (shaders/shared/images.glsl for those that do).

#ifdef CHARTS
layout(std430) readonly buffer SlotImages { SlotImage slot_images[]; };
bool holdsImage(uint slot) { return slot_images[slot].person != NO_INDEX; }
#else
bool holdsImage(uint slot) { return false; }
#endif
