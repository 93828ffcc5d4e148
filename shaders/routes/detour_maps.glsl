// SPDX-License-Identifier: Apache-2.0
// What the coarse map's passes read of many cells each, through samplers: a software renderer loads from a storage
// block one invocation after the other, and fetches texels for several at once.

uniform usamplerBuffer ground;            // a GroundCell each, as bits
uniform usamplerBuffer free_distances;    // without any crowd: floats, as bits
uniform usamplerBuffer detour_distances;  // floats, as bits

GroundCell groundAt(uint cell) {
    uvec4 words = texelFetch(ground, int(cell));
    return GroundCell(uintBitsToFloat(words.x), words.y, words.z, uintBitsToFloat(words.w));
}

float freeDistanceAt(uint cell) { return uintBitsToFloat(texelFetch(free_distances, int(cell)).x); }
float detourDistanceAt(uint cell) { return uintBitsToFloat(texelFetch(detour_distances, int(cell)).x); }
