// SPDX-License-Identifier: Apache-2.0
#include "authoring/storeys/mesh_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <map>

namespace throng::authoring {
namespace {

constexpr double kHairOff = 1.0e-9;    // m: a face that touches a solid is not in it
constexpr double kLeastArea = 1.0e-8;  // m^2: smaller pieces of faces are left out
constexpr double kWallHeight = 1.8;    // m: what is as high is a wall, and no parapet or the edge of a slab
constexpr double kUprightFace = 0.3;   // the upward part of the normal of a face that is about upright
constexpr double kFlatFace = 0.7;      // that of a face that people can stand on
constexpr double kThin = 0.25;         // m: as thick are slabs of which no underside is known
constexpr double kThickest = 1.5;      // m

struct CornerPoint {
    glm::dvec3 at{0.0}, normal{0.0};
};
using Piece = std::vector<CornerPoint>;  // convex

double areaOf(const Piece& piece) {
    glm::dvec3 twice(0.0);
    for (std::size_t i = 1; i + 1 < piece.size(); ++i)
        twice += glm::cross(piece[i].at - piece[0].at, piece[i + 1].at - piece[0].at);
    return 0.5 * glm::length(twice);
}

/// What of a piece is within a half-space, or beyond it.
Piece partOf(const Piece& piece, const HalfSpace& half, bool within) {
    const double sign = within ? 1.0 : -1.0;
    Piece part;
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const CornerPoint &from = piece[i], &to = piece[(i + 1) % piece.size()];
        const double a = sign * half.beyond(from.at), b = sign * half.beyond(to.at);
        if (a <= kHairOff) part.push_back(from);
        if ((a <= kHairOff) == (b <= kHairOff)) continue;
        const double along = std::clamp(a / (a - b), 0.0, 1.0);
        part.push_back({glm::mix(from.at, to.at, along), glm::mix(from.normal, to.normal, along)});
    }
    return part;
}

/// A piece without a solid: what lies in it, and what is left beyond each of its planes.
struct Split {
    Piece within;
    std::vector<Piece> left;
};

/// Most faces are far from most solids.
bool isApart(const Piece& piece, const UprightSolid& solid) {
    const auto is_beyond = [&](const HalfSpace& half) {
        return std::ranges::all_of(piece,
                                   [&](const CornerPoint& corner) { return half.beyond(corner.at) > 0.0; });
    };
    return std::ranges::any_of(solid.sides, is_beyond) || std::ranges::any_of(solid.ends, is_beyond);
}

std::optional<Split> splitBy(const Piece& piece, const UprightSolid& solid) {
    if (isApart(piece, solid)) return std::nullopt;
    Split split{piece, {}};
    for (const std::vector<HalfSpace>* halves : {&solid.sides, &solid.ends})
        for (const HalfSpace& half : *halves) {
            // A face in the plane of a side belongs to the solid.
            const bool goes_beyond = std::ranges::any_of(
                split.within, [&](const CornerPoint& corner) { return half.beyond(corner.at) > kHairOff; });
            Piece beyond = goes_beyond ? partOf(split.within, half, false) : Piece();
            split.within = partOf(split.within, half, true);
            if (split.within.size() < 3 || areaOf(split.within) < kLeastArea) return std::nullopt;
            if (beyond.size() >= 3 && areaOf(beyond) >= kLeastArea) split.left.push_back(std::move(beyond));
        }
    return split;
}

struct Bounds3 {
    glm::dvec3 lower{std::numeric_limits<double>::max()}, upper{std::numeric_limits<double>::lowest()};
    void add(glm::dvec3 at) {
        lower = glm::min(lower, at);
        upper = glm::max(upper, at);
    }
};

class Cutter {
  public:
    Cutter(const TerrainMesh& mesh, const std::vector<UprightSolid>& solids, bool lined)
        : mesh_(mesh), solids_(solids), lined_(lined), heights_(solids.size()) {
        result_.walls.resize(solids.size());
    }

    CutMesh run() {
        result_.mesh.positions = mesh_.positions;
        result_.mesh.normals = mesh_.normals;
        for (std::size_t first = 0; first + 2 < mesh_.indices.size(); first += 3)
            cutFace(first);
        if (lined_)
            for (const auto& [from, to] : rims_)
                addSide(from, to);
        return std::move(result_);
    }

  private:
    CornerPoint cornerAt(std::size_t index) const {
        const std::uint32_t corner = mesh_.indices[index];
        const bool has_normal = corner < mesh_.normals.size();
        return {mesh_.positions[corner],
                has_normal ? glm::dvec3(mesh_.normals[corner]) : glm::dvec3(0.0, 0.0, 1.0)};
    }

    void cutFace(std::size_t first) {
        const Piece face = {cornerAt(first), cornerAt(first + 1), cornerAt(first + 2)};
        const glm::dvec3 across = glm::cross(face[1].at - face[0].at, face[2].at - face[0].at);
        const double size = glm::length(across);
        const double up = size > 0.0 ? across.z / size : 1.0;
        std::vector<Piece> pieces = {face};
        bool is_cut = false;
        for (std::size_t solid = 0; solid < solids_.size(); ++solid) {
            if (!solids_[solid].takes_floors && std::abs(up) >= kUprightFace) continue;
            std::vector<Piece> left;
            for (const Piece& piece : pieces) {
                std::optional<Split> split = splitBy(piece, solids_[solid]);
                if (!split) {
                    left.push_back(piece);
                    continue;
                }
                is_cut = true;
                noteCut(solid, split->within, up);
                left.insert(left.end(), split->left.begin(), split->left.end());
            }
            pieces = std::move(left);
        }
        if (!is_cut) {
            for (std::size_t i = 0; i < 3; ++i)
                result_.mesh.indices.push_back(mesh_.indices[first + i]);
            return;
        }
        for (const Piece& piece : pieces)
            addPiece(piece);
    }

