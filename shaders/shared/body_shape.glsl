// SPDX-License-Identifier: Apache-2.0
// The shape of a body: a capsule, which is all that is within so much of a segment: of somebody who walks, from
// shoulder to shoulder; of a wheelchair or a pram, along the way it faces. Discs are capsules whose segment is a point,
// and crowds of nothing else (no BODIES) know of no segment.
//
// `Body.radius` is half of the longer side, so the disc of that radius holds all of the body, whichever way it turns:
// what looks for those near by needs to know no more.
#ifdef BODIES

/// m: from the middle of the segment to its end.
vec2 axisAt(float angle, float half_axis) {
    vec2 facing = vec2(cos(angle), sin(angle));
    return half_axis >= 0.0 ? half_axis * vec2(-facing.y, facing.x) : -half_axis * facing;
}

/// m: how far the body reaches from its segment.
float thicknessOf(float radius, vec2 axis) { return radius - length(axis); }

/// `axis`, turned by so much to the left.
vec2 turnedBy(vec2 axis, float angle) { return axis * cos(angle) + vec2(-axis.y, axis.x) * sin(angle); }

float crossOf(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

/// Where on two segments, from -1 to 1, they are nearest to each other. Segments that are nearly parallel are near to
/// each other along a stretch: its middle counts, so that bodies abreast do not rock from one end of it to the other.
/// @param offset from the middle of `b` to that of `a`; both reach from their middle to one end
vec2 nearestAlong(vec2 offset, vec2 a, vec2 b) {
    const float PARALLEL = 2.0e-3;  // the sine of the angle between them, squared
    float aa = dot(a, a), bb = dot(b, b), ab = dot(a, b);
    float ao = dot(a, offset), bo = dot(b, offset);
    if (aa <= 0.0) return vec2(0.0, bb > 0.0 ? clamp(bo / bb, -1.0, 1.0) : 0.0);
    if (bb <= 0.0) return vec2(clamp(-ao / aa, -1.0, 1.0), 0.0);
    float apart = max(1.0 - ab * ab / (aa * bb), 0.0);
    float middle = -ao / aa, half_length = abs(ab) / aa;
    float abreast = clamp(0.5 * (max(middle - half_length, -1.0) + min(middle + half_length, 1.0)), -1.0, 1.0);
    float across = apart > 0.0 ? clamp((ab * bo - bb * ao) / (aa * bb * apart), -1.0, 1.0) : abreast;
    float on_a = mix(abreast, across, smoothstep(0.0, PARALLEL, apart));
    float on_b = clamp((ab * on_a + bo) / bb, -1.0, 1.0);
    if (apart >= PARALLEL) on_a = clamp((ab * on_b - ao) / aa, -1.0, 1.0);
    return vec2(on_a, on_b);
}

#endif
