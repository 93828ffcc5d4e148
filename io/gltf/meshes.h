// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace throng::io {

/// Triangles, counter-clockwise from outside. Metres, Z up.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< unit length, one per position
    std::vector<std::uint32_t> indices;
};

/// The two edges of a strip along a polyline.
struct Ribbon {
    std::vector<glm::dvec2> left;   ///< one per point of the polyline
    std::vector<glm::dvec2> right;  ///< likewise
};

/// Mitred edges at `half_width` metres; mitres are cut at twice that. Points that coincide with the one
/// before are dropped; empty when fewer than two remain.
Ribbon ribbonAlong(std::span<const glm::dvec2> points, double half_width);

/// Triangles of a simple polygon of either winding, as indices into it, counter-clockwise.
std::vector<std::uint32_t> triangulate(std::span<const glm::dvec2> polygon);

/// The area in m^2, positive when the polygon winds counter-clockwise, negative when clockwise.
double signedArea(std::span<const glm::dvec2> polygon);

/// A rectangle that faces up.
Mesh groundMesh(glm::dvec2 minimum, glm::dvec2 maximum, double z);
/// A flat strip that faces up.
Mesh ribbonMesh(std::span<const glm::dvec2> centreline, double width, double z);
/// A flat polygon that faces up.
Mesh polygonMesh(std::span<const glm::dvec2> polygon, double z);
/// A strip pulled up from the ground, with its top and ends.
Mesh openWallMesh(std::span<const glm::dvec2> points, double thickness, double height);
/// A polygon pulled up from the ground, with its top.
Mesh closedWallMesh(std::span<const glm::dvec2> polygon, double height);

inline constexpr double kBodyRadius = 0.25;  ///< m
inline constexpr double kBodyHeight = 1.75;  ///< m

/// The same, higher.
Mesh raisedMesh(Mesh mesh, double height);
/// The same, turned counter-clockwise about the vertical, rad.
Mesh turnedMesh(Mesh mesh, double angle);
void append(Mesh& mesh, const Mesh& more);

/// A person: an upright capsule on the ground with a nose that points along +X.
Mesh bodyMesh();

}  // namespace throng::io