    void noteCut(std::size_t solid, const Piece& within, double up) {
        if (up > kFlatFace)
            for (std::size_t i = 0; i < within.size(); ++i)
                if (isRim(solids_[solid], within[i].at, within[(i + 1) % within.size()].at))
                    rims_.emplace_back(within[i].at, within[(i + 1) % within.size()].at);
        if (std::abs(up) < kUprightFace) noteWall(solid, within);
    }

    /// Whether an edge is the rim of an opening: on the side of a solid, with the mesh going on beyond it.
    bool isRim(const UprightSolid& solid, glm::dvec3 a, glm::dvec3 b) const {
        constexpr double kOn = 1.0e-6, kBeyondIt = 0.01;  // m
        return std::ranges::any_of(solid.sides, [&](const HalfSpace& side) {
            return std::abs(side.beyond(a)) < kOn && std::abs(side.beyond(b)) < kOn &&
                   !isInAnySolid(0.5 * (a + b) + kBeyondIt * side.normal);
        });
    }

    bool isInAnySolid(glm::dvec3 place) const {
        const auto is_within = [&](const HalfSpace& half) { return half.beyond(place) <= 0.0; };
        return std::ranges::any_of(solids_, [&](const UprightSolid& solid) {
            return solid.takes_floors && std::ranges::all_of(solid.sides, is_within) &&
                   std::ranges::all_of(solid.ends, is_within);
        });
    }

    /// Of walls in many small faces, those above each other count together.
    void noteWall(std::size_t solid, const Piece& within) {
        constexpr double kBeside = 0.25;  // m
        Bounds3 bounds;
        for (const CornerPoint& corner : within)
            bounds.add(corner.at);
        const glm::ivec2 place(glm::floor(0.5 * glm::dvec2(bounds.lower + bounds.upper) / kBeside));
        auto [known, is_new] = heights_[solid].try_emplace({place.x, place.y}, bounds);
        if (!is_new) {
            known->second.add(bounds.lower);
            known->second.add(bounds.upper);
        }
        if (known->second.upper.z - known->second.lower.z >= kWallHeight && !result_.walls[solid])
            result_.walls[solid] = 0.5 * (bounds.lower + bounds.upper);
    }

    void addPiece(const Piece& piece) {
        const auto first = static_cast<std::uint32_t>(result_.mesh.positions.size());
        for (const CornerPoint& corner : piece) {
            result_.mesh.positions.push_back(corner.at);
            const double length = glm::length(corner.normal);
            result_.mesh.normals.emplace_back(length > 0.0 ? corner.normal / length
                                                           : glm::dvec3(0.0, 0.0, 1.0));
        }
        for (std::uint32_t i = 1; i + 1 < piece.size(); ++i)
            for (const std::uint32_t corner : {0u, i, i + 1})
                result_.mesh.indices.push_back(first + corner);
    }

    /// Down from the rim of an opening to the slab's underside.
    void addSide(glm::dvec3 from, glm::dvec3 to) {
        if (glm::distance(from, to) < 1.0e-4) return;
        const double thick = thicknessAt(0.5 * (from + to));
        const glm::dvec3 down(0.0, 0.0, -thick);
        // The opening is on the left of its rim, and that is where its sides are seen from.
        const glm::dvec3 along = to - from;
        const glm::dvec3 towards = glm::normalize(glm::dvec3(-along.y, along.x, 0.0));
        Piece side;
        for (const glm::dvec3 corner : {from, from + down, to + down, to})
            side.push_back({corner, towards});
        std::ranges::reverse(side);
        addPiece(side);
    }

    /// m, from a face that looks up to the next below it that looks down.
    double thicknessAt(glm::dvec3 place) const {
        double thick = kThickest;
        bool found = false;
        for (std::size_t first = 0; first + 2 < mesh_.indices.size(); first += 3) {
            const glm::dvec3 a = mesh_.positions[mesh_.indices[first]],
                             b = mesh_.positions[mesh_.indices[first + 1]] - a,
                             c = mesh_.positions[mesh_.indices[first + 2]] - a;
            const double area = b.x * c.y - b.y * c.x;
            if (area > -1.0e-9) continue;  // it looks up, or aside
            const glm::dvec2 p = glm::dvec2(place - a);
            const double v = (p.x * c.y - p.y * c.x) / area, w = (b.x * p.y - b.y * p.x) / area;
            constexpr double kOver = 1.0e-6;
            if (v < -kOver || w < -kOver || v + w > 1.0 + kOver) continue;
            const double below = place.z - (a.z + v * b.z + w * c.z);
            if (below <= 1.0e-3 || below >= thick) continue;
            thick = below;
            found = true;
        }
        return found ? thick : kThin;
    }

    const TerrainMesh& mesh_;
    const std::vector<UprightSolid>& solids_;
    bool lined_;
    CutMesh result_;
    std::vector<std::pair<glm::dvec3, glm::dvec3>> rims_;
    std::vector<std::map<std::pair<int, int>, Bounds3>> heights_;  // by solid: of upright faces cut out
};

}  // namespace

double HalfSpace::beyond(glm::dvec3 place) const {
    return glm::dot(normal, place) - most;
}

CutMesh cutOut(const TerrainMesh& mesh, const std::vector<UprightSolid>& solids, bool lined) {
    return Cutter(mesh, solids, lined).run();
}

void addMesh(TerrainMesh& mesh, const TerrainMesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
    for (const std::uint32_t index : other.indices)
        mesh.indices.push_back(first + index);
}

}  // namespace throng::authoring
