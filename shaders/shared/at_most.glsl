// SPDX-License-Identifier: Apache-2.0

/// `vector`, made no longer than `most`.
vec2 atMost(vec2 vector, float most) {
    float size = length(vector);
    return size > most ? vector * (most / size) : vector;
}
