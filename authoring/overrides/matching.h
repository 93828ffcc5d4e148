// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "authoring/overrides/overrides.h"

/// Who is meant in a bake that was made again. blender_addon/throng/overrides/matching.py has the same rule;
/// tests/shared/override_matching.json holds both to the same answers.
namespace throng::authoring {

/// Within these of where and when it entered before, somebody with the same id and group is the same person.
inline constexpr double kSureMetres = 0.5;
inline constexpr double kSureFrames = 12.0;
/// Further away than these nobody is taken for another.
inline constexpr double kMostMetres = 3.0;
inline constexpr double kMostFrames = 48.0;

/// Somebody in the bake, by row.
struct Entrant {
    std::string group;
    bool enters = false;  ///< those who never do are nobody's match
    std::uint32_t frame = 0;
    glm::dvec3 place{0.0};  ///< m, world
};

struct Match {
    enum class Kind {
        sure,      ///< the same id and group, and about the same entry
        nearest,   ///< the nearest entry of that group among those whom no other override has
        orphaned,  ///< nobody is near enough
    } kind = Kind::orphaned;
    std::uint32_t row = 0;
    double metres = 0.0;  ///< between the entries
    double frames = 0.0;  ///< likewise; later above zero
};

/// One match for each override, in their order; each person has at most one.
///
/// First whoever is sure; then, nearest first, by (metres / kMostMetres)^2 + (frames / kMostFrames)^2, and
/// among equals by the order of the overrides and then the rows.
std::vector<Match> matchOverrides(std::span<const Override> overrides, std::span<const Entrant> people);

/// Why an override has nobody, for its user.
std::string orphanReason(const Override& entry, std::span<const Entrant> people);

}  // namespace throng::authoring
