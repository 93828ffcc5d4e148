// SPDX-License-Identifier: Apache-2.0
// Images do not decide anything: they are taken along by those whose images they are (shaders/charts/follow.comp).

#ifdef CHARTS
bool isImage(uint walker_flags) { return (walker_flags & WALKER_IS_IMAGE) != 0u; }
#else
bool isImage(uint walker_flags) { return false; }
#endif
