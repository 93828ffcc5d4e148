// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

namespace throng::io {
namespace {

constexpr double kSamePoint = 1e-6;  // m
constexpr double kLongestMitre = 2.0;

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

glm::dvec2 leftOf(glm::dvec2 direction) {
    return {-direction.y, direction.x};
}

glm::vec3 lifted(glm::dvec2 point, double z) {
    return glm::vec3(glm::dvec3(point, z));
}

std::vector<glm::dvec2> withoutRepeats(std::span<const glm::dvec2> points) {
    std::vector<glm::dvec2> kept;
    for (const glm::dvec2 point : points)
        if (kept.empty() || glm::distance(kept.back(), point) > kSamePoint) kept.push_back(point);
    return kept;
}

/// Corners in counter-clockwise order as seen from where the normal points to.
void addQuad(Mesh& mesh, const std::array<glm::vec3, 4>& corners, glm::vec3 normal) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    mesh.normals.insert(mesh.normals.end(), 4, normal);
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
        mesh.indices.push_back(first + corner);
}

/// An upright face above the edge a-b, seen from the right of it.
void addSide(Mesh& mesh, glm::dvec2 a, glm::dvec2 b, double height) {
    if (glm::distance(a, b) <= kSamePoint) return;
    const glm::dvec2 outwards = -leftOf(glm::normalize(b - a));
    addQuad(mesh, {lifted(a, 0.0), lifted(b, 0.0), lifted(b, height), lifted(a, height)},
            lifted(outwards, 0.0));
}

bool insideTriangle(glm::dvec2 point, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return cross(b - a, point - a) >= 0.0 && cross(c - b, point - b) >= 0.0 && cross(a - c, point - c) >= 0.0;
}

/// An ear is a convex corner whose triangle holds no other corner; one that coincides with the triangle's own
/// does not count, as outlines may touch themselves.
bool isEar(std::span<const glm::dvec2> polygon, std::span<const std::uint32_t> ring, std::size_t corner) {
    const std::size_t count = ring.size();
    const glm::dvec2 a = polygon[ring[(corner + count - 1) % count]];
    const glm::dvec2 b = polygon[ring[corner]];
    const glm::dvec2 c = polygon[ring[(corner + 1) % count]];
    if (cross(b - a, c - b) <= 0.0) return false;
    return std::ranges::none_of(ring, [&](std::uint32_t index) {
        const glm::dvec2 point = polygon[index];
        return point != a && point != b && point != c && insideTriangle(point, a, b, c);
    });
}

}  // namespace

Ribbon ribbonAlong(std::span<const glm::dvec2> points, double half_width) {
    const std::vector<glm::dvec2> kept = withoutRepeats(points);
    Ribbon ribbon;
    if (kept.size() < 2) return ribbon;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const glm::dvec2 before = glm::normalize(i > 0 ? kept[i] - kept[i - 1] : kept[1] - kept[0]);
        const glm::dvec2 after = i + 1 < kept.size() ? glm::normalize(kept[i + 1] - kept[i]) : before;
        const glm::dvec2 sum = leftOf(before) + leftOf(after);
        // Where the line turns straight back the two sides cancel out, and the strip ends square.
        const glm::dvec2 side = glm::length(sum) > kSamePoint ? glm::normalize(sum) : leftOf(before);
        const double cosine = std::max(glm::dot(side, leftOf(before)), 1.0 / kLongestMitre);
        ribbon.left.push_back(kept[i] + side * (half_width / cosine));
        ribbon.right.push_back(kept[i] - side * (half_width / cosine));
    }
    return ribbon;
}

double signedArea(std::span<const glm::dvec2> polygon) {
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    return 0.5 * twice;
}

