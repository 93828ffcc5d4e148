// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

/// Bodies that are no discs, as shaders/shared/body_shape.glsl has them: all that is within so much of a
/// segment.
namespace throng {

/// How broad a body is from shoulder to shoulder and how deep from chest to back, m; zero: it is a disc. What
/// is deeper than broad is no walker but a wheelchair or a pram.
struct BodySize {
    double breadth = 0.0;
    double depth = 0.0;

    bool isDisc() const { return breadth <= 0.0; }
    /// Half of the longer side: the disc of this radius holds all of it.
    double radius() const { return 0.5 * std::max(breadth, depth); }
    /// Half of the shorter side: what it gets through.
    double thickness() const { return 0.5 * std::min(breadth, depth); }
    /// Of the segment; below zero where that lies along the way the body faces.
    double halfAxis() const { return 0.5 * (breadth - depth); }
};

struct Capsule {
    glm::dvec2 middle{0.0};
    glm::dvec2 axis{0.0};  ///< from the middle to one end of the segment; zero: a disc
    double thickness = 0.0;
};

/// @param facing of its chest, of unit length
inline Capsule capsuleOf(glm::dvec2 middle, glm::dvec2 facing, double radius, double half_axis) {
    const glm::dvec2 along = half_axis >= 0.0 ? glm::dvec2(-facing.y, facing.x) : facing;
    return {middle, std::abs(half_axis) * along, radius - std::abs(half_axis)};
}

/// From a segment `b` to the nearest point of a segment `a`.
/// @param offset from the middle of `b` to that of `a`; both reach from their middle to one end
inline glm::dvec2 segmentsGap(glm::dvec2 offset, glm::dvec2 a, glm::dvec2 b) {
    const double aa = glm::dot(a, a), bb = glm::dot(b, b), ab = glm::dot(a, b);
    const double ao = glm::dot(a, offset), bo = glm::dot(b, offset), apart = aa * bb - ab * ab;
    double on_a = apart > 1.0e-12 * aa * bb ? std::clamp((ab * bo - bb * ao) / apart, -1.0, 1.0) : 0.0;
    const double on_b = bb > 0.0 ? std::clamp((ab * on_a + bo) / bb, -1.0, 1.0) : 0.0;
    on_a = aa > 0.0 ? std::clamp((ab * on_b - ao) / aa, -1.0, 1.0) : 0.0;
    return offset + on_a * a - on_b * b;
}

inline double segmentsDistance(glm::dvec2 offset, glm::dvec2 a, glm::dvec2 b) {
    return glm::length(segmentsGap(offset, a, b));
}

/// How much is free between two bodies, m; below zero where they overlap.
inline double freeBetween(const Capsule& a, const Capsule& b) {
    return segmentsDistance(a.middle - b.middle, a.axis, b.axis) - a.thickness - b.thickness;
}

/// How deep two bodies are in each other, of how far apart they are where they touch; below zero: not at all.
inline double overlapOf(const Capsule& a, const Capsule& b) {
    return 1.0 - segmentsDistance(a.middle - b.middle, a.axis, b.axis) / (a.thickness + b.thickness);
}

/// How far a body reaches from its middle in a direction of unit length.
inline double reachOf(const Capsule& body, glm::dvec2 direction) {
    return body.thickness + std::abs(glm::dot(body.axis, direction));
}

}  // namespace throng