std::vector<std::uint32_t> triangulate(std::span<const glm::dvec2> polygon) {
    std::vector<std::uint32_t> triangles;
    if (polygon.size() < 3) return triangles;
    std::vector<std::uint32_t> ring(polygon.size());
    std::iota(ring.begin(), ring.end(), 0u);
    if (signedArea(polygon) < 0.0) std::ranges::reverse(ring);
    while (ring.size() >= 3) {
        std::size_t ear = 0;
        while (ear < ring.size() && !isEar(polygon, ring, ear))
            ++ear;
        // Only corners on a straight line (or an outline that is not simple) leave no ear: cut there without
        // a face.
        const bool found = ear < ring.size();
        if (!found) ear = 0;
        const std::size_t count = ring.size();
        if (found) {
            triangles.push_back(ring[(ear + count - 1) % count]);
            triangles.push_back(ring[ear]);
            triangles.push_back(ring[(ear + 1) % count]);
        }
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
}

Mesh groundMesh(glm::dvec2 minimum, glm::dvec2 maximum, double z) {
    Mesh mesh;
    addQuad(mesh,
            {lifted(minimum, z), lifted({maximum.x, minimum.y}, z), lifted(maximum, z),
             lifted({minimum.x, maximum.y}, z)},
            {0.0f, 0.0f, 1.0f});
    return mesh;
}

Mesh ribbonMesh(std::span<const glm::dvec2> centreline, double width, double z) {
    const Ribbon ribbon = ribbonAlong(centreline, 0.5 * width);
    Mesh mesh;
    for (std::size_t i = 0; i + 1 < ribbon.left.size(); ++i)
        addQuad(mesh,
                {lifted(ribbon.right[i], z), lifted(ribbon.right[i + 1], z), lifted(ribbon.left[i + 1], z),
                 lifted(ribbon.left[i], z)},
                {0.0f, 0.0f, 1.0f});
    return mesh;
}

Mesh polygonMesh(std::span<const glm::dvec2> polygon, double z) {
    Mesh mesh;
    mesh.indices = triangulate(polygon);
    if (mesh.indices.empty()) return mesh;
    for (const glm::dvec2 point : polygon) {
        mesh.positions.push_back(lifted(point, z));
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
    }
    return mesh;
}

Mesh openWallMesh(std::span<const glm::dvec2> points, double thickness, double height) {
    const Ribbon ribbon = ribbonAlong(points, 0.5 * thickness);
    Mesh mesh = ribbonMesh(points, thickness, height);
    if (ribbon.left.empty()) return mesh;
    for (std::size_t i = 0; i + 1 < ribbon.left.size(); ++i) {
        addSide(mesh, ribbon.right[i], ribbon.right[i + 1], height);
        addSide(mesh, ribbon.left[i + 1], ribbon.left[i], height);
    }
    addSide(mesh, ribbon.left.front(), ribbon.right.front(), height);
    addSide(mesh, ribbon.right.back(), ribbon.left.back(), height);
    return mesh;
}

Mesh closedWallMesh(std::span<const glm::dvec2> polygon, double height) {
    std::vector<glm::dvec2> corners = withoutRepeats(polygon);
    if (corners.size() > 1 && glm::distance(corners.front(), corners.back()) <= kSamePoint)
        corners.pop_back();
    if (signedArea(corners) < 0.0) std::ranges::reverse(corners);
    Mesh mesh = polygonMesh(corners, height);
    if (mesh.indices.empty()) return mesh;
    for (std::size_t i = 0; i < corners.size(); ++i)
        addSide(mesh, corners[i], corners[(i + 1) % corners.size()], height);
    return mesh;
}

Mesh raisedMesh(Mesh mesh, double height) {
    for (glm::vec3& position : mesh.positions)
        position.z += static_cast<float>(height);
    return mesh;
}

Mesh turnedMesh(Mesh mesh, double angle) {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const auto turn = [&](glm::vec3& v) {
        v = glm::vec3(static_cast<float>(cosine * v.x - sine * v.y),
                      static_cast<float>(sine * v.x + cosine * v.y), v.z);
    };
    std::ranges::for_each(mesh.positions, turn);
    std::ranges::for_each(mesh.normals, turn);
    return mesh;
}

void append(Mesh& mesh, const Mesh& more) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
    mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
    for (const std::uint32_t index : more.indices)
        mesh.indices.push_back(first + index);
}

Mesh bodyMesh() {
    constexpr std::uint32_t kSides = 10;
    constexpr std::uint32_t kRings = 8;  // from the south pole to the north pole
    Mesh mesh;
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
        const double latitude = std::numbers::pi * (static_cast<double>(ring) / (kRings - 1) - 0.5);
        const double middle = ring < kRings / 2 ? kBodyRadius : kBodyHeight - kBodyRadius;
        for (std::uint32_t side = 0; side < kSides; ++side) {
            const double longitude = 2.0 * std::numbers::pi * side / kSides;
            const glm::dvec3 normal(std::cos(latitude) * std::cos(longitude),
                                    std::cos(latitude) * std::sin(longitude), std::sin(latitude));
            mesh.positions.emplace_back(normal * kBodyRadius + glm::dvec3(0.0, 0.0, middle));
            mesh.normals.emplace_back(normal);
        }
    }
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring)
        for (std::uint32_t side = 0; side < kSides; ++side) {
            const std::uint32_t a = ring * kSides + side;
            const std::uint32_t b = ring * kSides + (side + 1) % kSides;
            // At the poles one of the two triangles has no area.
            if (ring > 0) mesh.indices.insert(mesh.indices.end(), {a, b, b + kSides});
            if (ring + 2 < kRings) mesh.indices.insert(mesh.indices.end(), {a, b + kSides, a + kSides});
        }

    const glm::vec3 tip(0.40f, 0.0f, 1.50f);
    const std::array<glm::vec3, 3> base{glm::vec3(0.2f, -0.09f, 1.46f), glm::vec3(0.2f, 0.09f, 1.46f),
                                        glm::vec3(0.16f, 0.0f, 1.64f)};
    for (std::size_t i = 0; i < base.size(); ++i) {
        const glm::vec3 a = base[i];
        const glm::vec3 b = base[(i + 1) % base.size()];
        const glm::vec3 normal = glm::normalize(glm::cross(b - a, tip - a));
        for (const glm::vec3 corner : {a, b, tip}) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(corner);
            mesh.normals.push_back(normal);
        }
    }
    return mesh;
}

}  // namespace throng::io
